#include "room/face_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

#include "room/mesh_links.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

namespace {

constexpr double least_cosine = 0.9063077870366499;  // cos 25°
constexpr std::uint32_t none = 0xFFFFFFFF;

}  // namespace

FacePatches::FacePatches(const Room& room) {
  sides_.resize(room.surfaces.size());
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) cut(room.surfaces[k], k);
}

// Each patch grows from the largest triangle that is in none yet. Triangles without area, which have no normal, make
// patches of their own without area.
void FacePatches::cut(const Surface& surface, std::size_t number) {
  const std::vector<TriangleShape> shapes = triangle_shapes(surface);
  const MeshLinks links(surface);
  std::vector<std::uint32_t>& side = sides_[number];
  side.assign(shapes.size(), none);
  std::vector<std::uint32_t> by_area(shapes.size());
  std::iota(by_area.begin(), by_area.end(), 0U);
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return shapes[a].area_m2 > shapes[b].area_m2; });
  std::vector<std::uint32_t> patch;
  for (const std::uint32_t seed : by_area) {
    if (side[seed] != none) continue;
    const auto front = static_cast<std::uint32_t>(2 * areas_.size());
    double area = 0.0;
    patch.assign(1, seed);
    side[seed] = front;
    for (std::size_t n = 0; n < patch.size(); ++n) {
      area += shapes[patch[n]].area_m2;
      for (std::size_t edge = 0; edge < 3; ++edge) {
        for (const std::uint32_t other : links.at_edge(patch[n], edge)) {
          const double cosine = glm::dot(shapes[other].normal, shapes[seed].normal);
          if (side[other] != none || std::abs(cosine) < least_cosine) continue;
          side[other] = front ^ (cosine < 0.0 ? 1U : 0U);
          patch.push_back(other);
        }
      }
    }
    areas_.push_back(area);
    surfaces_.push_back(number);
  }
}

std::vector<std::vector<RoomFace>> FacePatches::triangles() const {
  std::vector<std::vector<RoomFace>> list(size());
  for (std::size_t k = 0; k < sides_.size(); ++k) {
    for (std::uint32_t n = 0; n < sides_[k].size(); ++n) list[sides_[k][n] / 2].push_back({k, n});
  }
  return list;
}

}  // namespace lichtmc
