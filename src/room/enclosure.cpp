#include "room/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_map>

#include <glm/geometric.hpp>

#include "base/disjoint_sets.hpp"
#include "base/frame.hpp"
#include "room/sorted_points.hpp"

namespace lichtmc {

namespace {

// Of rays that test whether a point is inside: with no simple relation to a room's edges.
const glm::dvec3 first_direction(0.57735, 0.21132, 0.78868);

// Crossings of the ray from `start` along `direction` with a triangle: 0 or 1; nothing if it comes so close to an edge
// that rounding would determine the result.
std::optional<int> crossings(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& start,
                             const glm::dvec3& direction) {
  const glm::dvec3 b = triangle[1] - triangle[0];
  const glm::dvec3 c = triangle[2] - triangle[0];
  const glm::dvec3 p = glm::cross(direction, c);
  const double determinant = glm::dot(b, p);
  if (determinant == 0.0) return 0;  // parallel to its plane
  // The area of a triangle this thin is only rounding, and a ray hits it once in 10¹².
  const double longest = std::max(glm::length(b), glm::length(c));
  if (glm::length(glm::cross(b, c)) <= 1e-12 * longest * longest) return 0;
  const glm::dvec3 from_corner = start - triangle[0];
  const glm::dvec3 q = glm::cross(from_corner, b);
  const double s = glm::dot(from_corner, p) / determinant;
  const double t = glm::dot(direction, q) / determinant;
  const double nearest = std::min({s, t, 1.0 - s - t});
  // s and t are sums of some six products, each rounded, over the determinant: uncertain for slivers and grazing rays.
  // The additional 10⁻⁹ is so small that rays in a fixed direction rarely come that close.
  const double products = glm::length(from_corner) * glm::length(direction) * longest / std::abs(determinant);
  const double near_an_edge = 1e-9 + 16.0 * std::numeric_limits<double>::epsilon() * products;
  if (nearest < -near_an_edge) return 0;
  if (nearest < near_an_edge) return std::nullopt;
  return glm::dot(c, q) / determinant > 0.0 ? 1 : 0;
}

}  // namespace

Enclosure::Enclosure(const WeldedMesh& mesh) : room_(&mesh.room()) {
  // Triangles that share an edge form a group; one edge with an odd number of triangles makes the group open.
  const std::vector<WeldedEdge>& edges = mesh.edges();
  DisjointSets<std::size_t> groups(mesh.triangles().size());
  std::vector<std::size_t> odd;
  for_each_edge(edges, [&](std::size_t first, std::size_t end) {
    for (std::size_t n = first; n < end; ++n) groups.join(edges[first].triangle, edges[n].triangle);
    if ((end - first) % 2 != 0) odd.push_back(edges[first].triangle);
  });
  std::vector<bool> open(mesh.triangles().size(), false);
  for (const std::size_t n : odd) open[groups.find(n)] = true;

  std::unordered_map<std::size_t, std::size_t> shell_of_group;
  for (const WeldedEdge& edge : edges) {
    const std::size_t group = groups.find(edge.triangle);
    if (!open[group]) shell_of_group.try_emplace(group, shell_of_group.size());
  }
  shells_.resize(shell_of_group.size());
  std::size_t n = 0;
  for (std::uint32_t k = 0; k < room_->surfaces.size(); ++k) {
    for (std::uint32_t t = 0; t < room_->surfaces[k].triangles.size(); ++t, ++n) {
      const auto shell = shell_of_group.find(groups.find(n));
      if (shell != shell_of_group.end()) shells_[shell->second].push_back({k, t});
    }
  }
}

WeldedMesh::Corners Enclosure::corners(const Face& face) const {
  const Surface& surface = room_->surfaces[face.surface];
  const glm::uvec3 t = surface.triangles[face.triangle];
  return {surface.positions[t.x], surface.positions[t.y], surface.positions[t.z]};
}

bool Enclosure::is_inside(const Shell& shell, const glm::dvec3& point_m) const {
  // The next direction if a ray comes too close to an edge of the mesh.
  glm::dvec3 direction = first_direction;
  for (int attempt = 0; attempt < 16; ++attempt) {
    int sum = 0;
    bool sure = true;
    for (const Face& face : shell) {
      const std::optional<int> count = crossings(corners(face), point_m, direction);
      sure = sure && count.has_value();
      sum += count.value_or(0);
    }
    if (sure) return sum % 2 != 0;
    direction = glm::dvec3(direction.y + 0.1, direction.z - 0.3, -direction.x);
  }
  return false;
}

std::vector<std::size_t> Enclosure::shells_around(const glm::dvec3& point_m) const {
  std::vector<std::size_t> around;
  for (std::size_t k = 0; k < shells_.size(); ++k) {
    if (is_inside(shells_[k], point_m)) around.push_back(k);
  }
  return around;
}

// Seen along the direction of the rays, a triangle can only be crossed by rays from points in its bounding rectangle.
std::vector<std::vector<std::size_t>> Enclosure::shells_around_each(const std::vector<glm::dvec3>& points_m) const {
  const Frame frame = frame_about(glm::normalize(first_direction));
  const auto seen = [&frame](const glm::dvec3& p) {
    return glm::dvec3(glm::dot(p, frame.tangent), glm::dot(p, frame.bitangent), 0.0);
  };
  std::vector<glm::dvec3> flat;
  for (const glm::dvec3& point : points_m) flat.push_back(seen(point));
  const SortedPoints sorted(flat);
  std::vector<std::vector<std::size_t>> around(points_m.size());
  for (std::size_t number = 0; number < shells_.size(); ++number) {
    const Shell& shell = shells_[number];
    std::vector<std::optional<int>> sums(points_m.size(), 0);
    for (const Face& face : shell) {
      const WeldedMesh::Corners triangle = corners(face);
      Bounds box;
      for (const glm::dvec3& corner : triangle) box.add(seen(corner));
      // crossings() is uncertain within 10⁻⁹ of a triangle's size, and some roundings of the coordinates.
      const double rounding = 1e-12 * std::max(glm::length(box.low), glm::length(box.high));
      const double margin = 1e-8 * glm::length(box.high - box.low) + rounding;
      box.low -= margin;
      box.high += margin;
      sorted.for_each_in(box, [&](std::size_t k) {
        const std::optional<int> count = crossings(triangle, points_m[k], first_direction);
        sums[k] = sums[k] && count ? std::optional(*sums[k] + *count) : std::nullopt;
      });
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
      if (sums[k] ? *sums[k] % 2 != 0 : is_inside(shell, points_m[k])) around[k].push_back(number);
    }
  }
  return around;
}

bool Enclosure::has_shell_over(const Bounds& box, double slack) const {
  return std::any_of(shells_.begin(), shells_.end(), [&](const Shell& shell) {
    Bounds own;
    for (const Face& face : shell) {
      for (const glm::dvec3& corner : corners(face)) own.add(corner);
    }
    return own.holds(box.low, slack) && own.holds(box.high, slack);
  });
}

}  // namespace lichtmc
