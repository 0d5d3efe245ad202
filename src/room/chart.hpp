// A chart: a surface's triangles in a plane grid of cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "lichtmc/tiles.hpp"

namespace lichtmc {

struct Chart {
  ChartSource source = ChartSource::file;
  std::string reason;          // why the engine made it; empty for ChartSource::file
  glm::dvec2 cells{1.0, 1.0};  // columns and rows: integers ≥ 1, as the tile edge requires
  glm::dvec2 uv_min{0.0};
  glm::dvec2 uv_max{1.0};
  // For every triangle its corners, in cells: 0 … columns, 0 … rows.
  std::vector<std::array<glm::dvec2, 3>> corners;
};

// Number of cells along a length, so that their edges are as close to `edge_m` as possible; at least one.
inline double cells_along(double length_m, double edge_m) {
  return std::max(1.0, std::round(length_m / edge_m));
}

// Transforms the rectangle [low, high] of a plane to cells 0 … cells.
//
// A point within `noise` of a grid line is moved to the line: otherwise rounding could extend a surface beyond the line
// at which it ends, into a tile of almost no area. The noise is limited to a thousandth of a cell: where it is larger,
// the cells are about as fine as the resolution of the coordinates.
class GridTransform {
 public:
  // low < high in both; noise ≥ 0 in the same unit.
  GridTransform(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& cells, double noise)
      : low_(low), size_(high - low), cells_(cells), near_(glm::min(noise / size_ * cells, glm::dvec2(1e-3))) {}

  // Points outside are moved to the boundary.
  glm::dvec2 operator()(const glm::dvec2& place) const {
    const glm::dvec2 cell = glm::clamp((place - low_) / size_ * cells_, glm::dvec2(0.0), cells_);
    const glm::dvec2 line = glm::round(cell);
    return {std::abs(cell.x - line.x) <= near_.x ? line.x : cell.x,
            std::abs(cell.y - line.y) <= near_.y ? line.y : cell.y};
  }

 private:
  glm::dvec2 low_;
  glm::dvec2 size_;
  glm::dvec2 cells_;
  glm::dvec2 near_;
};

}  // namespace lichtmc
