#include "output/polar_diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "base/message.hpp"
#include "output/picture_parts.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

constexpr double radius = 175.0;  // of the outermost ring
constexpr double side = 46.0;     // from it to the edge of the panel
constexpr double angle_size = 11.0;
constexpr double line_height = 20.0;  // of the legend
// Below this share of the highest intensity there is no light.
constexpr double visible_share = 0.005;

// A line of the diagram.
struct Curve {
  std::string name;
  std::string style;
  IntensityCut cut;
};

std::string line_style(const char* colour, const char* dashes) {
  return "stroke=\"" + std::string(colour) + "\" stroke-width=\"2\" fill=\"none\" stroke-linejoin=\"round\"" +
         (*dashes == '\0' ? "" : " stroke-dasharray=\"" + std::string(dashes) + "\"");
}

// Colours as in charts: they can be distinguished with any colour vision.
std::vector<Curve> curves_of(const Photometry& photometry, const LuminaireFigures& figures) {
  const CandelaTable& table = *photometry.candela;
  const std::string first_style = line_style("#0072B2", "");
  if (table.grid().symmetry == PhotometricSymmetry::rotational)
    return {{"all C planes (rotationally symmetric)", first_style, figures.planes[0].cut}};
  const auto name_of_plane = [&](const LuminairePlane& plane) {
    switch (table.grid().type) {
      case PhotometricType::c:
        return plane.plane_deg == 0.0 ? std::string("C0 (right) – C180 (left)")
                                      : std::string("C90 (right) – C270 (left)");
      case PhotometricType::b:
        return plane.name + (plane.plane_deg == 0.0         ? " (right: V > 0)"
                             : table.grid().flip_horizontal ? " (right: H > 0)"
                                                            : " (right: H < 0)");
      case PhotometricType::a:
        break;
    }
    return plane.name + (plane.plane_deg == 90.0        ? " (right: V > 0)"
                         : table.grid().flip_horizontal ? " (right: H < 0)"
                                                        : " (right: H > 0)");
  };
  std::vector<Curve> curves{{name_of_plane(figures.planes[0]), first_style, figures.planes[0].cut},
                            {name_of_plane(figures.planes[1]), line_style("#D55E00", "7 4"), figures.planes[1].cut}};
  const double shown = std::max(highest_of(curves[0].cut).candela, highest_of(curves[1].cut).candela);
  constexpr double much_higher = 1.02;
  if (table.grid().type == PhotometricType::c && table.peak().candela > much_higher * shown) {
    const double plane = table.peak().horizontal_deg;
    const double opposite = std::fmod(plane + 180.0, 360.0);
    curves.push_back({"C" + decimal(plane, 2) + " – C" + decimal(opposite, 2) + ", through the maximum",
                      line_style("#009E73", "2 3"), intensity_cut(table, plane)});
  }
  return curves;
}

double highest_of(const std::vector<Curve>& curves) {
  double highest = 0.0;
  for (const Curve& curve : curves) highest = std::max(highest, highest_of(curve.cut).candela);
  return highest;
}

// A round step with at most `most` of them up to a value.
double round_step(double value, double most) {
  const double rough = value / most * (1.0 - 1e-9);
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 2.5, 5.0}) {
    if (step * decade >= rough) return step * decade;
  }
  return 10.0 * decade;
}

struct Rings {
  double step = 1.0;
  int count = 1;
  double top() const { return step * count; }
};
Rings rings_of(double highest) {
  if (!(highest > 0.0)) return {};  // dark planes
  const double step = round_step(highest, 5.0);
  return {step, std::max(1, static_cast<int>(std::ceil(highest / step - 1e-9)))};
}

// Which half of the diagram has light.
enum class Part { below, above, whole };
Part part_of(const std::vector<Curve>& curves) {
  const double visible = visible_share * highest_of(curves);
  double below = 0.0;
  double above = 0.0;
  for (const Curve& curve : curves) {
    for (const IntensityPoint& point : curve.cut) {
      if (std::abs(point.angle_deg) < 90.0) below = std::max(below, point.candela);
      if (std::abs(point.angle_deg) > 90.0) above = std::max(above, point.candela);
    }
  }
  return above < visible || !(above > 0.0) ? Part::below : below < visible ? Part::above : Part::whole;
}

// Maps intensities to places: the aim down, positive angles right.
class Polar {
 public:
  Polar(const glm::dvec2& middle, double top) : middle_(middle), top_(top) {}
  glm::dvec2 at(double angle_deg, double candela) const { return on_ring(angle_deg, radius * candela / top_); }
  glm::dvec2 on_ring(double angle_deg, double r) const {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    return middle_ + r * glm::dvec2(std::sin(angle), std::cos(angle));
  }
  const glm::dvec2& middle() const { return middle_; }

 private:
  glm::dvec2 middle_;
  double top_;
};

// Points of a cut not more than 1° apart, without those that lie on their predecessors.
template <class Place>
std::string polyline(const IntensityCut& cut, const Place& place, const std::string& style) {
  constexpr double least_distance = 0.25;
  std::string svg = "<polyline " + style + " points=\"";
  glm::dvec2 last(-1e9);
  const auto add = [&](double angle, double candela, bool always) {
    const glm::dvec2 p = place(angle, candela);
    if (!always && std::hypot(p.x - last.x, p.y - last.y) < least_distance) return;
    svg += fixed(p.x) + "," + fixed(p.y) + " ";
    last = p;
  };
  for (std::size_t k = 0; k < cut.size(); ++k) {
    add(cut[k].angle_deg, cut[k].candela, k == 0 || k + 1 == cut.size());
    if (k + 1 == cut.size()) break;
    const double gap = cut[k + 1].angle_deg - cut[k].angle_deg;
    const int parts = static_cast<int>(std::ceil(gap));
    for (int part = 1; part < parts; ++part) {
      const double share = static_cast<double>(part) / parts;
      add(cut[k].angle_deg + share * gap, cut[k].candela + share * (cut[k + 1].candela - cut[k].candela), false);
    }
  }
  svg.pop_back();
  return svg + "\"/>\n";
}

// An arc of a ring from −to over the aim to +to, or of the other half; a circle for both.
std::string ring(const Polar& polar, double r, Part part) {
  const std::string end = "\" class=\"rule\" fill=\"none\"/>\n";
  if (part == Part::whole)
    return "<circle cx=\"" + fixed(polar.middle().x) + "\" cy=\"" + fixed(polar.middle().y) + "\" r=\"" + fixed(r) +
           end;
  const glm::dvec2 from = polar.on_ring(-90.0, r);
  const glm::dvec2 to = polar.on_ring(90.0, r);
  return "<path d=\"M" + fixed(from.x) + " " + fixed(from.y) + " A" + fixed(r) + " " + fixed(r) + " 0 0 " +
         (part == Part::below ? "0 " : "1 ") + fixed(to.x) + " " + fixed(to.y) + end;
}

// A text on the colour of the page.
std::string plate(double x, double y, const std::string& text) {
  const double width = text_width(text, angle_size);
  return "<rect x=\"" + fixed(x - 0.5 * width) + "\" y=\"" + fixed(y - 9.5) + "\" width=\"" + fixed(width) +
         "\" height=\"12\" class=\"paper\" opacity=\"0.8\"/>\n" +
         svg_text(x, y, text, " text-anchor=\"middle\" font-size=\"" + fixed(angle_size) + "\"");
}

// The angle between the rays at which the values of the rings hide least.
double ray_of_values(const std::vector<Curve>& curves, Part part) {
  if (part != Part::whole) return 90.0;
  double best = 105.0;
  double least = 1e300;
  for (const double ray : {105.0, 75.0, 135.0, 45.0, 165.0, 15.0}) {
    double sum = 0.0;
    for (const Curve& curve : curves) {
      double near = 0.0;
      for (const IntensityPoint& point : curve.cut)
        if (std::abs(point.angle_deg - ray) <= 15.0) near = std::max(near, point.candela);
      sum += near;
    }
    if (sum < least * (1.0 - 1e-6)) {
      least = sum;
      best = ray;
    }
  }
  return best;
}

std::string grid(const Polar& polar, const Rings& rings, Part part) {
  std::string svg;
  for (int k = 1; k <= rings.count; ++k) svg += ring(polar, radius * k / rings.count, part);
  for (int angle = -150; angle <= 180; angle += 30) {
    const bool below = std::abs(angle) <= 90;
    const bool above = std::abs(angle) >= 90;
    if ((part == Part::below && !below) || (part == Part::above && !above)) continue;
    const glm::dvec2 end = polar.on_ring(angle, radius);
    svg += svg_line(polar.middle().x, polar.middle().y, end.x, end.y, "class=\"rule\"");
    const glm::dvec2 label = polar.on_ring(angle, radius + 17.0);
    // At the edge of a half beside the values of the rings, which lie on the other side of the line.
    const double beside = part != Part::whole && std::abs(angle) == 90 ? (part == Part::below ? 8.0 : -5.0) : 0.0;
    svg += svg_text(label.x, label.y + 4.0 + beside, std::to_string(std::abs(angle)) + "°",
                    " class=\"muted\" text-anchor=\"middle\" font-size=\"" + fixed(angle_size) + "\"");
  }
  return svg;
}

// The values of the rings, of every second one if they need more room.
std::string values(const Polar& polar, const Rings& rings, double ray, Part part, const std::string& unit) {
  std::string svg;
  const auto add = [&](double r, const std::string& text) {
    glm::dvec2 at = polar.on_ring(ray, r);
    at.y += part == Part::below ? -5.0 : part == Part::above ? 14.0 : 4.0;
    svg += plate(at.x, at.y, text);
  };
  double widest = 0.0;
  for (int k = 1; k <= rings.count; ++k)
    widest = std::max(widest, text_width(short_number(rings.step * k), angle_size));
  const int step = part == Part::whole || widest + 4.0 < radius / rings.count ? 1 : 2;
  for (int k = rings.count; k > 0; k -= step) {
    const bool with_unit = part == Part::whole && k == rings.count;
    add(radius * k / rings.count, short_number(rings.step * k) + (with_unit ? " " + unit : ""));
  }
  if (part != Part::whole) add(0.0, unit);
  return svg;
}

std::string sides(const Photometry& photometry, const glm::dvec2& middle, double y) {
  if (photometry.candela->grid().type != PhotometricType::c ||
      photometry.candela->grid().symmetry == PhotometricSymmetry::rotational)
    return {};
  const std::string attributes = " class=\"muted\" font-size=\"" + fixed(note_size) + "\" text-anchor=\"";
  return svg_text(middle.x - radius - side, y, "C180, C270", attributes + "start\"") +
         svg_text(middle.x + radius + side, y, "C0, C90", attributes + "end\"");
}

}  // namespace

PicturePanel polar_panel(const Photometry& photometry, const LuminaireFigures& figures, double x, double y) {
  const std::vector<Curve> curves = curves_of(photometry, figures);
  const Rings rings = rings_of(highest_of(curves));
  const Part part = part_of(curves);
  const double top = y + 14.0;
  const glm::dvec2 middle{x + side + radius, top + (part == Part::below ? 24.0 : radius + 24.0)};
  const double bottom = middle.y + (part == Part::above ? 30.0 : radius + 30.0);
  const Polar polar(middle, rings.top());
  PicturePanel panel{{}, 2.0 * (radius + side), bottom - y};
  panel.svg = grid(polar, rings, part) + sides(photometry, middle, part == Part::above ? bottom - 4.0 : top);
  for (const Curve& curve : curves)
    panel.svg += polyline(
        curve.cut, [&](double angle, double candela) { return polar.at(angle, candela); }, curve.style);
  // The maximum, if one of the lines passes it.
  const PeakIntensity& peak = photometry.candela->peak();
  for (const Curve& curve : curves) {
    const IntensityPoint highest = highest_of(curve.cut);
    if (highest.candela < peak.candela * (1.0 - 1e-6)) continue;
    const std::string text = "maximum: " + rounded(peak.candela, 4) + " " + photometry.intensity_unit + " at " +
                             direction_text(photometry, peak.horizontal_deg, peak.vertical_deg);
    panel.svg +=
        svg_circle(polar.at(highest.angle_deg, highest.candela), 3.5, "class=\"mark\" stroke-width=\"1.5\"", text);
    break;
  }
  panel.svg += values(polar, rings, ray_of_values(curves, part), part, photometry.intensity_unit);
  for (const Curve& curve : curves) {
    panel.svg += svg_line(x + 8.0, y + panel.height + 8.0, x + 44.0, y + panel.height + 8.0, curve.style);
    panel.svg += svg_text(x + 52.0, y + panel.height + 12.5, curve.name, " font-size=\"" + fixed(note_size) + "\"");
    panel.height += line_height;
  }
  panel.height += 4.0;
  return panel;
}

std::string polar_svg(const Photometry& photometry) {
  const PicturePanel panel = polar_panel(photometry, luminaire_figures(photometry), 0.0, 4.0);
  return svg_head(panel.width, panel.height + 8.0, "") + panel.svg + "</svg>\n";
}

PicturePanel beam_panel(const Photometry& photometry, const LuminaireFigures& figures, double x, double y) {
  constexpr double widest = 20.0;  // degrees from the aim to the edge of the field
  const std::vector<Curve> curves = curves_of(photometry, figures);
  double edge = 0.0;
  for (const LuminairePlane& plane : figures.planes) {
    if (plane.field.lobes > 1) return {};
    edge = std::max({edge, std::abs(plane.field.from_deg), std::abs(plane.field.to_deg)});
  }
  if (!(edge > 0.0) || edge > widest) return {};
  const double step = round_step(1.5 * edge, 3.0);
  const double end = step * std::ceil(1.5 * edge / step - 1e-9);
  const Rings rings = rings_of(highest_of(curves));
  constexpr double width = 300.0;
  constexpr double height = 220.0;
  const double left = x + 60.0;
  const double base = y + 20.0 + height;
  const auto place = [&](double angle, double candela) {
    return glm::dvec2(left + 0.5 * width * (1.0 + angle / end), base - height * candela / rings.top());
  };
  PicturePanel panel{{}, 60.0 + width + 24.0, 20.0 + height + 44.0};
  const std::string small = " class=\"muted\" font-size=\"" + fixed(angle_size) + "\" text-anchor=\"";
  for (int k = 0; k <= rings.count; ++k) {
    const double at = base - height * k / rings.count;
    panel.svg += svg_line(left, at, left + width, at, "class=\"rule\"");
    panel.svg += svg_text(left - 6.0, at + 4.0, short_number(rings.step * k), small + "end\"");
  }
  for (double angle = -end; angle <= end * 1.0001; angle += step) {
    const double at = place(angle, 0.0).x;
    panel.svg += svg_line(at, base - height, at, base, "class=\"rule\"");
    panel.svg += svg_text(at, base + 16.0, decimal(angle, 3) + "°", small + "middle\"");
  }
  panel.svg += svg_text(left - 6.0, y + 6.0, photometry.intensity_unit, small + "end\"");
  panel.svg += svg_text(left + 0.5 * width, base + 36.0, "angle to the aim", small + "middle\"");
  for (const Curve& curve : curves) {
    IntensityCut inside;
    for (std::size_t k = 0; k + 1 < curve.cut.size(); ++k) {
      // Parts of intervals that lie within the axis.
      const IntensityPoint& a = curve.cut[k];
      const IntensityPoint& b = curve.cut[k + 1];
      const double from = std::max(a.angle_deg, -end);
      const double to = std::min(b.angle_deg, end);
      if (to < from) continue;
      const auto at = [&](double angle) {
        const double gap = b.angle_deg - a.angle_deg;
        return gap > 0.0 ? a.candela + (angle - a.angle_deg) / gap * (b.candela - a.candela) : a.candela;
      };
      inside.push_back({from, at(from)});
      inside.push_back({to, b.angle_deg > a.angle_deg ? at(to) : b.candela});
    }
    panel.svg += polyline(inside, place, curve.style);
  }
  return panel;
}

}  // namespace lichtmc
