// Tiles as pieces of triangles, and points that are uniform on them.
#include "room/tile_pieces.hpp"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

double area_of(const Surface& surface, const TilePiece& piece) {
  const glm::dvec3 a = point_at(surface, piece.triangle, piece.weights[0]);
  return 0.5 * glm::length(glm::cross(point_at(surface, piece.triangle, piece.weights[1]) - a,
                                      point_at(surface, piece.triangle, piece.weights[2]) - a));
}

}  // namespace

TEST_CASE("tile pieces: their areas add up to the tile's, for any mesh") {
  Room room;
  room.source = "test";
  room.surfaces = {make_floor(1.7, 0.9, 7), make_box(glm::dvec3(0.3, 0.4, 0.5))};
  room.surfaces[1].name = "box";
  room.surfaces[1].sides = Sides::both;
  for (const double edge : {0.05, 0.23, 5.0}) {
    const Tiling tiling = make_tiling(room, edge);
    const TilePieces pieces(room, tiling);
    for (std::size_t tile = 0; tile < tiling.tiles.size(); ++tile) {
      const Surface& surface = room.surfaces[tiling.maps[tiling.tiles[tile].map].surface];
      double sum = 0.0;
      for (const TilePiece& piece : pieces.of(tile)) sum += area_of(surface, piece);
      REQUIRE(!pieces.of(tile).empty());
      REQUIRE(pieces.of(tile).back().area_up_to == 1.0);
      REQUIRE(sum == Approx(tiling.tiles[tile].area_m2).epsilon(1e-9));
    }
  }
}

TEST_CASE("tile pieces: positions are uniform over a tile's area in 3-D, also if the chart is stretched") {
  // Two quads of one chart, the second three times as wide in space as in its half of the chart.
  Surface surface;
  surface.name = "stretched";
  add_quad(surface, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  add_quad(surface, {1, 0, 0}, {3, 0, 0}, {0, 0, 1});
  for (const glm::dvec3& p : surface.positions)
    surface.uvs.emplace_back(p.x <= 1.0 ? 0.5 * p.x : 0.5 + (p.x - 1.0) / 6.0, p.z);
  Room room;
  room.source = "test";
  room.surfaces = {surface};
  const Tiling tiling = make_tiling(room, 100.0);
  REQUIRE(tiling.tiles.size() == 1);
  const TilePieces pieces(room, tiling);
  constexpr int n = 512;  // a grid of n × n numbers replaces uniform random ones
  std::vector<double> counts(16, 0.0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const SurfacePlace place = pieces.place(0, (i + 0.5) / n, (j + 0.5) / n);
      const glm::dvec3 p = point_at(room.surfaces[0], place.triangle, place.weights);
      REQUIRE(p.x >= 0.0);
      REQUIRE(p.x <= 4.0);
      counts[static_cast<std::size_t>(std::min(3.0, std::floor(p.x)) * 4.0 + std::min(3.0, std::floor(4.0 * p.z)))] +=
          1.0;
    }
  }
  // The error of a count of grid points is less than the boundary of a bin, some n points of n²/16.
  for (const double count : counts) CHECK(std::abs(count - n * n / 16.0) < 3.0 * n);
}
