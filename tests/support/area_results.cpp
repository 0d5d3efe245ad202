#include "support/area_results.hpp"

#include <cmath>

namespace lichtmc::test {

AreaResult& add_area(Result& result, const AreaSketch& sketch, const std::function<double(const glm::dvec3&)>& value) {
  AreaResult& figures = result.areas.emplace_back();
  Area& area = figures.area;
  area.properties.name = sketch.name;
  area.properties.role = sketch.role;
  area.quantity = std::abs(sketch.normal.y) > 0.5 ? AreaQuantity::horizontal : AreaQuantity::normal;
  area.corner = sketch.corner;
  area.u = sketch.u;
  area.v = sketch.v;
  area.normal = sketch.normal;
  area.columns = sketch.columns;
  area.rows = sketch.rows;
  area.first_receiver = result.receivers.size();
  const glm::dvec3 right = static_cast<double>(sketch.columns) * sketch.u;
  const glm::dvec3 down = static_cast<double>(sketch.rows) * sketch.v;
  const glm::dvec3 a = sketch.corner;
  area.outline = {{a, a + right}, {a + right, a + right + down}, {a + right + down, a + down}, {a + down, a}};
  double sum = 0.0;
  for (std::uint32_t cell = 0; cell < sketch.columns * sketch.rows; ++cell) {
    if (sketch.has_point && !sketch.has_point(cell % sketch.columns, cell / sketch.columns)) continue;
    const glm::dvec3 point = area.centre(cell);
    const double own = value(point);
    if (area.cells.empty() || own < figures.lowest) figures.lowest = own, figures.lowest_cell = cell;
    if (area.cells.empty() || own > figures.highest) figures.highest = own, figures.highest_cell = cell;
    area.cells.push_back(cell);
    sum += own;
    result.receivers.push_back({.name = sketch.name, .position = point, .normal = sketch.normal});
    result.receiver_results.push_back(
        {.irradiance = own, .direct = own, .indirect = 0.0, .standard_error = sketch.standard_error});
  }
  const double error = sketch.standard_error;
  if (const std::size_t missing = sketch.columns * sketch.rows - area.cells.size(); missing > 0)
    area.left_out.push_back({"inside furniture or other bodies", missing});
  const double mean = sum / static_cast<double>(area.cells.size());
  figures.mean = figures.initial_mean = {mean, error};
  figures.minimum = figures.initial_minimum = {figures.lowest, error};
  figures.maximum = figures.initial_maximum = {figures.highest, error};
  figures.uniformity = {figures.lowest / mean, error / mean};
  figures.diversity = {figures.lowest / figures.highest, error / figures.highest};
  return figures;
}

void set_targets(AreaResult& area, double mean_lx, double uniformity) {
  area.area.properties.target_lx = mean_lx;
  area.area.properties.target_uniformity = uniformity;
  area.mean_verdict = area.mean.value >= mean_lx ? lichtmc::Verdict::pass : lichtmc::Verdict::fail;
  area.uniformity_verdict = area.uniformity.value >= uniformity ? lichtmc::Verdict::pass : lichtmc::Verdict::fail;
  const bool both = area.mean_verdict == lichtmc::Verdict::pass && area.uniformity_verdict == lichtmc::Verdict::pass;
  area.verdict = both ? lichtmc::Verdict::pass : lichtmc::Verdict::fail;
}

}  // namespace lichtmc::test
