// The faces of tiles: each side of a tile that can receive light, as an origin of backward walks.
//
// A tile of a surface with one tile map for both sides has two faces, and its irradiance is the sum of both; in a
// convex room only the face towards the room can receive light. A tile of a surface with two tile maps has one face.
// Faces that are wholly covered by others in their plane are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "chance/stream.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "room/tile_pieces.hpp"
#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"
#include "walk/light_source.hpp"
#include "walk/origin_view.hpp"

namespace lichtmc {

struct TileFace {
  std::uint32_t tile = 0;
  bool behind = false;  // it is on the back of the surface
};

class TileFaces {
 public:
  // Room, tiling and tracer must outlive the faces.
  TileFaces(const Room& room, const Tiling& tiling, const Tracer& tracer);

  std::size_t size() const { return faces_.size(); }
  const TileFace& operator[](std::size_t face) const { return faces_[face]; }
  double area_m2(std::size_t face) const { return tiling_->tiles[faces_[face].tile].area_m2; }
  const Surface& surface(std::size_t face) const { return room_->surfaces[surface_number(face)]; }
  // The parts of the face that are not covered by other faces in their plane: all of it in most rooms.
  std::span<const TilePiece> pieces(std::size_t face) const {
    return is_whole(face) ? pieces_.of(faces_[face].tile) : std::span<const TilePiece>(uncovered_[face].pieces);
  }
  // Their share of its area, above 0.
  double uncovered_share(std::size_t face) const { return is_whole(face) ? 1.0 : uncovered_[face].share; }

  // The point chosen by u, v in [0, 1), uniform over the uncovered parts of the face.
  SurfacePlace place(std::size_t face, double u, double v) const { return place_on(pieces(face), u, v); }
  // The reference point at a point of the face.
  ReferencePoint reference(std::size_t face, const SurfacePlace& place) const;

  // As origins of backward walks, see backward.hpp.
  static constexpr std::uint32_t group = 4;
  static constexpr bool is_extended = true;
  OriginView start(std::uint64_t face, double u, double v, Rays& rays, std::size_t i) const;

 private:
  std::size_t surface_number(std::size_t face) const {
    return tiling_->maps[tiling_->tiles[faces_[face].tile].map].surface;
  }

  bool is_whole(std::size_t face) const { return uncovered_.empty() || uncovered_[face].pieces.empty(); }
  void find_uncovered(const FacesInOnePlane& planes);

  const Room* room_;
  const Tiling* tiling_;
  TilePieces pieces_;
  std::vector<UncoveredPieces>
      uncovered_;  // of each face, without pieces if nothing covers it; empty if the room has no faces in one plane
  std::vector<TileFace> faces_;
  std::vector<std::vector<glm::dvec3>> normals_;      // per surface and triangle
  std::vector<std::vector<TriangleOnFacet>> facets_;  // per surface and triangle
};

}  // namespace lichtmc
