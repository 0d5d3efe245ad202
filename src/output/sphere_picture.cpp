#include "output/sphere_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "base/message.hpp"
#include "base/png.hpp"
#include "lichtmc/picture.hpp"
#include "output/picture_parts.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

constexpr double disc_radius = 140.0;
constexpr double disc_side = 40.0;    // for the names of the planes
constexpr std::size_t pixels = 560;   // across a disc
constexpr double reach_share = 0.01;  // of the maximum

// The inner angles that a disc shows, and the step of its rings, in degrees.
struct Extent {
  double edge = 90.0;
  double step = 30.0;
};

// The greatest angle to the axis of a disc with visible light, in degrees; none: −1.
double reach_of(const Photometry& photometry, bool behind) {
  const CandelaTable& table = *photometry.candela;
  const CandelaTable::Grid& grid = table.grid();
  const double visible = reach_share * table.peak().candela;
  double reach = -1.0;
  for (std::size_t j = 0; j < grid.horizontal_deg.size(); ++j) {
    for (std::size_t i = 0; i < grid.vertical_deg.size(); ++i) {
      if (grid.candela[j * grid.vertical_deg.size() + i] < visible) continue;
      const double angle = angle_to_aim(photometry, grid.horizontal_deg[j], grid.vertical_deg[i]);
      const double own = behind ? 180.0 - angle : angle;
      if (own < 90.0 || (own <= 90.0 && !behind)) reach = std::max(reach, own);
    }
  }
  return reach;
}

Extent extent_of(double reach) {
  for (const Extent extent :
       {Extent{2.0, 1.0}, Extent{6.0, 2.0}, Extent{15.0, 5.0}, Extent{30.0, 10.0}, Extent{60.0, 20.0}}) {
    if (reach <= extent.edge) return extent;
  }
  return {};
}

std::string disc_png(const CandelaTable& table, const ColourScale& scale, bool behind, double edge_deg) {
  std::vector<std::uint8_t> bytes(4 * pixels * pixels, 0);
  const double edge = edge_deg * std::numbers::pi / 180.0;
  for (std::size_t row = 0; row < pixels; ++row) {
    for (std::size_t column = 0; column < pixels; ++column) {
      const double x = (2.0 * static_cast<double>(column) + 1.0) / pixels - 1.0;
      const double y = 1.0 - (2.0 * static_cast<double>(row) + 1.0) / pixels;
      const double r = std::hypot(x, y);
      if (r > 1.0) continue;
      const double sine = std::sin(edge * r);
      const glm::dvec3 direction(sine * x / r, sine * y / r, (behind ? -1.0 : 1.0) * std::cos(edge * r));
      const Colour colour = colour_of(scale, table.candela(direction));
      std::uint8_t* pixel = &bytes[4 * (row * pixels + column)];
      std::copy(colour.begin(), colour.end(), pixel);
      pixel[3] = 255;
    }
  }
  return png_file(pixels, pixels, 4, bytes);
}

// The directions at the right, at the top, at the left and at the bottom of a disc.
std::array<std::string, 4> names_of_sides(const CandelaTable::Grid& grid) {
  switch (grid.type) {
    case PhotometricType::c:
      return {"C0", "C90", "C180", "C270"};
    case PhotometricType::b:
      if (grid.flip_horizontal) return {"V+", "H+", "V−", "H−"};
      return {"V+", "H−", "V−", "H+"};
    case PhotometricType::a:
      break;
  }
  if (grid.flip_horizontal) return {"H−", "V+", "H+", "V−"};
  return {"H+", "V+", "H−", "V−"};
}

std::string disc(const CandelaTable& table, const ColourScale& scale, bool behind, const Extent& extent, double x,
                 double y) {
  const double cx = x + disc_side + disc_radius;
  const double cy = y + 40.0 + disc_radius;
  std::string svg = svg_text(cx, y + 4.0, behind ? "behind: more than 90° from the aim" : "towards the aim",
                             " text-anchor=\"middle\"");
  svg += svg_image(disc_png(table, scale, behind, extent.edge), cx - disc_radius, cy - disc_radius, 2.0 * disc_radius,
                   2.0 * disc_radius, false);
  const std::string small = " font-size=\"" + fixed(note_size) + "\" text-anchor=\"";
  for (double angle = extent.step; angle <= extent.edge + 1e-9; angle += extent.step) {
    const double r = disc_radius * angle / extent.edge;
    const bool last = angle + 1e-9 >= extent.edge;
    svg += "<circle cx=\"" + fixed(cx) + "\" cy=\"" + fixed(cy) + "\" r=\"" + fixed(r) + "\" fill=\"none\" stroke=\"" +
           (last ? "#888\"" : "#fff\" stroke-opacity=\"0.5\" stroke-width=\"0.8\"") + "/>\n";
    constexpr double diagonal = std::numbers::sqrt2 / 2.0;
    svg += svg_text(cx + diagonal * r, cy - diagonal * r + 4.0, decimal(behind ? 180.0 - angle : angle, 1) + "°",
                    " class=\"halo\"" + small + "middle\"");
  }
  const std::array<std::string, 4> names = names_of_sides(table.grid());
  svg += svg_text(cx + disc_radius + 5.0, cy + 4.5, names[0], small + "start\"");
  svg += svg_text(cx, cy - disc_radius - 6.0, names[1], small + "middle\"");
  svg += svg_text(cx - disc_radius - 5.0, cy + 4.5, names[2], small + "end\"");
  svg += svg_text(cx, cy + disc_radius + 15.0, names[3], small + "middle\"");
  return svg;
}

}  // namespace

PicturePanel sphere_panel(const Photometry& photometry, double x, double y) {
  const CandelaTable& table = *photometry.candela;
  ColourScale scale;
  scale.high = table.peak().candela;
  PicturePanel panel{{}, 0.0, 40.0 + 2.0 * disc_radius + 24.0};
  for (const bool behind : {false, true}) {
    const double reach = reach_of(photometry, behind);
    if (reach < 0.0) continue;
    panel.svg += disc(table, scale, behind, extent_of(reach), x + panel.width, y);
    panel.width += 2.0 * (disc_radius + disc_side);
  }
  const double legend_height = 2.0 * disc_radius - 20.0;
  panel.svg += colour_legend(scale, photometry.intensity_unit, x + panel.width - 8.0, y + 54.0, legend_height);
  panel.width += legend_width(scale, legend_height);
  double note_y = y + panel.height + 8.0;
  panel.svg += svg_notes(
      "Seen from behind the luminaire (from above, if it aims down); from the middle of a disc to its edge the "
      "angle to the aim.",
      x + 8.0, note_y, panel.width - 16.0);
  panel.height = note_y - y;
  return panel;
}

}  // namespace lichtmc
