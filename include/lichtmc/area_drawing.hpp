// A calculation area as it lies on a sheet: its grid, the room around it and its isolux lines. For the plan as SVG and
// as DXF.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

using SheetLine = std::array<glm::dvec2, 2>;

// Level areas are drawn from above, others from the side of their normal. The sides of the cells are the directions of
// the sheet: "to the right" is the side that comes nearest to +x on level areas, to the horizontal on others. A point p
// (m) of the room is at (p · right, p · down) on the sheet, in m.
struct AreaDrawing {
  bool level = true;
  glm::dvec3 right{1.0, 0.0, 0.0};  // length 1
  glm::dvec3 down{0.0, 0.0, 1.0};
  // Direction of −z (level areas) or upwards (others).
  glm::dvec2 arrow{0.0, -1.0};
  // The grid: its upper left corner and the size of a cell, m; then of each cell, row by row, whether it has a point
  // and, if so, the value and its standard error.
  glm::dvec2 corner{0.0};
  glm::dvec2 cell{1.0};
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<bool> has_point;
  std::vector<double> values;  // W/m² or lx
  std::vector<double> errors;
  std::vector<bool> inside;  // of each cell: its centre is inside the outline of the area
  std::size_t lowest_cell = 0;
  std::size_t highest_cell = 0;
  std::vector<SheetLine> outline;  // of the area
  std::vector<SheetLine> section;  // of the room at the height of the area, if it is level; in no order
  std::vector<Isoline> isolines;   // m on the sheet; of one level after the other
  std::string why_no_isolines;     // a sentence, if there are none

  glm::dvec2 on_sheet(const glm::dvec3& point) const { return {glm::dot(point, right), glm::dot(point, down)}; }
  // The lower right corner of the grid, and the centre of a cell, m.
  glm::dvec2 end() const { return corner + cell * glm::dvec2(static_cast<double>(columns), static_cast<double>(rows)); }
  glm::dvec2 centre(std::size_t k) const {
    return corner + cell * (glm::dvec2(static_cast<double>(k % columns), static_cast<double>(k / columns)) + 0.5);
  }
  // The upper left corner of the grid in the room, m.
  glm::dvec3 upper_left(const Area& area) const;
  // The lines around the area; around the grid if it has none.
  std::vector<SheetLine> outline_or_grid() const;
  // The box around these.
  SheetLine box() const;
};

// Draws Result::areas[area].
AreaDrawing draw_area(const Room& room, const Result& result, std::size_t area);

// A colour scale for the plan of Result::areas[area]: by choose_scale()'s rule from the values at its points.
ColourScale choose_area_scale(const Result& result, std::size_t area, const ScaleOptions& options = {});

}  // namespace lichtmc
