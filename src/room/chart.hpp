// A chart: a surface's triangles laid flat on a grid of cells.
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
  glm::dvec2 cells{1.0, 1.0};  // columns and rows: whole numbers ≥ 1, as large as the tile edge asks for
  glm::dvec2 uv_min{0.0};
  glm::dvec2 uv_max{1.0};
  // For every triangle its corners, in cells: 0 … columns, 0 … rows.
  std::vector<std::array<glm::dvec2, 3>> corners;
};

// How many cells a length gets: as many as make their edges closest to `edge_m`, at least one.
inline double cells_along(double length_m, double edge_m) {
  return std::max(1.0, std::round(length_m / edge_m));
}

// Lays the piece of plane [low, high] on cells 0 … cells.
//
// A place that is on a grid line but for `noise` is put on the line: rounding must not push the rim of a surface into a
// cell that it ends at, which would be a tile of next to no area. The noise counts up to a thousandth of a cell; where
// it is larger than that, the cells are about as fine as the coordinates themselves.
class GridMap {
 public:
  // low < high in both; noise ≥ 0 in the same unit.
  GridMap(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& cells, double noise)
      : low_(low), size_(high - low), cells_(cells), near_(glm::min(noise / size_ * cells, glm::dvec2(1e-3))) {}

  // Places outside are put on the rim.
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
