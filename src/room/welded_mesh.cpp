#include "room/welded_mesh.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/bounds.hpp"

namespace lichtmc {

namespace {

// Gives positions within a distance of each other the same number.
class Welder {
 public:
  Welder(const glm::dvec3& low, double distance, std::vector<glm::dvec3>& places)
      : low_(low), distance_(distance), places_(places) {}

  std::uint32_t number(const glm::dvec3& position) {
    const glm::dvec3 cell = glm::floor((position - low_) / distance_);
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        for (int k = -1; k <= 1; ++k) {
          const auto range = cells_.equal_range(key(cell + glm::dvec3(i, j, k)));
          for (auto entry = range.first; entry != range.second; ++entry) {
            if (glm::length(places_[entry->second] - position) <= distance_) return entry->second;
          }
        }
      }
    }
    const auto fresh = static_cast<std::uint32_t>(places_.size());
    places_.push_back(position);
    cells_.emplace(key(cell), fresh);
    return fresh;
  }

 private:
  // A hash of the cell's coordinates, which are below 10⁶ + 2 in size; equal hashes of different cells cost only time.
  static std::uint64_t key(const glm::dvec3& cell) {
    const auto part = [](double c) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(c) + 2); };
    return part(cell.x) | part(cell.y) << 21 | part(cell.z) << 42;
  }

  glm::dvec3 low_;
  double distance_;
  std::vector<glm::dvec3>& places_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

bool has_three_corners(const WeldedMesh::Triangle& t) {
  return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

// Keeps one of several triangles with the same corners; the others get three equal corners.
std::vector<std::size_t> drop_copies(std::vector<WeldedMesh::Triangle>& triangles) {
  std::vector<std::pair<WeldedMesh::Triangle, std::size_t>> order;
  order.reserve(triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    if (!has_three_corners(triangles[n])) continue;
    order.emplace_back(triangles[n], n);
    std::sort(order.back().first.begin(), order.back().first.end());
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> copies;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].first != order[i - 1].first) continue;
    copies.push_back(order[i].second);
    triangles[order[i].second] = {0, 0, 0};
  }
  std::sort(copies.begin(), copies.end());
  return copies;
}

std::vector<WeldedEdge> sorted_edges(const std::vector<WeldedMesh::Triangle>& triangles) {
  std::vector<WeldedEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const auto& c = triangles[n];
    if (!has_three_corners(c)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({std::min(c[k], c[(k + 1) % 3]), std::max(c[k], c[(k + 1) % 3]), n});
  }
  std::sort(edges.begin(), edges.end(),
            [](const WeldedEdge& a, const WeldedEdge& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
  return edges;
}

}  // namespace

WeldedMesh::WeldedMesh(const Room& room) {
  for (const Surface& surface : room.surfaces) {
    for (const glm::uvec3& t : surface.triangles)
      corners_.push_back({surface.positions[t.x], surface.positions[t.y], surface.positions[t.z]});
  }
  triangles_.resize(corners_.size(), {0, 0, 0});
  const Bounds bounds = bounds_of(room);
  const glm::dvec3 size = bounds.high - bounds.low;
  const double distance = 1e-6 * std::max({size.x, size.y, size.z});
  if (corners_.empty() || !(distance > 0.0)) return;

  Welder welder(bounds.low, distance, places_);
  std::size_t n = 0;
  std::vector<std::uint32_t> numbers;  // of a surface's positions, which triangles share
  constexpr std::uint32_t none = 0xFFFFFFFF;
  for (const Surface& surface : room.surfaces) {
    numbers.assign(surface.positions.size(), none);
    for (const glm::uvec3& t : surface.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& number = numbers[t[static_cast<glm::length_t>(k)]];
        if (number == none) number = welder.number(corners_[n][k]);
        triangles_[n][k] = number;
      }
      ++n;
    }
  }
  copies_ = drop_copies(triangles_);
  edges_ = sorted_edges(triangles_);
}

}  // namespace lichtmc
