#include "output/report_figures.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/units.hpp"
#include "output/chart.hpp"
#include "output/html.hpp"
#include "output/readable.hpp"
#include "output/svg.hpp"
#include "room/measured_surfaces.hpp"

namespace lichtmc {

namespace {

std::string attribute(std::string_view name, const std::string& value) {
  return " data-" + std::string(name) + "=\"" + escaped(value) + "\"";
}

std::string vector_text(const glm::dvec3& v) {
  return to_text(v.x) + "," + to_text(v.y) + "," + to_text(v.z);
}

// A plan with the attributes that a script needs to find a tile in the picture.
std::string plan_figure(const ReportContent& content, std::size_t k) {
  const SurfacePlan& plan = content.plans[k];
  const ColourScale& scale = content.scale;
  std::string attributes = std::string(" class=\"") + (plan.flat ? "plan" : "tile-map") + "\"" +
                           attribute("map", content.result->tiling.maps[plan.map].name) +
                           attribute("low", to_text(scale.low)) + attribute("high", to_text(scale.high)) +
                           attribute("scale", scale.logarithmic ? "log" : "linear") +
                           attribute("colours", std::string(to_string(scale.colours)));
  if (plan.flat) {
    attributes += attribute("corner", vector_text(plan.corner)) + attribute("across", vector_text(plan.across)) +
                  attribute("down", vector_text(plan.down));
  }
  return element("figure", content.plan_pictures[k], attributes);
}

// A row of the power balance.
struct Share {
  std::string name;
  double power = 0.0;
  const char* colour = "";
};

std::string shares_svg(const std::vector<Share>& shares, double emitted, const std::string& unit) {
  constexpr double row = 26.0;
  constexpr double names_end = 300.0;
  constexpr double bar_width = 520.0;
  std::string svg =
      svg_head(1080.0, 44.0 + row * static_cast<double>(shares.size()) + 10.0, "Where the light goes", 14.0);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double y = 44.0 + row * static_cast<double>(k);
    const double width = bar_width * std::clamp(shares[k].power / emitted, 0.0, 1.0);
    svg +=
        svg_text(names_end - 8.0, y + 16.0, shortened(shares[k].name, 13.0, names_end - 16.0), " text-anchor=\"end\"");
    svg += "<rect x=\"" + fixed(names_end) + "\" y=\"" + fixed(y + 3.0) + "\" width=\"" + fixed(width) +
           "\" height=\"18\" fill=\"" + shares[k].colour + "\"/>\n";
    svg += svg_text(names_end + width + 8.0, y + 16.0,
                    short_number(shares[k].power) + " " + unit + ", " + percent(shares[k].power / emitted));
  }
  return svg + "</svg>\n";
}

ChartSeries series_of(const std::string& name, const std::vector<ConvergencePoint>& points) {
  ChartSeries series{name, {}};
  for (const ConvergencePoint& point : points)
    series.points.push_back({static_cast<double>(point.histories), 100.0 * point.rms_relative_error});
  return series;
}

// "'floor' 3 m² of 20 m²", the largest first.
std::string covered_text(const Result& result) {
  std::vector<const SurfaceResult*> covered;
  for (const SurfaceResult& s : result.surfaces) {
    if (s.covered_m2 > 0.0) covered.push_back(&s);
  }
  std::stable_sort(covered.begin(), covered.end(),
                   [](const SurfaceResult* a, const SurfaceResult* b) { return a->covered_m2 > b->covered_m2; });
  constexpr std::size_t most = 10;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, covered.size()); ++k) {
    text += (k > 0 ? ", " : "") + in_quotes(covered[k]->name) + " " + short_number(covered[k]->covered_m2) + " m² of " +
            short_number(covered[k]->area_m2) + " m²";
  }
  if (covered.size() > most) text += " and " + to_text(covered.size() - most, "more surface");
  return text;
}

}  // namespace

std::string surfaces_section(const ReportContent& content) {
  const Result& result = *content.result;
  if (result.tiles.empty()) return {};
  const std::string power(power_unit(result.quantity));
  const std::string irradiance = written_irradiance_unit(result.quantity);
  const bool sides = content.style == ReportStyle::technical;  // lighting pages say which side is lit
  std::string rows;
  for (const SurfaceResult& s : result.surfaces) {
    rows += "<tr>" + text_cell(s.name) + text_cell(s.material) + number_cell(s.reflectance) + number_cell(s.area_m2) +
            number_cell(s.mean_irradiance) + number_cell(s.standard_error) + number_cell(s.min_irradiance) +
            number_cell(s.max_irradiance) + number_cell(s.power) + (sides ? number_cell(100.0 * s.behind_share) : "") +
            count_cell(s.tiles) + "</tr>\n";
  }
  std::vector<std::string> names{"surface",
                                 "material",
                                 "reflectance",
                                 "area, m²",
                                 "mean, " + irradiance,
                                 "standard error, " + irradiance,
                                 "lowest, " + irradiance,
                                 "highest, " + irradiance,
                                 "incident " + std::string(power_word(result.quantity)) + ", " + power};
  if (sides) names.emplace_back("on the back, %");
  names.emplace_back("tiles");
  const std::string left_out = unreached_text(result);
  std::string html = heading(sides ? "Surfaces" : "Surfaces in detail");
  html += element("p",
                  text_element("span", "Click a heading to sort. ", " class=\"screen-only\"") +
                      "Lowest and highest are values of single tiles and include their statistical errors. tiles.csv "
                      "contains all tiles." +
                      (left_out.empty() ? left_out : ' ' + escaped(left_out)),
                  " class=\"muted\"");
  if (const std::string covered = covered_text(result); !covered.empty()) {
    html += text_element("p",
                         "Other surfaces in the same plane cover a part of these, which receives nothing and lowers "
                         "their means: " +
                             covered + ".");
  }
  html += element("div",
                  element("table", table_head(names) + element("tbody", rows), " class=\"sortable\" id=\"surfaces\""),
                  " class=\"scroll\"");
  html += heading("Plans of the surfaces");
  std::string note =
      content.plans.empty()
          ? "There are no plans: no flat part of a surface has 2 % of the total surface area and shows "
            "differences."
          : "Walls are shown from their lit side, floors and ceilings from above. The largest flat parts "
            "with at least 2 % of the total surface area are shown.";
  for (const std::string& sentence : content.without_plan) note += " " + sentence;
  html += text_element("p", note, " class=\"muted\"");
  if (content.plans.empty()) return html;
  std::string figures;
  for (std::size_t k = 0; k < content.plans.size(); ++k) figures += plan_figure(content, k);
  return html + element("div", figures, " class=\"plans\"");
}

std::string balance_section(const Room& room, const Result& result) {
  if (result.tiles.empty()) return {};
  const std::string power(power_unit(result.quantity));
  const std::string word(power_word(result.quantity));
  const Balance& b = result.balance;
  constexpr std::size_t max_surfaces = 8;
  constexpr const char* absorbed = "#0072B2";
  std::vector<Share> shares;
  std::size_t unknown = 0;
  for (const SurfaceResult& s : result.surfaces) {
    if (std::isnan(s.absorbed)) {
      ++unknown;
    } else {
      shares.push_back({"absorbed by " + s.name, s.absorbed, absorbed});
    }
  }
  std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& c) { return a.power > c.power; });
  // Surfaces that are not measured absorb the rest.
  double of_measured = 0.0;
  for (const Share& share : shares) of_measured += share.power;
  if (shares.size() > max_surfaces) {
    Share others{"absorbed by " + to_text(shares.size() - max_surfaces + 1, "other surface"), 0.0, "#56B4E9"};
    for (std::size_t k = max_surfaces - 1; k < shares.size(); ++k) others.power += shares[k].power;
    shares.resize(max_surfaces - 1);
    shares.push_back(others);
  }
  if (!measures_all(room) && std::isfinite(b.absorbed))
    shares.push_back({"absorbed by surfaces that are not measured", b.absorbed - of_measured, "#56B4E9"});
  std::string note = "The " + word + " that a surface absorbs is its incident " + word +
                     " times (1 − reflectance); its relative standard error is that of the mean in the table of the "
                     "surfaces. In rooms with textures it is counted photon by photon.";
  if (unknown > 0)
    note += " Backward walks do not determine the " + word + " that " + to_text(unknown, "surface") +
            " with a texture absorb" + (unknown == 1 ? "s." : ".");
  if (std::isfinite(b.absorbed)) {
    if (b.escaped > 0.0) shares.push_back({"escaped through openings", b.escaped, "#E69F00"});
    if (b.residual != 0.0) shares.push_back({"cut off, or net effect of roulette", b.residual, "#CC79A7"});
    if (b.lost > 0.0) shares.push_back({"lost by numerical errors", b.lost, "#D55E00"});
    note += " Sum over all photons: emitted " + short_number(b.emitted) + " " + power + " = absorbed " +
            short_number(b.absorbed) + " + escaped " + short_number(b.escaped) + " + residual " +
            short_number(b.residual) + " + lost " + short_number(b.lost) + ".";
  }
  return heading("Balance of the " + word) + element("figure", shares_svg(shares, b.emitted, power)) +
         text_element("p", note, " class=\"muted\"");
}

std::string convergence_section(const Result& result) {
  LineChart chart;
  chart.title = "Standard error over the number of histories";
  chart.x_label = "photons (tiles), or walks from all receivers (receivers)";
  chart.y_label = "relative standard error (rms), %";
  if (!result.tiles.empty()) chart.series.push_back(series_of("tiles", result.walk.convergence));
  if (!result.receiver_results.empty())
    chart.series.push_back(series_of("receivers", result.receiver_walk.convergence));
  const bool known = std::any_of(chart.series.begin(), chart.series.end(), [](const ChartSeries& series) {
    return std::any_of(series.points.begin(), series.points.end(),
                       [](const ChartPoint& p) { return std::isfinite(p.y) && p.y > 0.0; });
  });
  if (!known) return {};
  std::string sentence = "Four times the number of histories halves the standard error";
  sentence +=
      result.tiles_without_hits > 0
          ? ", after all tiles have been hit. Before, it decreases more slowly, because tiles with few hits are "
            "added. Without a hit: " +
                to_text(result.tiles_without_hits, "tile") + "."
          : ".";
  return heading("Convergence") + element("figure", to_svg(chart)) + text_element("p", sentence, " class=\"muted\"");
}

}  // namespace lichtmc
