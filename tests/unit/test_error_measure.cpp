// The error of tiles in one number, and results of some surfaces only.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/lichtmc.hpp"
#include "run/error_measure.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// Two tile maps: three tiles of the first and two of the second.
Tiling five_tiles() {
  Tiling tiling;
  tiling.maps.resize(2);
  for (const auto& [map, area] : {std::pair{0U, 1.0}, {0U, 2.0}, {0U, 3.0}, {1U, 1e-6}, {1U, 4.0}}) {
    Tile tile;
    tile.map = map;
    tile.area_m2 = area;
    tiling.tiles.push_back(tile);
  }
  return tiling;
}

TileResult tile(double irradiance, double standard_error, std::uint64_t hits) {
  TileResult result;
  result.irradiance = irradiance;
  result.standard_error = standard_error;
  result.hits = hits;
  return result;
}

}  // namespace

TEST_CASE("error measure: errors refer to the floor in the dark, and tiles without hits count as one") {
  const Tiling tiling = five_tiles();
  const std::vector<double> no_hit{0.6, 0.8};  // W
  // The last two tiles were never hit: each for itself has an error of 0.8 W over its own area.
  const std::vector<TileResult> tiles{tile(10.0, 1.0, 9), tile(0.5, 0.2, 3), tile(4.0, 0.4, 5), tile(0.0, 0.8e6, 0),
                                      tile(0.0, 0.2, 0)};
  const std::vector<double> irradiances{10.0, 0.5, 4.0, 0.0, 0.0};
  const std::vector<bool> all(5, true);
  const double joint_area = 4.0 + 1e-6;
  const double expected = std::sqrt(
      (1.0 * 0.01 + 2.0 * 0.04 + 3.0 * 0.01 + joint_area * std::pow(0.8 / joint_area, 2)) / (6.0 + joint_area));
  CHECK(rms_relative_error(tiling, tiles, {all, irradiances, 1.0, no_hit}) == Approx(expected).epsilon(1e-12));

  SECTION("tiles that do not count have no influence") {
    const std::vector<bool> some{true, false, true, false, false};
    CHECK(rms_relative_error(tiling, tiles, {some, irradiances, 1.0, no_hit}) == Approx(0.1).epsilon(1e-12));
  }
  SECTION("integrated direct light of tiles without hits counts, with its error") {
    std::vector<TileResult> lit = tiles;
    lit[4] = tile(2.0, std::hypot(0.2, 0.1), 0);
    const std::vector<double> of_lit{10.0, 0.5, 4.0, 0.0, 2.0};
    const double joint = 8.0 / joint_area;
    const double error = std::hypot(0.8, 0.4) / joint_area / joint;
    CHECK(rms_relative_error(tiling, lit, {all, of_lit, 1.0, no_hit}) ==
          Approx(std::sqrt((0.01 + 0.08 + 0.03 + joint_area * error * error) / (6.0 + joint_area))).epsilon(1e-9));
  }
  SECTION("nothing counts: the error is not known") {
    const std::vector<bool> none(5, false);
    CHECK(std::isnan(rms_relative_error(tiling, tiles, {none, irradiances, 1.0, no_hit})));
  }
  SECTION("of backward walks a tile without light has no error") {
    const std::vector<TileResult> dark(5, tile(0.0, 0.0, 64));
    CHECK(std::isnan(rms_relative_error(tiling, dark, {all, std::vector<double>(5, 0.0), 1.0, {}})));
  }
}

TEST_CASE("error measure: a floor of 0 gives the errors relative to every tile") {
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 20 * 1024, 3, 0.05);
  const Room room = unit_cube(0.3, lambert({0.5, 0.5, 0.5}, {0.0, -1.0, 0.0}, 30.0));
  const Result usual = simulate(room, settings);
  REQUIRE(usual.tiles_without_hits > 0);
  double squares = 0.0;
  double area = 0.0;
  double power = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < usual.tiles.size(); ++i) {
    const double area_m2 = usual.tiling.tiles[i].area_m2;
    power += usual.tiles[i].irradiance * area_m2;
    all += area_m2;
    if (!(usual.tiles[i].irradiance > 0.0)) continue;
    squares += area_m2 * std::pow(usual.tiles[i].standard_error / usual.tiles[i].irradiance, 2);
    area += area_m2;
  }
  CHECK(usual.walk.rms_relative_error_without_floor == Approx(std::sqrt(squares / area)).epsilon(1e-12));
  CHECK(usual.walk.error_floor == Approx(0.01 * power / all).epsilon(1e-12));
  settings.error_floor_share = 0.0;
  const Result plain = simulate(room, settings);
  CHECK(plain.walk.rms_relative_error == usual.walk.rms_relative_error_without_floor);
  CHECK(plain.walk.error_floor == 0.0);
  settings.error_floor = 2.0;
  CHECK(simulate(room, settings).walk.error_floor == 2.0);
  settings.error_floor = -1.0;
  CHECK_THROWS_AS(simulate(room, settings), InputError);
  settings.error_floor = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(simulate(room, settings), InputError);
}

TEST_CASE("surfaces that are not measured reflect, and the results do not include them") {
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    for (const Direct direct : {Direct::sampled, Direct::analytic}) {
      Room room = unit_cube(0.6, paper_emitter());
      Settings settings = settings_of(Estimator::weight, engine, 20 * 1024, 5);
      settings.direct = direct;
      const Result all = simulate(room, settings);
      measure_only(room, {"floor", "surface:*wall*"});
      const Result some = simulate(room, settings);
      std::size_t next = 0;
      for (std::size_t i = 0; i < all.tiles.size(); ++i) {
        const TileMap& map = all.tiling.maps[all.tiling.tiles[i].map];
        if (!room.surfaces[map.surface].measured) continue;
        REQUIRE(next < some.tiles.size());
        CHECK(some.tiles[next].irradiance == all.tiles[i].irradiance);
        CHECK(some.tiles[next].standard_error == all.tiles[i].standard_error);
        CHECK(some.tiling.maps[some.tiling.tiles[next].map].name == map.name);
        ++next;
      }
      CHECK(next == some.tiles.size());
      CHECK(some.balance.absorbed == all.balance.absorbed);
      CHECK(some.surfaces.size() == some.tiling.maps.size());
      CHECK(std::isnan(some.incident));
    }
  }
}

TEST_CASE("surfaces to measure are chosen by names that exist") {
  Room room = unit_cube(0.6, paper_emitter());
  CHECK_THROWS_AS(measure_only(room, {"flor"}), InputError);
}

TEST_CASE("pictures show surfaces that are not measured in grey, without a value") {
  Room room = unit_cube(0.6, paper_emitter());
  room.surfaces[0].sides = Sides::both;  // as many tile maps as surfaces
  measure_only(room, {"floor", "surface:wall_x*", "ceiling", "wall_z0"});
  REQUIRE_FALSE(room.surfaces[5].measured);
  const Result result = simulate(room, settings_of(Estimator::weight, Engine::automatic, 20 * 1024, 5));
  const Picture all = RoomPainter(room, result, 1).draw(View::corner, choose_scale(result), 200, 150);
  measure_only(room, {"floor"});
  const Result floor = simulate(room, settings_of(Estimator::weight, Engine::automatic, 20 * 1024, 5));
  const Picture picture = RoomPainter(room, floor, 1).draw(View::corner, choose_scale(floor), 200, 150);
  const auto [least, most] = std::minmax_element(
      floor.tiles.begin(), floor.tiles.end(), [](const auto& a, const auto& b) { return a.irradiance < b.irradiance; });
  std::size_t grey = 0;
  std::size_t measured = 0;
  for (std::size_t k = 0; k < picture.colour.size(); ++k) {
    if (picture.colour[k].w == 1.0F && std::isnan(picture.irradiance[k])) ++grey;
    if (std::isnan(picture.irradiance[k])) continue;
    ++measured;
    CHECK(picture.irradiance[k] >= static_cast<float>(least->irradiance));
    CHECK(picture.irradiance[k] <= static_cast<float>(most->irradiance));
  }
  CHECK(grey > 1000);
  CHECK(measured > 1000);
  const auto without_value =
      std::count_if(all.irradiance.begin(), all.irradiance.end(), [](float e) { return std::isnan(e); });
  CHECK(without_value > 0);
}
