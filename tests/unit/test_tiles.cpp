#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/tiles.hpp"
#include "room/nearest_tile.hpp"
#include "support/catch.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Room room_of(const std::vector<Surface>& surfaces) {
  Room room;
  room.source = "test";
  room.surfaces = surfaces;
  return room;
}

std::vector<double> area_of_maps(const Tiling& tiling) {
  std::vector<double> areas(tiling.maps.size());
  for (const Tile& tile : tiling.tiles) areas[tile.map] += tile.area_m2;
  return areas;
}

// Checks the documented numbering of Tiling, and that areas add up. A sum of n tiles is rounded n times by up to 2⁻⁵³,
// its parts by some 20 such steps of the triangles' areas: far below 1e-12 for these rooms.
void check_tiling(const Room& room, const Tiling& tiling) {
  REQUIRE(tiling.cells.size() == room.surfaces.size());
  std::uint32_t next = 0;
  for (std::size_t m = 0; m < tiling.maps.size(); ++m) {
    const TileMap& map = tiling.maps[m];
    REQUIRE(map.tile_of_cell.size() == std::size_t{map.columns} * map.rows);
    for (std::uint32_t row = 0; row < map.rows; ++row) {
      for (std::uint32_t column = 0; column < map.columns; ++column) {
        const std::uint32_t tile = map.tile_of_cell[std::size_t{row} * map.columns + column];
        if (tile == no_tile) continue;
        REQUIRE(tile == next++);
        REQUIRE(tiling.tiles[tile].map == m);
        REQUIRE(tiling.tiles[tile].column == column);
        REQUIRE(tiling.tiles[tile].row == row);
        REQUIRE(tiling.tiles[tile].area_m2 > 0.0);
      }
    }
    const double area = area_of(room.surfaces[map.surface]);
    REQUIRE(std::abs(area_of_maps(tiling)[m] - area) <= 1e-12 * area);
    for (const auto& corners : tiling.cells[map.surface]) {
      for (const glm::dvec2& corner : corners) {
        REQUIRE((corner.x >= 0.0 && corner.x <= map.columns));
        REQUIRE((corner.y >= 0.0 && corner.y <= map.rows));
      }
    }
  }
  REQUIRE(next == tiling.tiles.size());
}

}  // namespace

TEST_CASE("a square metre of decimetre tiles has a hundred tiles of a hundredth") {
  for (const int quads : {1, 3, 7}) {
    const Room room = room_of({make_floor(1.0, 1.0, quads)});
    const Tiling tiling = make_tiling(room, 0.1);
    check_tiling(room, tiling);
    REQUIRE(tiling.tiles.size() == 100);
    CHECK(tiling.maps[0].chart == ChartSource::file);
    CHECK(tiling.maps[0].chart_reason.empty());
    CHECK(tiling.maps[0].columns == 10);
    CHECK(tiling.maps[0].rows == 10);
    for (const Tile& tile : tiling.tiles) {
      // Shares of triangles of half a square metre at most, rounded some 20 times by 2⁻⁵³.
      CHECK(std::abs(tile.area_m2 - 0.01) <= 20.0 * 0x1p-53);
      CHECK(std::abs(tile.point.x - (tile.column + 0.5) / 10.0) <= 1e-14);
      CHECK(tile.point.y == 0.0);
      CHECK(std::abs(tile.point.z - (tile.row + 0.5) / 10.0) <= 1e-14);
    }
  }
}

TEST_CASE("tiles do not depend on whether the chart is the file's or the engine's") {
  Surface plain = make_floor(2.0, 1.5, 4);
  plain.uvs.clear();
  const Tiling file = make_tiling(room_of({make_floor(2.0, 1.5, 4)}), 0.1);
  const Tiling engine = make_tiling(room_of({plain}), 0.1);
  CHECK(engine.maps[0].chart == ChartSource::engine);
  CHECK(engine.maps[0].chart_reason == "it has no UVs");
  REQUIRE(file.tiles.size() == 300);
  REQUIRE(engine.tiles.size() == 300);
  for (std::size_t n = 0; n < 300; ++n) {
    CHECK(std::abs(file.tiles[n].area_m2 - engine.tiles[n].area_m2) <= 1e-15);
    CHECK(glm::length(file.tiles[n].point - engine.tiles[n].point) <= 1e-14);
  }
}

TEST_CASE("a chart has the integer number of tiles nearest to its length") {
  const auto columns = [](double length, double edge) {
    return make_tiling(room_of({make_floor(length, 1.0)}), edge).maps[0].columns;
  };
  CHECK(columns(1.0, 0.3) == 3);
  CHECK(columns(1.04, 0.1) == 10);
  CHECK(columns(1.06, 0.1) == 11);
  CHECK(columns(1.0, 5.0) == 1);
}

TEST_CASE("a tile larger than the surface is the surface") {
  const Room room = room_of({make_floor(0.25, 0.5)});
  const Tiling tiling = make_tiling(room, 10.0);
  REQUIRE(tiling.tiles.size() == 1);
  CHECK(tiling.tiles[0].area_m2 == 0.125);
}

TEST_CASE("areas add up for all kinds of surfaces") {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    std::vector<Surface> surfaces{make_floor(3.7, 2.3, 5), make_box({2.0, 1.0, 3.0}), make_sphere(20),
                                  make_ramp(4, 30)};
    surfaces[2].sides = Sides::both;
    for (Surface& surface : surfaces) {
      for (glm::dvec3& p : surface.positions) p *= scale;
    }
    const Room room = room_of(surfaces);
    const Tiling tiling = make_tiling(room, 0.13 * scale);
    check_tiling(room, tiling);
    CHECK(tiling.tiles.size() > 3000);
  }
}

TEST_CASE("areas add up where UVs stretch and shear the surface") {
  // A floor with a non-uniform stretch of its UVs: tiles of different areas, the same sum.
  Surface floor = make_floor(3.0, 2.0, 12);
  for (glm::dvec2& uv : floor.uvs) uv = {0.5 * uv.x * (1.0 + uv.x), 0.7 * uv.y + 0.3 * uv.x};
  const Room room = room_of({floor});
  const Tiling tiling = make_tiling(room, 0.1);
  check_tiling(room, tiling);
  CHECK(tiling.maps[0].chart == ChartSource::file);
}

TEST_CASE("mirrored UVs mirror the tile map and areas stay positive") {
  Surface floor = make_floor(1.0, 1.0);
  for (glm::dvec2& uv : floor.uvs) uv.x = 1.0 - uv.x;
  const Room room = room_of({floor});
  const Tiling tiling = make_tiling(room, 0.25);
  check_tiling(room, tiling);
  REQUIRE(tiling.tiles.size() == 16);
  CHECK(tiling.tiles[0].point == glm::dvec3(0.875, 0.0, 0.125));
}

TEST_CASE("a surface with Sides::both has a back tile map like its front") {
  Surface wall = make_floor(1.0, 0.5);
  wall.name = "wall";
  wall.sides = Sides::both;
  const Room room = room_of({wall, make_floor(1.0, 1.0)});
  const Tiling tiling = make_tiling(room, 0.1);
  check_tiling(room, tiling);
  REQUIRE(tiling.maps.size() == 3);
  CHECK(tiling.maps[0].name == "wall");
  CHECK(tiling.maps[0].side == Side::front);
  CHECK(tiling.maps[1].name == "wall.back");
  CHECK(tiling.maps[1].side == Side::back);
  CHECK(tiling.maps[1].surface == 0);
  CHECK(tiling.maps[2].name == "floor");
  CHECK(tiling.maps[2].surface == 1);
  REQUIRE(tiling.tiles.size() == 200);
  for (std::size_t n = 0; n < 50; ++n) {
    CHECK(tiling.tiles[50 + n].map == 1);
    CHECK(tiling.tiles[50 + n].area_m2 == tiling.tiles[n].area_m2);
    CHECK(tiling.tiles[50 + n].point == tiling.tiles[n].point);
  }
}

TEST_CASE("a cell without a part of the surface is no tile") {
  Surface triangle;
  add_triangle(triangle, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  triangle.uvs = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  const Room room = room_of({triangle});
  const Tiling tiling = make_tiling(room, 0.1);
  check_tiling(room, tiling);
  REQUIRE(tiling.tiles.size() == 55);  // 45 whole ones and 10 halves
  CHECK(tiling.maps[0].tile_of_cell[99] == no_tile);
  for (const Tile& tile : tiling.tiles) {
    const bool half = tile.column + tile.row == 9;
    CHECK(std::abs(tile.area_m2 - (half ? 0.005 : 0.01)) <= 20.0 * 0x1p-53);
    // The centre of a half lies on its boundary.
    CHECK(std::abs(tile.point.x - (tile.column + 0.5) / 10.0) <= 1e-9);
    CHECK(std::abs(tile.point.z - (tile.row + 0.5) / 10.0) <= 1e-9);
  }
}

TEST_CASE("a tile whose centre is off the surface has its point in its largest piece") {
  // One cell; the surface is a large triangle in one corner of it and small ones in two others.
  Surface surface;
  add_triangle(surface, {0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.0, 0.0, 0.1});
  add_triangle(surface, {1.0, 0.0, 1.0}, {0.4, 0.0, 1.0}, {1.0, 0.0, 0.7});
  add_triangle(surface, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.1}, {0.9, 0.0, 0.0});
  for (const glm::dvec3& p : surface.positions) surface.uvs.emplace_back(p.x, p.z);
  const Tiling tiling = make_tiling(room_of({surface}), 2.0);
  REQUIRE(tiling.tiles.size() == 1);
  CHECK(glm::length(tiling.tiles[0].point - glm::dvec3(0.8, 0.0, 0.9)) < 1e-15);
}

TEST_CASE("float rounding at a grid line makes no tiles") {
  // A floor with its right third cut off the chart by a hole: its boundary is at a float next to the grid line at 0.3
  // of 1.
  Surface surface;
  const double third = static_cast<double>(0.3F);
  REQUIRE(third > 0.3);
  add_quad(surface, {0.0, 0.0, 0.0}, {third, 0.0, 0.0}, {0.0, 0.0, 1.0});
  add_quad(surface, {0.6, 0.0, 0.0}, {0.4, 0.0, 0.0}, {0.0, 0.0, 1.0});
  for (const glm::dvec3& p : surface.positions) surface.uvs.emplace_back(p.x, p.z);
  const Room room = room_of({surface});
  const Tiling tiling = make_tiling(room, 0.1);
  check_tiling(room, tiling);
  CHECK(tiling.tiles.size() == 70);
}

TEST_CASE("triangles without area do not change the tiles") {
  Surface surface = make_floor(1.0, 1.0);
  surface.uvs.clear();
  add_triangle(surface, {0.2, 0.0, 0.2}, {0.2, 0.0, 0.2}, {0.2, 0.0, 0.2});
  add_triangle(surface, {5.0, 5.0, 5.0}, {6.0, 6.0, 6.0}, {7.0, 7.0, 7.0});
  const Room room = room_of({surface});
  const Tiling tiling = make_tiling(room, 0.1);
  check_tiling(room, tiling);
  CHECK(tiling.tiles.size() == 100);
}

TEST_CASE("slivers keep their area and share a cell") {
  Surface surface = make_floor(1.0, 1.0);
  surface.uvs.clear();
  add_triangle(surface, {0.0, 3.0, 0.0}, {1.0, 3.0, 0.0}, {0.5, 3.0, 1e-8});
  add_triangle(surface, {0.0, 2.0, 0.0}, {1.0, 2.0, 0.0}, {0.5, 2.0, 1e-8});
  const Room room = room_of({surface});
  const Tiling tiling = make_tiling(room, 0.1);
  check_tiling(room, tiling);
  REQUIRE(tiling.tiles.size() == 101);
  double least = 1.0;
  for (const Tile& tile : tiling.tiles) least = std::min(least, tile.area_m2);
  CHECK(std::abs(least - 1e-8) < 1e-22);
}

TEST_CASE("a floor of very thin strips is a floor") {
  Surface strips;
  strips.name = "strips";
  double x = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const double width = n % 2 == 0 ? 1e-3 - 1e-6 : 1e-6;
    add_quad(strips, {x, 0.0, 0.0}, {width, 0.0, 0.0}, {0.0, 0.0, 1.0});
    x += width;
  }
  const Room room = room_of({strips});
  const Tiling tiling = make_tiling(room, 0.1);
  check_tiling(room, tiling);
  CHECK(tiling.tiles.size() == 100);
}

TEST_CASE("a surface without area has a tile map without tiles") {
  Surface empty;
  empty.name = "empty";
  Surface flat;
  flat.name = "flat";
  flat.sides = Sides::both;
  add_triangle(flat, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  const Room room = room_of({empty, flat});
  const Tiling tiling = make_tiling(room, 0.1);
  check_tiling(room, tiling);
  REQUIRE(tiling.maps.size() == 3);
  CHECK(tiling.tiles.empty());
  CHECK(tiling.maps[0].chart_reason == "it has no area");
  CHECK(nearest_tiles(tiling.maps[1]) == std::vector<std::uint32_t>{no_tile});
}

TEST_CASE("the same room gives the same tiles") {
  const Room room = room_of({make_sphere(30), make_ramp(3, 20)});
  const Tiling one = make_tiling(room, 0.1);
  const Tiling two = make_tiling(room, 0.1);
  REQUIRE(one.tiles.size() == two.tiles.size());
  CHECK(one.cells == two.cells);
  for (std::size_t m = 0; m < one.maps.size(); ++m) CHECK(one.maps[m].tile_of_cell == two.maps[m].tile_of_cell);
  for (std::size_t n = 0; n < one.tiles.size(); ++n) {
    CHECK(one.tiles[n].area_m2 == two.tiles[n].area_m2);
    CHECK(one.tiles[n].point == two.tiles[n].point);
  }
}

TEST_CASE("a tile edge that is not a finite number above 0 is refused") {
  const Room room = room_of({make_floor(1.0, 1.0)});
  for (const double edge : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    CHECK_THROWS_AS(make_tiling(room, edge), InputError);
  }
  CHECK_THROWS_WITH(make_tiling(room, -1.0),
                    "The tile edge is -1 m (allowed: a finite number above 0). Give --tile a length in metres.");
}

TEST_CASE("too many cells are refused before memory is allocated") {
  Surface small = make_floor(1.0, 1.0);
  small.name = "small";
  Surface large = make_box({1000.0, 500.0, 800.0});
  const Room room = room_of({small, large});
  CHECK_THROWS_WITH(make_tiling(room, 1e-3), ContainsSubstring("on the surface 'box' of 3400000 m^2, 1 for each tile"));
  CHECK_THROWS_WITH(make_tiling(room, 1e-3), ContainsSubstring("memory holds"));
  // Numbers of cells beyond the range of integers and doubles.
  for (const double edge : {1e-9, 1e-300, std::numeric_limits<double>::denorm_min()}) {
    CHECK_THROWS_AS(make_tiling(room, edge), InputError);
  }
  // One of two sides would be within the limit: 40 000 × 40 000 cells.
  Surface both = make_floor(1.0, 1.0);
  both.sides = Sides::both;
  CHECK_THROWS_AS(make_tiling(room_of({both}), 1.0 / 40000.0), InputError);
}

TEST_CASE("the tiles of thousands of surfaces are made in a short time") {
  std::vector<Surface> surfaces;
  for (int k = 0; k < 4000; ++k) {
    surfaces.push_back(make_floor(1.0, 1.0));
    surfaces.back().name = "floor " + std::to_string(k);
    surfaces.back().sides = k % 2 == 0 ? Sides::one : Sides::both;
  }
  CHECK(make_tiling(room_of(surfaces), 0.1).tiles.size() == 600'000);
}

TEST_CASE("a poster that fills the atlas does not divide the room into its own tiles") {
  Surface surface;  // 9 m² in a fifth of the square each way, 0.01 m² in the rest
  add_quad(surface, {0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {0.0, 0.0, 3.0});
  add_quad(surface, {4.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.0, 0.0, 0.1});
  for (const glm::dvec3& p : surface.positions)
    surface.uvs.push_back(p.x <= 3.0 ? glm::dvec2(p.x, p.z) / 15.0 : 0.3 + glm::dvec2(p.x - 4.0, p.z) * 7.0);
  const Tiling tiling = make_tiling(room_of({surface}), 0.1);
  CHECK(tiling.tiles.size() == 901);  // 22 500 cells with the file's UVs, 11 025 of them on the poster
  CHECK(tiling.maps[0].chart == ChartSource::engine);
  CHECK_THAT(tiling.maps[0].chart_reason, ContainsSubstring("uneven"));
}

TEST_CASE("an empty cell belongs to the nearest tile") {
  TileMap map;
  map.columns = 5;
  map.rows = 3;
  const std::uint32_t n = no_tile;
  map.tile_of_cell = {7, n, n, n, n,  //
                      n, n, n, n, n,  //
                      n, n, n, n, 8};
  const std::vector<std::uint32_t> filled = nearest_tiles(map);
  // Cells at the same distance from both belong to the first.
  const std::vector<std::uint32_t> expected{7, 7, 7, 7, 8,  //
                                            7, 7, 7, 8, 8,  //
                                            7, 7, 8, 8, 8};
  CHECK(filled == expected);
  map.tile_of_cell.assign(15, 3);
  CHECK(nearest_tiles(map) == map.tile_of_cell);
}
