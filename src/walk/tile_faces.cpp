#include "walk/tile_faces.hpp"

#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "room/triangle_shapes.hpp"

namespace lichtmc {

TileFaces::TileFaces(const Room& room, const Tiling& tiling, const Tracer& tracer)
    : room_(&room), tiling_(&tiling), pieces_(room, tiling) {
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    normals_.emplace_back();
    facets_.emplace_back();
    const std::vector<TriangleShape> shapes = triangle_shapes(room.surfaces[k]);
    for (std::size_t n = 0; n < shapes.size(); ++n) {
      normals_.back().push_back(shapes[n].normal);
      facets_.back().push_back(shapes[n].area_m2 > 0.0 ? tracer.locate(k, n) : TriangleOnFacet{});
    }
  }
  // The mean of points of a convex room's walls lies inside.
  glm::dvec3 middle(0.0);
  for (const Tile& tile : tiling.tiles) middle += tile.point / static_cast<double>(tiling.tiles.size());
  for (std::size_t tile = 0; tile < tiling.tiles.size(); ++tile) {
    const TileMap& map = tiling.maps[tiling.tiles[tile].map];
    if (!room.surfaces[map.surface].measured) continue;
    const auto number = static_cast<std::uint32_t>(tile);
    if (room.surfaces[map.surface].sides == Sides::both) {
      faces_.push_back({number, map.side == Side::back});
      continue;
    }
    // If nothing casts a shadow the room is convex: the outer faces receive no light.
    bool front = tracer.casts_shadows();
    bool back = front;
    for (const TilePiece& piece : pieces_.of(tile)) {
      const glm::dvec3& normal = normals_[map.surface][piece.triangle];
      (glm::dot(normal, middle - tiling.tiles[tile].point) >= 0.0 ? front : back) = true;
    }
    if (front) faces_.push_back({number, false});
    if (back) faces_.push_back({number, true});
  }
  if (tracer.faces_in_one_plane() != nullptr) find_uncovered(*tracer.faces_in_one_plane());
}

void TileFaces::find_uncovered(const FacesInOnePlane& planes) {
  std::vector<TileFace> kept;
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    std::optional<UncoveredPieces> part =
        uncovered_pieces(pieces_.of(faces_[face].tile), surface_number(face), faces_[face].behind, *room_, planes);
    if (part && part->pieces.empty()) continue;
    kept.push_back(faces_[face]);
    uncovered_.push_back(part ? std::move(*part) : UncoveredPieces{});
  }
  faces_ = std::move(kept);
}

ReferencePoint TileFaces::reference(std::size_t face, const SurfacePlace& place) const {
  const glm::dvec3& normal = normals_[surface_number(face)][place.triangle];
  return {point_at(surface(face), place.triangle, place.weights), faces_[face].behind ? -normal : normal, 0.0};
}

OriginView TileFaces::start(std::uint64_t face, double u, double v, Rays& rays, std::size_t i) const {
  const SurfacePlace spot = place(face, u, v);
  const TriangleOnFacet& facet = facets_[surface_number(face)][spot.triangle];
  const glm::vec2 st =
      facet.st_0 + static_cast<float>(spot.weights.x) * facet.st_1 + static_cast<float>(spot.weights.y) * facet.st_2;
  rays.facet[i] = facet.facet;
  rays.s[i] = st.x;
  rays.t[i] = st.y;
  rays.behind[i] = faces_[face].behind ? 1 : 0;
  const glm::dvec3& normal = normals_[surface_number(face)][spot.triangle];
  return {glm::vec3(faces_[face].behind ? -normal : normal), 0.0, std::nullopt};
}

}  // namespace lichtmc
