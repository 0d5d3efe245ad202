// Tiles as pieces of the room's triangles, to sample points that are uniform over a tile's area.
//
// A tile is the part of a surface in one cell of its grid: triangles clipped to the cell. Points are sampled by the
// area of these pieces in 3-D: a chart that stretches the surface does not change their distribution.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "room/faces_in_one_plane.hpp"

namespace lichtmc {

// A triangle that is part of a tile.
struct TilePiece {
  double area_up_to = 0.0;              // share of the tile's area in this piece and those before it; 1 for the last
  std::array<glm::dvec2, 3> weights{};  // barycentric coordinates of its corners in the room's triangle (2nd, 3rd)
  std::uint32_t triangle = 0;           // index into Surface::triangles
};

// A position on a surface: barycentric coordinates of the second and third corner of one of its triangles.
struct SurfacePlace {
  std::uint32_t triangle = 0;
  glm::dvec2 weights{0.0};
};

// The position on pieces of a surface for u, v in [0, 1), uniform over their area: u selects the piece, both select the
// position on it. There is at least one piece.
SurfacePlace place_on(std::span<const TilePiece> pieces, double u, double v);

class TilePieces {
 public:
  TilePieces(const Room& room, const Tiling& tiling);

  // The pieces of a tile (below Tiling::tiles.size()): at least one.
  std::span<const TilePiece> of(std::size_t tile) const {
    return {pieces_.data() + first_[tile], pieces_.data() + first_[tile] + count_[tile]};
  }

  // The position on a tile for u, v in [0, 1), uniform over its area.
  SurfacePlace place(std::size_t tile, double u, double v) const { return place_on(of(tile), u, v); }

 private:
  std::vector<TilePiece> pieces_;
  std::vector<std::size_t> first_;    // per tile
  std::vector<std::uint32_t> count_;  // per tile
};

// The parts of some pieces that no other faces in their plane cover.
struct UncoveredPieces {
  std::vector<TilePiece> pieces;  // empty: all is covered
  double share = 1.0;             // of the area
};

// None if nothing covers them. behind: seen from the back of the surface.
std::optional<UncoveredPieces> uncovered_pieces(std::span<const TilePiece> pieces, std::size_t surface, bool behind,
                                                const Room& room, const FacesInOnePlane& planes);

// The point of a surface at a position.
glm::dvec3 point_at(const Surface& surface, std::uint32_t triangle, const glm::dvec2& weights);

}  // namespace lichtmc
