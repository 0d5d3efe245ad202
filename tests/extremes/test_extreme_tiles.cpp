// Tiles of any size, and texture coordinates of any kind.
#include <cmath>
#include <cstring>
#include <functional>
#include <string_view>

#include "extremes.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double photons = 2e5;

Result walk_in(const Room& room, Engine engine, double tile_edge_m) {
  return simulate(room, settings_of(Estimator::collision, engine, photons, 5, tile_edge_m));
}

Surface& floor_of(Room& room) {
  return room.surfaces[surface_number(room, "floor")];
}

// A cube whose floor has these texture coordinates at its positions (x, z).
Room with_floor_uvs(const std::function<glm::dvec2(double, double)>& uv) {
  Room room = unit_cube(0.6, paper_emitter());
  Surface& floor = floor_of(room);
  floor.uvs.clear();
  for (const glm::dvec3& p : floor.positions) floor.uvs.push_back(uv(p.x, p.z));
  return room;
}

double area_of_tiles(const Result& result, const std::string& map) {
  double area = 0.0;
  for (const Tile& tile : result.tiling.tiles) {
    if (result.tiling.maps[tile.map].name == map) area += tile.area_m2;
  }
  return area;
}

const TileMap& map_named(const Result& result, std::string_view name) {
  for (const TileMap& map : result.tiling.maps) {
    if (map.name == name) return map;
  }
  throw std::logic_error("no map " + std::string(name));
}

// The floor's power is that of the same mesh without texture coordinates to the last bit, and the areas of its tiles
// add up to 1 m².
void check_floor_kept(const Room& room, ChartSource chart) {
  Room without = room;
  floor_of(without).uvs.clear();
  const Result result = walk_in(room, Engine::embree, 0.1);
  const Result plain = walk_in(without, Engine::embree, 0.1);
  CHECK(power_on(result, "floor") == power_on(plain, "floor"));
  CHECK(area_of_tiles(result, "floor") == Approx(1.0).epsilon(1e-12));
  const TileMap& map = map_named(result, "floor");
  CHECK(map.chart == chart);
  CHECK(map.chart_reason.empty() == (chart == ChartSource::file));
  for (const Tile& tile : result.tiling.tiles) REQUIRE(tile.area_m2 > 0.0);
  check_all_finite(result);
}

}  // namespace

TEST_CASE("extreme: tiles larger than the walls and tiles that do not fit them keep the walls' powers") {
  for (const Engine engine : both_engines) {
    const Room room = unit_cube(0.6, paper_emitter());
    const Result fine = walk_in(room, engine, 0.1);
    for (const double edge : {1e300, 5.0, 0.7, 0.3, 0.0317}) {
      const Result result = walk_in(room, engine, edge);
      if (edge > 1.0) REQUIRE(result.tiles.size() == 6);
      for (const SurfaceResult& wall : fine.surfaces) {
        const SurfaceResult& same = surface_named(result, wall.name);
        CHECK(same.power == wall.power);
        CHECK(area_of_tiles(result, wall.name) == Approx(1.0).epsilon(1e-12));
        if (edge > 1.0) CHECK(same.max_irradiance == Approx(wall.mean_irradiance).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("extreme: a tile that a wall's outline cuts has the area inside the wall") {
  // A right triangle with legs of 1 m: tiles of 0.25 m on its hypotenuse are halves.
  Room room = unit_cube(0.0, isotropic({0.5, 0.5, 0.5}));
  Surface corner;
  corner.name = "corner";
  add_triangle(corner, {0.0, 0.25, 0.0}, {0.0, 0.25, 1.0}, {1.0, 0.25, 0.0});
  room.surfaces.push_back(corner);
  const Result result = walk_in(room, Engine::embree, 0.25);
  CHECK(area_of_tiles(result, "corner") == Approx(0.5).epsilon(1e-12));
  std::size_t whole = 0;
  std::size_t halves = 0;
  double power = 0.0;
  for (std::size_t k = 0; k < result.tiles.size(); ++k) {
    const Tile& tile = result.tiling.tiles[k];
    if (result.tiling.maps[tile.map].name != "corner") continue;
    power += result.tiles[k].power;
    if (tile.area_m2 == Approx(0.0625)) ++whole;
    if (tile.area_m2 == Approx(0.03125)) ++halves;
    CHECK(result.tiles[k].irradiance * tile.area_m2 == Approx(result.tiles[k].power));
  }
  CHECK(whole == 6);
  CHECK(halves == 4);
  CHECK(power == Approx(power_on(result, "corner")).epsilon(1e-14));
}

TEST_CASE("extreme: a million tiles on one wall count all of its hits") {
  Room room;
  room.source = "floor";
  room.surfaces.push_back(make_floor(1.0, 1.0));
  room.emitters.push_back(lambert({0.5, 0.5, 0.5}, {0, -1, 0}, 1.0));
  const Result result = walk_in(room, Engine::embree, 1e-3);
  REQUIRE(result.tiles.size() == 1'000'000);
  std::uint64_t hits = 0;
  for (const TileResult& tile : result.tiles) hits += tile.hits;
  CHECK(hits == surface_named(result, "floor").hits);
  CHECK(hits == result.walk.impacts);
}

TEST_CASE("extreme: texture coordinates that are all the same") {
  check_floor_kept(with_floor_uvs([](double, double) { return glm::dvec2(0.5, 0.5); }), ChartSource::engine);
  check_floor_kept(with_floor_uvs([](double x, double) { return glm::dvec2(x, x); }), ChartSource::engine);
}

TEST_CASE("extreme: two triangles at the same position of the texture get separate tiles") {
  Room room = unit_cube(0.6, paper_emitter());
  Surface& floor = floor_of(room);
  const Surface two = make_floor(1.0, 1.0);
  floor.positions = two.positions;
  floor.triangles = two.triangles;
  floor.uvs.clear();
  // Both halves of the square on the lower left half of the texture.
  for (const glm::dvec3& p : floor.positions) {
    const bool second = floor.uvs.size() >= 3;
    floor.uvs.emplace_back(second ? 1.0 - p.x : p.x, second ? 1.0 - p.z : p.z);
  }
  check_floor_kept(room, ChartSource::engine);
}

TEST_CASE("extreme: texture coordinates beyond 0 … 1 wrap, and are not used for tiles") {
  check_floor_kept(with_floor_uvs([](double x, double z) { return glm::dvec2(3.0 * x - 1.0, 2.0 * z); }),
                   ChartSource::engine);
  check_floor_kept(with_floor_uvs([](double x, double z) { return glm::dvec2(x + 7.0, z - 3.0); }),
                   ChartSource::engine);
}

TEST_CASE("extreme: mirrored texture coordinates mirror the tile map") {
  const Room straight = with_floor_uvs([](double x, double z) { return glm::dvec2(x, z); });
  const Room mirrored = with_floor_uvs([](double x, double z) { return glm::dvec2(1.0 - x, z); });
  check_floor_kept(mirrored, ChartSource::file);
  const Result a = walk_in(straight, Engine::embree, 0.1);
  const Result b = walk_in(mirrored, Engine::embree, 0.1);
  const TileMap& map_a = map_named(a, "floor");
  const TileMap& map_b = map_named(b, "floor");
  REQUIRE(map_a.columns == 10);
  REQUIRE(map_b.columns == 10);
  for (std::uint32_t row = 0; row < map_a.rows; ++row) {
    for (std::uint32_t column = 0; column < 10; ++column) {
      const std::uint32_t one = map_a.tile_of_cell[row * 10 + column];
      const std::uint32_t other = map_b.tile_of_cell[row * 10 + (9 - column)];
      // A photon on the border between tiles may be on either side of it in the mirrored room.
      REQUIRE(std::abs(static_cast<double>(a.tiles[one].hits) - static_cast<double>(b.tiles[other].hits)) <= 2.0);
    }
  }
}

TEST_CASE("extreme: any number of threads, and so any distribution of the batches, gives the same bits") {
  const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  for (const Engine engine : both_engines) {
    for (const Estimator estimator : all_estimators) {
      for (const double edge : {0.1, 0.02}) {
        Settings settings = settings_of(estimator, engine, 50'001, 6, edge);
        settings.threads = 1;
        const Result one = simulate(unit_cube(0.6, paper_emitter()), settings);
        for (const unsigned threads : {2U, 5U, 16U}) {
          settings.threads = threads;
          const Result other = simulate(unit_cube(0.6, paper_emitter()), settings);
          for (std::size_t k = 0; k < one.tiles.size(); ++k) {
            REQUIRE(same(one.tiles[k].power, other.tiles[k].power));
            REQUIRE(same(one.tiles[k].standard_error, other.tiles[k].standard_error));
          }
        }
      }
    }
  }
}
