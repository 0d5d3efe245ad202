// Artificial results of calculation areas, without a run.
#pragma once

#include <functional>
#include <string>

#include <glm/vec3.hpp>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc::test {

struct AreaSketch {
  std::string name = "plane";
  std::string role;
  glm::dvec3 corner{0.0};
  glm::dvec3 u{1.0, 0.0, 0.0};  // edges of a cell
  glm::dvec3 v{0.0, 0.0, 1.0};
  glm::dvec3 normal{0.0, 1.0, 0.0};
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  double standard_error = 0.0;  // of each value, and of the figures
  // Which cells have a point; all if empty.
  std::function<bool(std::uint32_t column, std::uint32_t row)> has_point{};
};

// Adds an area with the irradiance value(point) at its points to a result. Its outline is that of its grid. The points
// become receivers of the result. No target; no maintenance.
AreaResult& add_area(Result& result, const AreaSketch& sketch, const std::function<double(const glm::dvec3&)>& value);

// Sets the targets and the verdicts that the values give without regard to their errors.
void set_targets(AreaResult& area, double mean_lx, double uniformity);

}  // namespace lichtmc::test
