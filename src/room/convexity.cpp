#include "room/convexity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "room/bounds.hpp"

namespace lichtmc {

namespace {

constexpr double most_pairs = 1e9;

bool every_edge_has_two(const WeldedMesh& mesh) {
  bool two = true;
  for_each_edge(mesh.edges(), [&two](std::size_t first, std::size_t end) { two = two && end - first == 2; });
  return two && !mesh.edges().empty();
}

}  // namespace

// All corners on one side of every triangle: the triangles lie on the convex hull of the corners, and a closed surface
// on a convex one is all of it.
bool is_convex(const WeldedMesh& mesh) {
  const double pairs = static_cast<double>(mesh.triangles().size()) * static_cast<double>(mesh.places().size());
  if (pairs > most_pairs || !every_edge_has_two(mesh)) return false;
  Bounds bounds;
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& p : mesh.places()) {
    bounds.add(p);
    middle += p / static_cast<double>(mesh.places().size());
  }
  const glm::dvec3 size = bounds.high - bounds.low;
  const double tolerance = 1e-6 * std::max({size.x, size.y, size.z});
  for (std::size_t n = 0; n < mesh.triangles().size(); ++n) {
    const auto& t = mesh.triangles()[n];
    if (t[0] == t[1]) continue;  // a copy
    const auto& [a, b, c] = mesh.corners(n);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    // The plane of a sliver is uncertain; the planes of its neighbours are tested instead.
    if (length <= tolerance * std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)})) continue;
    const glm::dvec3 outwards = cross / (glm::dot(cross, a - middle) < 0.0 ? -length : length);
    for (const glm::dvec3& p : mesh.places()) {
      if (glm::dot(p - a, outwards) > tolerance) return false;
    }
  }
  return true;
}

}  // namespace lichtmc
