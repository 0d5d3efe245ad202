// Tiles with integrated direct light, and tiles with backward walks.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;
const std::vector<Estimator> estimators{Estimator::weight, Estimator::collision, Estimator::absorption};

Settings analytic(Estimator estimator, Engine engine, double photons, std::uint64_t seed, double tile = 0.1) {
  Settings settings = settings_of(estimator, engine, photons, seed, tile);
  settings.direct = Direct::analytic;
  return settings;
}

Settings from_tiles(Estimator estimator, Engine engine, double photons, std::uint64_t seed, double tile = 0.1) {
  Settings settings = settings_of(estimator, engine, photons, seed, tile);
  settings.tile_walk = WalkDirection::backward;
  return settings;
}

// Tiles of two results with light, whose counts are large enough for a normal law.
std::vector<Compared> well_counted(const Result& counted, const Result& other, std::uint64_t hits = 200) {
  std::vector<Compared> figures;
  for (std::size_t i = 0; i < counted.tiles.size(); ++i) {
    const TileResult& a = counted.tiles[i];
    const TileResult& b = other.tiles[i];
    if (a.hits < hits) continue;
    figures.push_back({b.irradiance, b.standard_error, a.irradiance, a.standard_error});
  }
  return figures;
}

}  // namespace

TEST_CASE("tiles: the direct light of the paper's cube, integrated") {
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const Result result = simulate(unit_cube(0.6, paper_emitter()), analytic(Estimator::collision, engine, 2048, 1));
    CHECK(direct_is_apart(result));
    CHECK(result.walk.shadow_rays == 0);
    CHECK(surface_named(result, "floor").mean_direct == Approx(0.908183296).epsilon(1e-6));
    CHECK(surface_named(result, "ceiling").mean_direct == 0.0);
    CHECK(surface_named(result, "wall_x0").mean_direct == Approx(0.022954176).epsilon(1e-6));
    double least = 1e9;
    double most = 0.0;
    for (std::size_t i = 0; i < result.tiles.size(); ++i) {
      if (result.tiling.maps[result.tiling.tiles[i].map].name != "floor") continue;
      least = std::min(least, result.tiles[i].direct);
      most = std::max(most, result.tiles[i].direct);
    }
    CHECK(least == Approx(0.0828096637).epsilon(1e-6));
    CHECK(most == Approx(3.44722267).epsilon(1e-6));
  }
}

TEST_CASE("tiles: CIE 171 case 5.8, the mean indirect illuminance of all surfaces") {
  // 4 m cube, 10 000 lm at the centre: E = Φρ/(S(1 − ρ)); direct: 104.166667 lx on each face.
  for (const double rho : {0.05, 0.3, 0.6, 0.9, 0.99}) {
    Room room = make_cuboid({4.0, 4.0, 4.0}, uniform_reflectance(rho));
    room.emitters.push_back(isotropic({2.0, 2.0, 2.0}, 10000.0));
    const double expected = 10000.0 * rho / (96.0 * (1.0 - rho));
    for (const Estimator estimator : estimators) {
      const Result result = simulate(room, from_tiles(estimator, Engine::automatic, 1e5, 11, 1.0));
      for (const SurfaceResult& surface : result.surfaces)
        CHECK(surface.mean_direct == Approx(10000.0 / 96.0).epsilon(1e-3));
      const double error = result.incident_standard_error / 96.0;
      const Judgement verdict = compare({{result.incident / 96.0 - 10000.0 / 96.0, error, expected, 0.0}});
      check("rho " + std::to_string(rho) + ", " + std::string(to_string(estimator)), verdict);
      CHECK(verdict.smallest_bias < 0.12);
    }
  }
}

TEST_CASE("tiles: narrow beams and emitters close to a surface lose none of their direct light") {
  const auto direct_power = [](const Emitter& emitter, const std::string& surface, double tile) {
    const Result result =
        simulate(unit_cube(0.5, emitter), analytic(Estimator::collision, Engine::automatic, 2048, 1, tile));
    const SurfaceResult& one = surface_named(result, surface);
    return one.mean_direct * one.area_m2;
  };
  // A narrow beam, between the points that a quadrature rule would use.
  CHECK(direct_power(lambert({0.37, 0.9, 0.52}, {0, -1, 0}, 1e6), "floor", 0.5) == Approx(1.0).epsilon(3e-3));
  CHECK(direct_power({"spot", 1.0, SpotEmitter{{0.37, 0.9, 0.52}, {0, -1, 0}, 0.001, 0.002}}, "floor", 0.5) ==
        Approx(1.0).epsilon(1e-2));
  // A micrometre above the floor all downward light falls on it: a half, minus the light near the horizon.
  CHECK(direct_power(isotropic({0.37, 1e-6, 0.52}), "floor", 0.25) == Approx(0.5).epsilon(3e-3));
}

TEST_CASE("tiles: if every wall emits what it absorbs, backward walks give every tile the same irradiance") {
  const std::vector<double> rho{0.1, 0.3, 0.5, 0.7, 0.8, 0.4};
  Room room = make_cuboid({1.0, 0.5, 2.0}, {rho[0], rho[1], rho[2], rho[3], rho[4], rho[5]});
  room.quantity = Quantity::radiometric;
  for (std::size_t k = 0; k < 6; ++k)
    room.emitters.push_back(surface_emitter(k, (1.0 - rho[k]) * surface_area(room.surfaces[k])));
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    for (const Estimator estimator : estimators) {
      const Result result = simulate(room, from_tiles(estimator, engine, 2e5, 21, 0.25));
      std::vector<Compared> figures;
      std::vector<Compared> dimmer;
      for (const TileResult& tile : result.tiles) {
        figures.push_back({tile.irradiance, tile.standard_error, 1.0, 0.0});
        dimmer.push_back({tile.irradiance, tile.standard_error, 0.98, 0.0});
      }
      const Judgement verdict = compare(figures);
      check(std::string(to_string(engine)) + ", " + std::string(to_string(estimator)), verdict);
      CHECK(verdict.smallest_bias < 0.015);
      CHECK_FALSE(compare(dimmer).agrees);
    }
  }
}

TEST_CASE("tiles: forward walks, integrated direct light and backward walks agree") {
  struct Case {
    const char* scene;
    double tile;
    double counted;
    double walked;
  };
  for (const Case& one : {Case{"l_room.gltf", 0.25, 4e6, 2e6}, Case{"living_room.glb", 0.25, 8e6, 2e6}}) {
    Room room = read_gltf(std::string(LICHTMC_SCENES) + "/" + one.scene);
    // Point emitters centimetres from their lampshades give backward walks rare large scores.
    std::erase_if(room.emitters, [](const Emitter& e) { return e.name == "floor_lamp" || e.name == "reading_lamp"; });
    room.receivers.clear();
    const Result counted =
        simulate(room, settings_of(Estimator::collision, Engine::automatic, one.counted, 31, one.tile));
    for (const Estimator estimator : estimators) {
      const std::string name = std::string(one.scene) + ", " + std::string(to_string(estimator));
      const Result integrated =
          simulate(room, analytic(estimator, Engine::automatic, 0.25 * one.counted, 32, one.tile));
      CHECK(integrated.walk.shadow_rays > 0);
      const Judgement by_integral = compare(well_counted(counted, integrated));
      check(name + ", direct integrated", by_integral);
      CHECK(by_integral.smallest_bias < 0.02);
      const Result walked = simulate(room, from_tiles(estimator, Engine::automatic, one.walked, 33, one.tile));
      // With few walks per tile an error is as uncertain as the figure: whole surfaces are compared.
      std::vector<Compared> surfaces;
      for (std::size_t m = 0; m < counted.surfaces.size(); ++m) {
        const SurfaceResult& a = counted.surfaces[m];
        const SurfaceResult& b = walked.surfaces[m];
        if (a.hits < 1000) continue;
        surfaces.push_back({b.mean_irradiance, b.standard_error, a.mean_irradiance, a.standard_error});
      }
      check(name + ", walked from", compare(surfaces));
    }
  }
}

TEST_CASE("tiles: both sides of a screen, on one tile map or on two, by all methods") {
  // A screen in the middle of a room, an emitter on each side.
  for (const Sides sides : {Sides::one, Sides::both}) {
    Room room = unit_cube(0.5, isotropic({0.3, 0.6, 0.5}, 0.7));
    room.emitters.push_back(isotropic({0.8, 0.4, 0.4}, 0.3));
    Surface screen = make_floor(0.5, 0.5);
    screen.name = "screen";
    screen.sides = sides;
    screen.reflectance = 0.4;
    for (glm::dvec3& p : screen.positions) p = glm::dvec3(0.5, 0.2 + p.x, 0.2 + p.z);
    room.surfaces.push_back(screen);
    const Result counted = simulate(room, settings_of(Estimator::collision, Engine::automatic, 4e6, 41, 0.25));
    for (const Settings& settings : {analytic(Estimator::collision, Engine::automatic, 1e6, 42, 0.25),
                                     from_tiles(Estimator::collision, Engine::automatic, 1e6, 43, 0.25)}) {
      const Result other = simulate(room, settings);
      check(settings.tile_walk == WalkDirection::backward ? "screen, walked from" : "screen, integrated",
            compare(well_counted(counted, other)));
      const SurfaceResult& a = surface_named(counted, "screen");
      const SurfaceResult& b = surface_named(other, "screen");
      CHECK(std::abs(a.behind_share - b.behind_share) < 0.01);
      if (sides == Sides::one) CHECK(a.behind_share > 0.1);
      if (sides == Sides::both) CHECK(surface_named(other, "screen.back").power > 0.0);
    }
  }
}

TEST_CASE("tiles: the same figures for any number of threads, integrated and backward") {
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  room.receivers.clear();
  for (Settings settings : {analytic(Estimator::collision, Engine::automatic, 1e5, 51, 0.5),
                            from_tiles(Estimator::weight, Engine::automatic, 1e5, 52, 0.5)}) {
    std::vector<TileResult> first;
    for (const unsigned threads : {1U, 3U}) {
      settings.threads = threads;
      const Result result = simulate(room, settings);
      if (first.empty()) first = result.tiles;
      for (std::size_t i = 0; i < first.size(); ++i) {
        REQUIRE(result.tiles[i].irradiance == first[i].irradiance);
        REQUIRE(result.tiles[i].standard_error == first[i].standard_error);
      }
    }
  }
}

TEST_CASE("tiles: a target error ends both walks, and impossible settings are refused") {
  const Room room = unit_cube(0.6, paper_emitter());
  for (Settings settings : {analytic(Estimator::collision, Engine::automatic, 1e9, 61),
                            from_tiles(Estimator::collision, Engine::automatic, 1e9, 62)}) {
    settings.target_error = 0.05;
    const Result result = simulate(room, settings);
    CHECK(result.walk.stopped_by == StopReason::target_error);
    CHECK(result.walk.rms_relative_error <= 0.05);
    CHECK(result.walk.rms_relative_error > 0.02);
  }
  Settings settings = from_tiles(Estimator::collision, Engine::automatic, 1e4, 63);
  settings.measured = Measured::receivers;
  Room with_receiver = room;
  with_receiver.receivers.push_back({"here", {0.5, 0.0, 0.5}, {0, 1, 0}, 90.0, 1.0});
  CHECK_THROWS_WITH(simulate(with_receiver, settings), ContainsSubstring("--tiles backward"));
}

// The smallest bias that would fail is 0.8 % of every tile; one flight more or less changes all tiles by 7 % and more.
TEST_CASE("tiles: with a limited number of flights walks from the tiles find as much light as photons") {
  Room lamp = unit_cube(0.6, paper_emitter());
  Room luminous_ceiling = unit_cube(0.6, surface_emitter(1, 1.0));
  for (const Room& room : {lamp, luminous_ceiling}) {
    for (const std::uint32_t flights : {1U, 2U, 3U, 5U}) {
      Settings forward = settings_of(Estimator::weight, Engine::automatic, 2e6, 21, 0.25);
      forward.max_bounces = flights;
      Settings backward = from_tiles(Estimator::weight, Engine::automatic, 4e5, 22, 0.25);
      backward.max_bounces = flights;
      const Result photons = simulate(room, forward);
      const std::string what = std::to_string(flights) + " flights";
      check(what, compare(well_counted(photons, simulate(room, backward))));
      // Mutation: one flight more.
      backward.max_bounces = flights + 1;
      CHECK_FALSE(compare(well_counted(photons, simulate(room, backward))).agrees);
    }
  }
}

TEST_CASE("receivers: with one flight there is direct light only, with more all walks find the same") {
  Room room = unit_cube(0.6, paper_emitter());
  room.receivers.push_back({"desk", {0.4, 0.3, 0.6}, {0.0, 1.0, 0.0}, 90.0, 1.0});
  for (const std::uint32_t flights : {1U, 3U}) {
    std::vector<ReceiverResult> found;
    for (const ReceiverWalk walk : {ReceiverWalk::next_event, ReceiverWalk::backward, ReceiverWalk::two_way}) {
      Settings settings = settings_of(Estimator::weight, Engine::automatic, 4e5, 31);
      settings.measured = Measured::receivers;
      settings.receiver_walk = walk;
      settings.max_bounces = flights;
      found.push_back(simulate(room, settings).receiver_results[0]);
      if (flights == 1) CHECK(found.back().indirect == 0.0);
    }
    if (flights == 1) continue;
    for (std::size_t k = 1; k < found.size(); ++k)
      check("walk " + std::to_string(k),
            compare({{found[k].indirect, found[k].standard_error, found[0].indirect, found[0].standard_error}}));
  }
}
