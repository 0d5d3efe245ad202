// The automatic choice of the estimator: the same figures as with this estimator from the start, the same choice for
// any number of threads, and a choice near the best.
#include <cmath>
#include <map>
#include <string>

#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

bool same_tiles(const Result& a, const Result& b) {
  if (a.walk.histories != b.walk.histories || a.tiles.size() != b.tiles.size()) return false;
  for (std::size_t t = 0; t < a.tiles.size(); ++t) {
    if (a.tiles[t].power != b.tiles[t].power || a.tiles[t].standard_error != b.tiles[t].standard_error) return false;
  }
  return true;
}

// Variance for the same number of flights.
double cost_of_tiles(const Result& result) {
  return std::pow(result.walk.rms_relative_error, 2) * static_cast<double>(result.walk.rays);
}

}  // namespace

TEST_CASE("automatic: the figures are those of the estimator chosen, for any number of threads") {
  for (const double rho : {0.2, 0.9}) {
    const Room room = unit_cube(rho, paper_emitter());
    Settings settings = settings_of(Estimator::automatic, Engine::automatic, 200'000, 3);
    settings.threads = 1;
    const Result chosen = simulate(room, settings);
    CHECK(chosen.walk.estimator != Estimator::automatic);
    REQUIRE(chosen.choices.size() == 1);
    CHECK(chosen.choices[0].find(std::string(to_string(chosen.walk.estimator))) != std::string::npos);
    Settings fixed = settings;
    fixed.estimator = chosen.walk.estimator;
    CHECK(same_tiles(chosen, simulate(room, fixed)));
    CHECK(simulate(room, fixed).choices.empty());
    for (const unsigned threads : {2U, 7U}) {
      settings.threads = threads;
      const Result overrides = simulate(room, settings);
      CHECK(overrides.walk.estimator == chosen.walk.estimator);
      CHECK(overrides.choices == chosen.choices);
      CHECK(same_tiles(chosen, overrides));
    }
  }
}

TEST_CASE("automatic: within a tenth of the best, by variance for the same number of flights") {
  // The living room's figure depends on few dark tiles and requires more photons to distinguish weight from collision:
  // see docs/trade-off.md.
  const std::map<std::string, double> scenes{
      {"cube_paper.gltf", 0.1}, {"integrating_sphere.glb", 0.5}, {"l_room.gltf", 0.5}};
  for (const auto& [scene, tile] : scenes) {
    Room room = read_gltf(std::string(LICHTMC_SCENES) + "/" + scene);
    room.receivers.clear();
    std::map<Estimator, double> costs;
    double best = INFINITY;
    for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
      costs[estimator] = cost_of_tiles(simulate(room, settings_of(estimator, Engine::automatic, 5e5, 5, tile)));
      best = std::min(best, costs[estimator]);
    }
    const Result chosen = simulate(room, settings_of(Estimator::automatic, Engine::automatic, 1e6, 6, tile));
    INFO(scene << ": " << chosen.choices[0]);
    for (const auto& [estimator, cost] : costs) WARN(scene << ", " << to_string(estimator) << ": " << cost / best);
    CHECK(costs[chosen.walk.estimator] <= 1.1 * best);
  }
}

TEST_CASE("automatic: receivers and tiles with backward walks have separate choices") {
  Room room = unit_cube(0.7, paper_emitter());
  room.receivers.push_back({"desk", {0.3, 0.2, 0.6}, {0, 1, 0}, 90.0, 1.0});
  Settings settings = settings_of(Estimator::automatic, Engine::automatic, 100'000, 3);
  settings.measured = Measured::all;
  const Result both = simulate(room, settings);
  REQUIRE(both.choices.size() == 2);
  CHECK(both.choices[0].find("the tiles") != std::string::npos);
  CHECK(both.choices[1].find("the receivers") != std::string::npos);
  settings.estimator = both.receiver_walk.estimator;
  CHECK(simulate(room, settings).receiver_results[0].irradiance == both.receiver_results[0].irradiance);
  settings.estimator = Estimator::automatic;
  settings.measured = Measured::tiles;
  settings.tile_walk = WalkDirection::backward;
  const Result walked = simulate(room, settings);
  REQUIRE(walked.choices.size() == 1);
  settings.estimator = walked.walk.estimator;
  CHECK(same_tiles(walked, simulate(room, settings)));
}

TEST_CASE("automatic: if a surface absorbs nothing, absorption is no candidate, and the run continues") {
  Room room = unit_cube(0.5, paper_emitter());
  room.surfaces[4].reflectance = 1.0;
  const Result result = simulate(room, settings_of(Estimator::automatic, Engine::automatic, 100'000, 3));
  CHECK(result.walk.estimator != Estimator::absorption);
  CHECK(result.choices[0].find("absorption") == std::string::npos);
}
