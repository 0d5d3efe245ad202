#include "room/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

// Disjoint sets with path halving.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

// Gives positions within a distance of each other the same number.
class Welder {
 public:
  Welder(const glm::dvec3& low, double distance) : low_(low), distance_(distance) {}

  std::uint32_t number(const glm::dvec3& position) {
    const glm::dvec3 cell = glm::floor((position - low_) / distance_);
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        for (int k = -1; k <= 1; ++k) {
          const auto range = cells_.equal_range(key(cell + glm::dvec3(i, j, k)));
          for (auto entry = range.first; entry != range.second; ++entry) {
            if (glm::length(positions_[entry->second] - position) <= distance_) return entry->second;
          }
        }
      }
    }
    const auto fresh = static_cast<std::uint32_t>(positions_.size());
    positions_.push_back(position);
    cells_.emplace(key(cell), fresh);
    return fresh;
  }

 private:
  // A hash of the cell's coordinates, which are below 10⁶ + 2 in size; equal hashes of different cells only cost time.
  static std::uint64_t key(const glm::dvec3& cell) {
    const auto part = [](double c) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(c) + 2); };
    return part(cell.x) | part(cell.y) << 21 | part(cell.z) << 42;
  }

  glm::dvec3 low_;
  double distance_;
  std::vector<glm::dvec3> positions_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

struct Edge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::size_t triangle = 0;
};

bool same_edge(const Edge& a, const Edge& b) {
  return a.from == b.from && a.to == b.to;
}

using Welded = std::array<std::uint32_t, 3>;

// Leaves one of triangles with the same corners: a wall that is there twice, as exporters write one for each side,
// stops light once, and its copies must not count as a shell. The others keep no corners of their own.
void drop_copies(std::vector<Welded>& corners) {
  const auto sorted = [&corners](std::size_t n) {
    Welded c = corners[n];
    std::sort(c.begin(), c.end());
    return c;
  };
  std::vector<std::pair<Welded, std::size_t>> order;
  order.reserve(corners.size());
  for (std::size_t n = 0; n < corners.size(); ++n) order.emplace_back(sorted(n), n);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].first == order[i - 1].first) corners[order[i].second] = {0, 0, 0};
  }
}

// Edges of welded triangles, equal ones side by side. Triangles that welding has left without three corners have none.
std::vector<Edge> sorted_edges(const std::vector<Welded>& corners) {
  std::vector<Edge> edges;
  edges.reserve(3 * corners.size());
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const auto& c = corners[n];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({std::min(c[k], c[(k + 1) % 3]), std::max(c[k], c[(k + 1) % 3]), n});
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
  return edges;
}

// Crossings of the ray from `start` along `direction` with a triangle: 0 or 1; nothing where it comes so close to an
// edge that rounding decides.
std::optional<int> crossings(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& start,
                             const glm::dvec3& direction) {
  const glm::dvec3 b = triangle[1] - triangle[0];
  const glm::dvec3 c = triangle[2] - triangle[0];
  const glm::dvec3 p = glm::cross(direction, c);
  const double determinant = glm::dot(b, p);
  if (determinant == 0.0) return 0;  // along its plane
  // What is that thin has no area but rounding's, and a ray meets it once in 10¹².
  const double longest = std::max(glm::length(b), glm::length(c));
  if (glm::length(glm::cross(b, c)) <= 1e-12 * longest * longest) return 0;
  const glm::dvec3 from_corner = start - triangle[0];
  const glm::dvec3 q = glm::cross(from_corner, b);
  const double s = glm::dot(from_corner, p) / determinant;
  const double t = glm::dot(direction, q) / determinant;
  const double nearest = std::min({s, t, 1.0 - s - t});
  // s and t are sums of some six products, each rounded, over the determinant: uncertain for slivers and grazing rays.
  // 10⁻⁹ more is far below what rays in a fixed direction often meet.
  const double products = glm::length(from_corner) * glm::length(direction) * longest / std::abs(determinant);
  const double near_an_edge = 1e-9 + 16.0 * std::numeric_limits<double>::epsilon() * products;
  if (nearest < -near_an_edge) return 0;
  if (nearest < near_an_edge) return std::nullopt;
  return glm::dot(c, q) / determinant > 0.0 ? 1 : 0;
}

}  // namespace

Enclosure::Enclosure(const Room& room) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  std::vector<Triangle> triangles;
  for (const Surface& surface : room.surfaces) {
    for (const glm::uvec3& t : surface.triangles) {
      triangles.push_back({surface.positions[t.x], surface.positions[t.y], surface.positions[t.z]});
      for (const glm::dvec3& position : triangles.back()) {
        low = glm::min(low, position);
        high = glm::max(high, position);
      }
    }
  }
  const glm::dvec3 size = high - low;
  const double distance = 1e-6 * std::max({size.x, size.y, size.z});
  if (triangles.empty() || !(distance > 0.0)) return;

  Welder welder(low, distance);
  std::vector<Welded> corners;
  corners.reserve(triangles.size());
  for (const Triangle& t : triangles)
    corners.push_back({welder.number(t[0]), welder.number(t[1]), welder.number(t[2])});
  drop_copies(corners);

  // Triangles that share an edge belong together; one odd edge opens all of them.
  const std::vector<Edge> edges = sorted_edges(corners);
  Groups groups(triangles.size());
  std::vector<std::size_t> odd;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    for (; end < edges.size() && same_edge(edges[i], edges[end]); ++end)
      groups.join(edges[i].triangle, edges[end].triangle);
    if ((end - i) % 2 != 0) odd.push_back(edges[i].triangle);
    i = end;
  }
  std::vector<bool> open(triangles.size(), false);
  for (const std::size_t n : odd) open[groups.find(n)] = true;

  std::unordered_map<std::size_t, std::size_t> shell_of_group;
  for (const Edge& edge : edges) {
    const std::size_t group = groups.find(edge.triangle);
    if (!open[group]) shell_of_group.try_emplace(group, shell_of_group.size());
  }
  shells_.resize(shell_of_group.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const auto shell = shell_of_group.find(groups.find(n));
    if (shell != shell_of_group.end()) shells_[shell->second].push_back(triangles[n]);
  }
}

bool Enclosure::encloses(const glm::dvec3& point_m) const {
  const auto inside = [&point_m](const Shell& shell) {
    // Directions with no simple relation to a room's edges; another where one comes too close to an edge of the mesh.
    glm::dvec3 direction(0.57735, 0.21132, 0.78868);
    for (int attempt = 0; attempt < 16; ++attempt) {
      int sum = 0;
      bool sure = true;
      for (const Triangle& triangle : shell) {
        const std::optional<int> count = crossings(triangle, point_m, direction);
        sure = sure && count.has_value();
        sum += count.value_or(0);
      }
      if (sure) return sum % 2 != 0;
      direction = glm::dvec3(direction.y + 0.1, direction.z - 0.3, -direction.x);
    }
    return false;
  };
  return std::any_of(shells_.begin(), shells_.end(), inside);
}

}  // namespace lichtmc
