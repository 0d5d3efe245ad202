#include "room/surface_pieces.hpp"

#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include "room/mesh_links.hpp"

namespace lichtmc {

SurfacePieces pieces_of(const Surface& surface) {
  const MeshLinks links(surface);
  const std::size_t triangles = surface.triangles.size();
  std::vector<std::size_t> first(triangles);  // a triangle of the same piece with a number that is not higher
  std::iota(first.begin(), first.end(), std::size_t{0});
  const auto root = [&](std::size_t k) {
    while (first[k] != k) k = first[k] = first[first[k]];
    return k;
  };
  SurfacePieces pieces;
  pieces.count = triangles;
  pieces.closed = triangles > 0;
  double down = 0.0;
  double area = 0.0;
  for (std::size_t k = 0; k < triangles; ++k) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const auto sharing = links.at_edge(k, edge);
      pieces.closed = pieces.closed && sharing.size() == 2;
      for (const std::uint32_t other : sharing) {
        const std::size_t a = root(k);
        const std::size_t b = root(other);
        if (a == b) continue;
        first[a < b ? b : a] = a < b ? a : b;
        --pieces.count;
      }
    }
    const glm::uvec3& t = surface.triangles[k];
    const glm::dvec3& corner = surface.positions[t.x];
    const glm::dvec3 cross = glm::cross(surface.positions[t.y] - corner, surface.positions[t.z] - corner);
    area += glm::length(cross);
    // Within 60° of straight down.
    if (-cross.y > 0.5 * glm::length(cross)) down += glm::length(cross);
  }
  pieces.facing_down = area > 0.0 ? down / area : 0.0;
  return pieces;
}

}  // namespace lichtmc
