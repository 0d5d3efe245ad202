// The same figures for any number of threads, two runs at once, stop rules, progress and cancellation.
#include <atomic>
#include <cmath>
#include <cstring>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same_digits(const Result& a, const Result& b) {
  if (a.tiles.size() != b.tiles.size() || a.walk.histories != b.walk.histories || a.walk.impacts != b.walk.impacts)
    return false;
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    if (!same_bits(a.tiles[i].power, b.tiles[i].power) ||
        !same_bits(a.tiles[i].standard_error, b.tiles[i].standard_error) || a.tiles[i].hits != b.tiles[i].hits) {
      return false;
    }
  }
  return same_bits(a.incident, b.incident) && same_bits(a.incident_standard_error, b.incident_standard_error) &&
         same_bits(a.balance.absorbed, b.balance.absorbed) && same_bits(a.balance.residual, b.balance.residual);
}

Room uneven_room() {
  Room room = make_cuboid({1.0, 2.0, 1.5}, {0.3, 0.8, 0.5, 0.6, 0.7, 0.4});
  room.emitters.push_back(lambert({0.4, 1.5, 0.7}, {0.1, -1, 0.2}, 2.0, 3.0));
  room.emitters.push_back(isotropic({0.6, 0.5, 0.5}, 1.0));
  return room;
}

}  // namespace

TEST_CASE("results are the same to the last digit for 1 and 2 and 7 threads") {
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
      // Not a multiple of the batch size: the last batch is incomplete.
      Settings settings = settings_of(estimator, engine, 100'001, 7);
      settings.threads = 1;
      const Result one = simulate(uneven_room(), settings);
      CHECK(one.walk.histories == 100'001);
      for (const unsigned threads : {2U, 7U}) {
        settings.threads = threads;
        CHECK(same_digits(one, simulate(uneven_room(), settings)));
      }
      settings.seed = 8;
      CHECK_FALSE(same_digits(one, simulate(uneven_room(), settings)));
    }
  }
}

TEST_CASE("a target error ends the run at the same history for any number of threads") {
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 1e9, 3);
  settings.target_error = 0.05;
  settings.threads = 1;
  const Result one = simulate(uneven_room(), settings);
  CHECK(one.walk.stopped_by == StopReason::target_error);
  CHECK(one.walk.rms_relative_error <= 0.05);
  settings.threads = 3;
  CHECK(same_digits(one, simulate(uneven_room(), settings)));
}

TEST_CASE("two runs at once in one process do not affect each other") {
  const Settings settings = settings_of(Estimator::collision, Engine::embree, 200'000, 5);
  const Result alone = simulate(uneven_room(), settings);
  Result first;
  Result second;
  {
    const std::jthread a([&] { first = simulate(uneven_room(), settings); });
    const std::jthread b([&] { second = simulate(uneven_room(), settings); });
  }
  CHECK(same_digits(alone, first));
  CHECK(same_digits(alone, second));
}

TEST_CASE("progress is reported and a stop request keeps what was simulated") {
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 1e12, 5);
  std::stop_source stop;
  std::atomic<int> calls{0};
  Control control;
  control.stop = stop.get_token();
  control.progress = [&](const Progress& progress) {
    if (progress.stage == Progress::Stage::preparation) {
      CHECK(calls == 0);
      CHECK_FALSE(progress.step.empty());
      return;
    }
    CHECK(progress.histories > 0);
    CHECK(progress.target == settings.photons);
    CHECK(progress.impacts > 0);
    CHECK(progress.seconds > 0.0);
    if (++calls == 3) stop.request_stop();
  };
  const Result result = simulate(uneven_room(), settings, control);
  CHECK(calls >= 3);
  CHECK(result.walk.stopped_by == StopReason::interrupt);
  CHECK(result.walk.histories > 0);
  CHECK(result.walk.histories % 1024 == 0);
  // What was simulated is the first part of the run: the same as a run with only this part.
  settings.photons = result.walk.histories;
  CHECK(same_digits(result, simulate(uneven_room(), settings)));
}

TEST_CASE("a time limit ends the run") {
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 1e12, 5);
  settings.max_seconds = 0.3;
  const Result result = simulate(uneven_room(), settings);
  CHECK(result.walk.stopped_by == StopReason::max_time);
  CHECK(result.walk.seconds >= 0.3);
}

TEST_CASE("an exception from the progress callback leaves the simulation") {
  struct Refusal {};
  for (const Progress::Stage stage : {Progress::Stage::preparation, Progress::Stage::tiles}) {
    Control control;
    control.progress = [stage](const Progress& progress) {
      if (progress.stage == stage) throw Refusal();
    };
    CHECK_THROWS_AS(simulate(uneven_room(), settings_of(Estimator::collision, Engine::cuboid, 1e12, 5), control),
                    Refusal);
  }
}

TEST_CASE("one history has an irradiance but no error") {
  const Result result = simulate(uneven_room(), settings_of(Estimator::collision, Engine::cuboid, 1, 5));
  CHECK(result.walk.histories == 1);
  CHECK(result.walk.impacts >= 1);
  CHECK(std::isnan(result.incident_standard_error));
  for (const TileResult& tile : result.tiles) CHECK(std::isnan(tile.standard_error) == (tile.hits > 0));
}

TEST_CASE("a tile without hits has the error that the absence of hits allows") {
  const Room room = uneven_room();
  for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
    const Result result = simulate(room, settings_of(estimator, Engine::cuboid, 3000, 5, 0.02));
    REQUIRE(result.tiles_without_hits > 0);
    for (std::size_t i = 0; i < result.tiles.size(); ++i) {
      const TileResult& tile = result.tiles[i];
      REQUIRE(tile.standard_error > 0.0);
      if (tile.hits > 0) continue;
      const Tile& place = result.tiling.tiles[i];
      const double rho = room.surfaces[result.tiling.maps[place.map].surface].reflectance;
      const double score = estimator == Estimator::absorption ? 1.0 / (1.0 - rho) : 1.0;
      // −ln(1 − 0.6827) = 1.148 hits of one photon's power.
      CHECK(tile.standard_error == Approx(1.148 * score * total_power(room) / 3000.0 / place.area_m2).epsilon(1e-3));
    }
  }
}
