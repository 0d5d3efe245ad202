#include "room/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

struct Interval {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
};

Interval extent_along(const glm::dvec2& axis, const FlatTriangle& triangle) {
  Interval interval;
  for (const glm::dvec2& corner : triangle) {
    const double place = glm::dot(axis, corner);
    interval.low = std::min(interval.low, place);
    interval.high = std::max(interval.high, place);
  }
  return interval;
}

// Least shift along the normal of an edge of `edges` that separates the two.
double depth_over_edges(const FlatTriangle& edges, const FlatTriangle& a, const FlatTriangle& b) {
  double depth = std::numeric_limits<double>::max();
  for (std::size_t n = 0; n < 3; ++n) {
    const glm::dvec2 edge = edges[(n + 1) % 3] - edges[n];
    const double length = glm::length(edge);
    if (!(length > 0.0)) continue;
    const glm::dvec2 axis = glm::dvec2(-edge.y, edge.x) / length;
    const Interval one = extent_along(axis, a);
    const Interval two = extent_along(axis, b);
    depth = std::min({depth, one.high - two.low, two.high - one.low});
    if (depth <= 0.0) return depth;
  }
  return depth;
}

std::uint64_t cell_key(std::int64_t x, std::int64_t y) {
  return (static_cast<std::uint64_t>(x) << 32U) ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFU);
}

}  // namespace

double thickness(const FlatTriangle& triangle) {
  const glm::dvec2 b = triangle[1] - triangle[0];
  const glm::dvec2 c = triangle[2] - triangle[0];
  const double longest = std::max({glm::length(b), glm::length(c), glm::length(c - b)});
  return longest > 0.0 ? std::abs(b.x * c.y - b.y * c.x) / longest : 0.0;
}

// The separating axis theorem: the normals of the sides of the Minkowski difference of two convex polygons are those of
// the polygons' own sides, so the shortest separating shift is along one of these six (C. Ericson: Real-Time Collision
// Detection, 2005, section 5.2).
double penetration_depth(const FlatTriangle& a, const FlatTriangle& b) {
  // Coordinates relative to a nearby corner: the tolerance depends on the triangles, not on their position.
  const glm::dvec2 origin = a[0];
  const FlatTriangle near_a{a[0] - origin, a[1] - origin, a[2] - origin};
  const FlatTriangle near_b{b[0] - origin, b[1] - origin, b[2] - origin};
  const double depth = depth_over_edges(near_a, near_a, near_b);
  return depth <= 0.0 ? depth : std::min(depth, depth_over_edges(near_b, near_a, near_b));
}

OverlapIndex::Box OverlapIndex::bounds(const FlatTriangle& triangle) {
  return {glm::min(glm::min(triangle[0], triangle[1]), triangle[2]),
          glm::max(glm::max(triangle[0], triangle[1]), triangle[2])};
}

OverlapIndex::CellRange OverlapIndex::cells(const Box& box, int level) {
  const auto cell = [level](double place) { return static_cast<std::int64_t>(std::floor(std::ldexp(place, -level))); };
  CellRange range{cell(box.low.x), cell(box.low.y), cell(box.high.x), cell(box.high.y), 0.0};
  range.count =
      static_cast<double>(range.high_x - range.low_x + 1) * static_cast<double>(range.high_y - range.low_y + 1);
  return range;
}

bool OverlapIndex::overlap(const Member& candidate, std::uint32_t member) const {
  const Member& other = members_[member];
  if (candidate.box.low.x >= other.box.high.x || other.box.low.x >= candidate.box.high.x) return false;
  if (candidate.box.low.y >= other.box.high.y || other.box.low.y >= candidate.box.high.y) return false;
  return penetration_depth(candidate.triangle, other.triangle) > tolerance_;
}

std::optional<std::size_t> OverlapIndex::find(const Member& candidate, int number, const Level& level) const {
  const CellRange range = cells(candidate.box, number);
  if (range.count > static_cast<double>(level.members.size())) {
    for (const std::uint32_t member : level.members) {
      if (overlap(candidate, member)) return members_[member].id;
    }
    return std::nullopt;
  }
  for (std::int64_t y = range.low_y; y <= range.high_y; ++y) {
    for (std::int64_t x = range.low_x; x <= range.high_x; ++x) {
      const auto chain = level.first_entry.find(cell_key(x, y));
      if (chain == level.first_entry.end()) continue;
      for (std::uint32_t n = chain->second; n != no_entry; n = level.entries[n].next) {
        if (overlap(candidate, level.entries[n].member)) return members_[level.entries[n].member].id;
      }
    }
  }
  return std::nullopt;
}

void OverlapIndex::insert(const Member& member) {
  // Cells at least as large as the triangle: it overlaps four at most.
  const glm::dvec2 size = member.box.high - member.box.low;
  int number = 0;
  std::frexp(std::max(size.x, size.y), &number);
  Level& level = levels_[number];
  const auto index = static_cast<std::uint32_t>(members_.size());
  members_.push_back(member);
  level.members.push_back(index);
  const CellRange range = cells(member.box, number);
  for (std::int64_t y = range.low_y; y <= range.high_y; ++y) {
    for (std::int64_t x = range.low_x; x <= range.high_x; ++x) {
      const auto chain = level.first_entry.try_emplace(cell_key(x, y), no_entry).first;
      level.entries.push_back({index, chain->second});
      chain->second = static_cast<std::uint32_t>(level.entries.size() - 1);
    }
  }
}

// A grid for every size of triangle, a factor of two apart, so that neither a few large triangles nor many small ones
// make it slow (Ericson, section 7.2: hierarchical grids).
std::optional<std::size_t> OverlapIndex::add(const FlatTriangle& triangle, std::size_t id) {
  if (!(thickness(triangle) > tolerance_)) return std::nullopt;
  const Member candidate{triangle, bounds(triangle), id};
  for (const auto& [number, level] : levels_) {
    if (const auto met = find(candidate, number, level)) return met;
  }
  insert(candidate);
  return std::nullopt;
}

}  // namespace lichtmc
