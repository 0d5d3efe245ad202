#include "room/welded_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/bounds.hpp"
#include "room/sort_in_groups.hpp"

namespace lichtmc {

namespace {

// Gives positions within a distance of each other the same number: that of the first of them.
class Welder {
 public:
  Welder(const glm::dvec3& low, double distance, std::size_t positions, std::vector<glm::dvec3>& places)
      : low_(low), distance_(distance), places_(places), first_(std::bit_ceil(2 * positions + 1), none) {}

  std::uint32_t number(const glm::dvec3& position) {
    const glm::dvec3 at = (position - low_) / (cell_size * distance_);
    // The cells that a place within the distance can lie in: most often one. The step is a little longer than the
    // distance, for rounding.
    constexpr double step = 1.001 / cell_size;
    const Cell from = cell_of(at - step);
    const Cell to = cell_of(at + step);
    std::uint32_t found = none;
    for (std::int64_t x = from[0]; x <= to[0]; ++x) {
      for (std::int64_t y = from[1]; y <= to[1]; ++y) {
        for (std::int64_t z = from[2]; z <= to[2]; ++z) found = std::min(found, nearby(bucket_of({x, y, z}), position));
      }
    }
    if (found != none) return found;
    const auto fresh = static_cast<std::uint32_t>(places_.size());
    std::uint32_t& first = first_[bucket_of(cell_of(at))];
    places_.push_back(position);
    next_.push_back(first);
    first = fresh;
    return fresh;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  static constexpr double cell_size = 16.0;  // distances

  static Cell cell_of(const glm::dvec3& at) {
    const auto part = [](double c) { return static_cast<std::int64_t>(std::floor(c)); };
    return {part(at.x), part(at.y), part(at.z)};
  }
  // Cells share buckets by chance, which costs time only: distances decide. The factor spreads neighbours (2⁶⁴ over the
  // golden ratio).
  std::size_t bucket_of(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t part : cell) hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15U;
    return (hash >> 32U) & (first_.size() - 1);
  }
  std::uint32_t nearby(std::size_t bucket, const glm::dvec3& position) const {
    std::uint32_t found = none;
    for (std::uint32_t n = first_[bucket]; n != none; n = next_[n]) {
      if (glm::length(places_[n] - position) <= distance_) found = std::min(found, n);
    }
    return found;
  }

  glm::dvec3 low_;
  double distance_;
  std::vector<glm::dvec3>& places_;
  std::vector<std::uint32_t> first_;  // place of each bucket, the newest
  std::vector<std::uint32_t> next_;   // in the bucket of each place
};

bool has_three_corners(const WeldedMesh::Triangle& t) {
  return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

// Keeps one of several triangles with the same corners; the others get three equal corners.
std::vector<std::size_t> drop_copies(std::vector<WeldedMesh::Triangle>& triangles, std::size_t places,
                                     unsigned threads) {
  std::vector<std::pair<WeldedMesh::Triangle, std::size_t>> order;
  order.reserve(triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    if (!has_three_corners(triangles[n])) continue;
    order.emplace_back(triangles[n], n);
    std::sort(order.back().first.begin(), order.back().first.end());
  }
  sort_in_groups(
      order, places, [](const auto& one) { return one.first[0]; }, std::less<>(), threads);
  std::vector<std::size_t> copies;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].first != order[i - 1].first) continue;
    copies.push_back(order[i].second);
    triangles[order[i].second] = {0, 0, 0};
  }
  std::sort(copies.begin(), copies.end());
  return copies;
}

std::vector<WeldedEdge> sorted_edges(const std::vector<WeldedMesh::Triangle>& triangles, std::size_t places,
                                     unsigned threads) {
  std::vector<WeldedEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const auto& c = triangles[n];
    if (!has_three_corners(c)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({std::min(c[k], c[(k + 1) % 3]), std::max(c[k], c[(k + 1) % 3]), n});
  }
  sort_in_groups(
      edges, places, [](const WeldedEdge& edge) { return edge.from; },
      [](const WeldedEdge& a, const WeldedEdge& b) {
        return std::pair(a.to, a.triangle) < std::pair(b.to, b.triangle);
      },
      threads);
  return edges;
}

}  // namespace

WeldedMesh::WeldedMesh(const Room& room, unsigned threads) : room_(&room) {
  std::size_t count = 0;
  for (const Surface& surface : room.surfaces) {
    first_.push_back(count);
    count += surface.triangles.size();
  }
  triangles_.resize(count, {0, 0, 0});
  const Bounds bounds = bounds_of(room);
  const glm::dvec3 size = bounds.high - bounds.low;
  const double distance = 1e-6 * std::max({size.x, size.y, size.z});
  if (triangles_.empty() || !(distance > 0.0)) return;

  std::size_t positions = 0;
  for (const Surface& surface : room.surfaces) positions += surface.positions.size();
  Welder welder(bounds.low, distance, positions, places_);
  std::size_t n = 0;
  std::vector<std::uint32_t> numbers;  // of a surface's positions, which triangles share
  constexpr std::uint32_t none = 0xFFFFFFFF;
  for (const Surface& surface : room.surfaces) {
    numbers.assign(surface.positions.size(), none);
    for (const glm::uvec3& t : surface.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = t[static_cast<glm::length_t>(k)];
        std::uint32_t& number = numbers[corner];
        if (number == none) number = welder.number(surface.positions[corner]);
        triangles_[n][k] = number;
      }
      ++n;
    }
  }
  copies_ = drop_copies(triangles_, places_.size(), threads);
  edges_ = sorted_edges(triangles_, places_.size(), threads);
}

WeldedMesh::Corners WeldedMesh::corners(std::size_t triangle) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), triangle);
  const auto k = static_cast<std::size_t>(after - first_.begin()) - 1;
  const Surface& surface = room_->surfaces[k];
  const glm::uvec3 t = surface.triangles[triangle - first_[k]];
  return {surface.positions[t.x], surface.positions[t.y], surface.positions[t.z]};
}

}  // namespace lichtmc
