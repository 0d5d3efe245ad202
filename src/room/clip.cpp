#include "room/clip.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lichtmc {

namespace {

// Shares up to this are rounding: the error of a share is some 1e-16, and if a triangle covers all cells that a room
// may have (2^31), each cell inside it has 5e-10.
constexpr double least_share = 1e-12;

struct Corner {
  glm::dvec2 cell{0.0};
  glm::dvec2 weight{0.0};  // barycentric coordinates of the second and third corner of the triangle
};

// A convex polygon. A triangle clipped by four lines has at most seven corners; rounding may add a few.
class Polygon {
 public:
  void add(const Corner& corner) {
    assert(size_ < corners_.size());
    if (size_ < corners_.size()) corners_[size_++] = corner;
  }
  std::size_t size() const { return size_; }
  const Corner& operator[](std::size_t n) const { return corners_[n]; }
  const Corner* begin() const { return corners_.data(); }
  const Corner* end() const { return corners_.data() + size_; }

 private:
  std::array<Corner, 16> corners_;
  std::size_t size_ = 0;
};

Corner cut(const Corner& a, const Corner& b, int axis, double line) {
  const double t = (line - a.cell[axis]) / (b.cell[axis] - a.cell[axis]);
  Corner point{a.cell + t * (b.cell - a.cell), a.weight + t * (b.weight - a.weight)};
  point.cell[axis] = line;
  return point;
}

// The part of a polygon with low ≤ coordinate ≤ high. A cut depends on the side and the line alone: two neighbouring
// bands share exactly the same cuts, and their areas add up.
Polygon band(const Polygon& polygon, int axis, double low, double high) {
  Polygon part;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Corner& a = polygon[n];
    const Corner& b = polygon[(n + 1) % polygon.size()];
    const double from = a.cell[axis];
    const double to = b.cell[axis];
    if (from >= low && from <= high) part.add(a);
    if (from < low && to > low) part.add(cut(a, b, axis, low));
    if ((from < high && to > high) || (from > high && to < high)) part.add(cut(a, b, axis, high));
    if (from > low && to < low) part.add(cut(a, b, axis, low));
  }
  return part;
}

struct CellRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

// The cells that a polygon covers along an axis; one that ends on a grid line does not cover the cell beyond.
CellRange cells_of(const Polygon& polygon, int axis, std::uint32_t count) {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const Corner& corner : polygon) {
    low = std::min(low, corner.cell[axis]);
    high = std::max(high, corner.cell[axis]);
  }
  const double end = static_cast<double>(count - 1);
  const auto first = static_cast<std::uint32_t>(std::clamp(std::floor(low), 0.0, end));
  const auto last = static_cast<std::uint32_t>(std::clamp(std::ceil(high) - 1.0, 0.0, end));
  return {first, std::max(first, last)};
}

// Calls use(cell, part) for the part of a polygon in each cell along an axis.
template <class Use>
void for_each_band(const Polygon& polygon, int axis, std::uint32_t count, const Use& use) {
  const CellRange range = cells_of(polygon, axis, count);
  if (range.first == range.last) return use(range.first, polygon);
  constexpr double far = std::numeric_limits<double>::max();
  for (std::uint32_t n = range.first; n <= range.last; ++n) {
    const double low = n == range.first ? -far : static_cast<double>(n);
    const double high = n == range.last ? far : static_cast<double>(n) + 1.0;
    const Polygon part = band(polygon, axis, low, high);
    if (part.size() > 0) use(n, part);
  }
}

// Share and centroid of a polygon, in barycentric coordinates: these distinguish its parts also if the triangle is a
// line or a point in the chart. The triangle's own area is ½ there.
CellPiece measure(const Polygon& polygon) {
  double doubled = 0.0;
  glm::dvec2 moment(0.0);
  for (std::size_t n = 1; n + 1 < polygon.size(); ++n) {
    const glm::dvec2 b = polygon[n].weight - polygon[0].weight;
    const glm::dvec2 c = polygon[n + 1].weight - polygon[0].weight;
    const double cross = b.x * c.y - b.y * c.x;
    doubled += cross;
    moment += std::max(cross, 0.0) * (b + c) / 3.0;
  }
  CellPiece piece;
  piece.share = std::max(doubled, 0.0);
  glm::dvec2 weight = polygon[0].weight;
  if (piece.share > 0.0) weight += moment / piece.share;
  piece.centroid = {1.0 - weight.x - weight.y, weight.x, weight.y};
  return piece;
}

// Calls use(column, row, part) for the part of a triangle in each cell.
template <class Use>
void for_each_cell(const std::array<glm::dvec2, 3>& corners, std::uint32_t columns, std::uint32_t rows,
                   const Use& use) {
  Polygon triangle;
  triangle.add({corners[0], {0.0, 0.0}});
  triangle.add({corners[1], {1.0, 0.0}});
  triangle.add({corners[2], {0.0, 1.0}});
  for_each_band(triangle, 0, columns, [&](std::uint32_t column, const Polygon& slice) {
    for_each_band(slice, 1, rows, [&](std::uint32_t row, const Polygon& part) { use(column, row, part); });
  });
}

}  // namespace

void clip_to_cells(const std::array<glm::dvec2, 3>& corners, std::uint32_t columns, std::uint32_t rows,
                   std::vector<CellPiece>& pieces) {
  pieces.clear();
  double rest = 0.0;  // shares that are not assigned to a piece yet
  for_each_cell(corners, columns, rows, [&](std::uint32_t column, std::uint32_t row, const Polygon& part) {
    CellPiece piece = measure(part);
    piece.column = column;
    piece.row = row;
    if (piece.share > least_share) {
      piece.share += rest;
      rest = 0.0;
      pieces.push_back(piece);
    } else if (pieces.empty()) {
      rest += piece.share;
    } else {
      pieces.back().share += piece.share;
    }
  });
}

void cut_into_triangles(const std::array<glm::dvec2, 3>& corners, std::uint32_t columns, std::uint32_t rows,
                        std::vector<CellTriangle>& triangles) {
  triangles.clear();
  for_each_cell(corners, columns, rows, [&](std::uint32_t column, std::uint32_t row, const Polygon& part) {
    if (!(measure(part).share > least_share)) return;
    for (std::size_t n = 1; n + 1 < part.size(); ++n) {
      CellTriangle one{column, row, 0.0, {part[0].weight, part[n].weight, part[n + 1].weight}};
      const glm::dvec2 b = one.weights[1] - one.weights[0];
      const glm::dvec2 c = one.weights[2] - one.weights[0];
      one.share = b.x * c.y - b.y * c.x;
      if (one.share > 0.0) triangles.push_back(one);
    }
  });
}

}  // namespace lichtmc
