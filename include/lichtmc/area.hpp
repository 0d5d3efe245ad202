// Calculation areas: planes on which lighting engineers ask for the mean illuminance Em, its minimum and its
// uniformity.
//
// An area measures and is not part of the room: it casts no shadow and reflects nothing. It has a grid of cells, and a
// receiver at the centre of each cell (or over the whole cell). The rule for the grid is that of EN 12464-1, see
// lichtmc/lay_areas.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/figure.hpp"

namespace lichtmc {

// What is measured at the points of an area (EN 12665).
enum class AreaQuantity {
  normal,           // on the plane of the area, on the side of its normal
  horizontal,       // on a horizontal plane, from above
  cylindrical,      // on the side of a small vertical cylinder: the mean of the vertical illuminances of all directions
  semicylindrical,  // on the curved side of a small vertical half cylinder that faces a direction
};

// "normal", "horizontal", "cylindrical" or "semicylindrical".
std::string_view to_string(AreaQuantity quantity);

// What a user may say about an area.
struct AreaProperties {
  std::string name;  // unique among the areas of a room; names its files
  std::string role;  // "task", "surrounding", "background", "wall", "ceiling" or any text; may be empty
  // None: horizontal where the plane of the area is level, except for the role "ceiling", else normal.
  std::optional<AreaQuantity> quantity;
  std::optional<glm::dvec3> direction;      // that a half cylinder faces; its level part counts
  std::optional<double> spacing_m;          // m, > 0, greatest spacing of the points; none: the rule of EN 12464-1
  std::optional<double> margin_m;           // m, ≥ 0, see lay_areas.hpp
  bool cells = false;                       // measures the mean over each cell in place of the point at its centre
  std::optional<double> target_lx;          // lx, > 0: of the maintained mean Em
  std::optional<double> target_uniformity;  // 0 … 1: of U0 = Emin/Em
};

// An area that is asked for, before it has a grid: triangles in one plane.
struct AreaRequest {
  AreaProperties properties;
  std::vector<std::array<glm::dvec3, 3>> triangles;  // m; seen from the side of the normal counter-clockwise
};

// Points of a grid that are left out.
struct AreaLeftOut {
  std::string why;  // "outside its outline", "within 0.5 m of a wall", "inside furniture or other bodies", …
  std::uint64_t points = 0;
};

// An area with its grid. Cell (column, row) has its centre at corner + (column + ½) u + (row + ½) v. Seen from the side
// of the normal, u points to the right and v down: u × v = −|u × v| normal.
struct Area {
  AreaProperties properties;  // as asked for
  AreaQuantity quantity = AreaQuantity::horizontal;
  glm::dvec3 corner{0.0};       // m, of the grid
  glm::dvec3 u{1.0, 0.0, 0.0};  // m, edges of a cell, at right angles
  glm::dvec3 v{0.0, 0.0, 1.0};
  glm::dvec3 normal{0.0, 1.0, 0.0};  // length 1
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  // Its points: receivers first_receiver … first_receiver + cells.size() − 1 of the room, in cell cells[k] = row ·
  // columns + column; ascending.
  std::size_t first_receiver = 0;
  std::vector<std::uint32_t> cells;
  std::vector<AreaLeftOut> left_out;               // cells without a point
  double margin_m = 0.0;                           // as used
  std::optional<double> above_floor_m;             // its height, if it is level and has one
  std::vector<std::array<glm::dvec3, 2>> outline;  // m, the lines around it
  std::vector<std::string> notes;  // what else a user should know, sentences: "8 of its points lie on table tops …"

  glm::dvec3 centre(std::uint32_t cell) const {
    return corner + (cell % columns + 0.5) * u + (cell / columns + 0.5) * v;
  }
};

// Whether a figure reaches its target: for certain if the target is at least two standard errors away (19 times out of
// 20).
enum class Verdict { none, pass, fail, undecided };

// "", "pass", "fail" or "undecided".
std::string_view to_string(Verdict verdict);

// The figures of an area. Irradiances in W/m² or lx; they are maintained values: with the power that the emitters have
// after the maintenance factor.
//
// The lowest of many values with errors is too low on average, the highest too high. `minimum` and `maximum` are
// corrected for that (docs/lighting.md); what may be left of it is part of their standard errors. `lowest` and
// `highest` are the plain extremes of the grid.
struct AreaResult {
  Area area;
  Figure mean;        // Em
  Figure minimum;     // Emin
  Figure maximum;     // Emax
  Figure uniformity;  // U0 = Emin/Em
  Figure diversity;   // Ud = Emin/Emax
  double lowest = 0.0;
  double highest = 0.0;
  std::uint32_t lowest_cell = 0;
  std::uint32_t highest_cell = 0;
  // With the power of new emitters: the same as above if no maintenance factor is given.
  Figure initial_mean;
  Figure initial_minimum;
  Figure initial_maximum;
  Verdict mean_verdict = Verdict::none;  // of the maintained mean
  Verdict uniformity_verdict = Verdict::none;
  Verdict verdict = Verdict::none;  // of both
};

}  // namespace lichtmc
