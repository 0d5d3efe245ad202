// No history, one history, and more histories than 32 bits can number.
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "chance/stream.hpp"
#include "extremes.hpp"
#include "walk/choose_policy.hpp"
#include "walk/launcher.hpp"
#include "walk/scene.hpp"
#include "walk/walk.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr std::uint64_t boundary = std::uint64_t{1} << 32U;

const Abandon never = [] { return false; };

// A cube prepared for walks with any history numbers.
struct Walks {
  Room room = unit_cube(0.6, paper_emitter());
  Tiling tiling = make_tiling(room, 0.1);
  Scene scene{room, tiling, Engine::cuboid};
  Settings settings;

  explicit Walks(Estimator estimator) { settings.estimator = estimator; }

  Totals of(std::uint64_t first, std::uint32_t n) const {
    const ScoreLaw law = score_law(settings.estimator, false);
    Tally tally(scene.first_tile, law.hits);
    make_walk(scene, settings)->simulate_batch(first, n, tally, never);
    Totals totals(tiling.tiles.size(), tiling.maps.size(), law.hits);
    tally.add_to(totals);
    return totals;
  }
};

bool same_sums(const Totals& a, const Totals& b) {
  for (std::size_t k = 0; k < a.tiles.size(); ++k) {
    if (a.tiles[k].sum != b.tiles[k].sum) return false;
  }
  return a.incident.sum == b.incident.sum && a.impacts == b.impacts && a.ends.absorbed == b.ends.absorbed;
}

}  // namespace

TEST_CASE("extreme: a run of no history is refused, and one history has no known error") {
  for (const Engine engine : both_engines) {
    const Room room = unit_cube(0.6, paper_emitter());
    const std::string message = refusal([&] { simulate(room, settings_of(Estimator::collision, engine, 0, 1)); });
    INFO(message);
    CHECK(message.find("0") != std::string::npos);
    CHECK(message.find("photons") != std::string::npos);
    for (const Estimator estimator : all_estimators) {
      const Result one = simulate(room, settings_of(estimator, engine, 1, 1));
      CHECK(one.walk.histories == 1);
      CHECK(std::isnan(one.incident_standard_error));
      for (const TileResult& tile : one.tiles) {
        REQUIRE(std::isfinite(tile.power));
        // Tiles that were hit: unknown. The others: the error that one history without a hit allows.
        if (tile.hits > 0) REQUIRE(std::isnan(tile.standard_error));
        if (tile.hits == 0) REQUIRE(tile.standard_error > 0.0);
      }
    }
  }
}

TEST_CASE("extreme: each of 2²⁴ + 1 photons is counted") {
  // Floats cannot count beyond 2²⁴.
  constexpr std::uint64_t photons = (std::uint64_t{1} << 24U) + 1;
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 1, 1, 1.0);
  settings.photons = photons;
  const Result result = simulate(unit_cube(0.0, lambert({0.5, 0.5, 0.5}, {0, -1, 0}, 1e30)), settings);
  CHECK(result.walk.histories == photons);
  CHECK(result.walk.impacts == photons);
  CHECK(surface_named(result, "floor").hits == photons);
  CHECK(result.incident == 1.0);
  CHECK(result.balance.absorbed == 1.0);
}

TEST_CASE("extreme: 2³¹ and 2³² + 7 photons are counted exactly") {
  const Walks walks(Estimator::collision);
  const Totals batch = walks.of(0, batch_histories);
  Totals sum = batch;
  for (std::uint64_t histories = batch_histories; histories < boundary; histories *= 2) {
    CHECK(sum.histories == histories);
    CHECK(sum.impacts == histories / batch_histories * batch.impacts);
    CHECK(sum.incident.sum == static_cast<uint128>(histories / batch_histories) * batch.incident.sum);
    const Totals half = sum;
    sum.add(half);
  }
  sum.add(walks.of(boundary, 7));
  CHECK(sum.histories == boundary + 7);
  CHECK(sum.incident.sum ==
        static_cast<uint128>(boundary / batch_histories) * batch.incident.sum + walks.of(boundary, 7).incident.sum);
  const Estimate mean = estimate(sum.incident, sum.histories);
  CHECK(mean.mean == Approx(static_cast<double>(batch.incident.sum) / batch_histories).epsilon(1e-8));
  CHECK(mean.standard_error > 0.0);
}

TEST_CASE("extreme: histories beyond 2³² differ from those before") {
  const Stream stream(1);
  for (const std::uint64_t history : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{4'000'000'000}}) {
    for (const Purpose purpose : {Purpose::emission, Purpose::flight})
      CHECK(stream.draw(history, 0, purpose) != stream.draw(history + boundary, 0, purpose));
  }
  for (const Estimator estimator : all_estimators) {
    const Walks walks(estimator);
    CHECK_FALSE(same_sums(walks.of(0, 1024), walks.of(boundary, 1024)));
    CHECK_FALSE(same_sums(walks.of(boundary - 1024, 1024), walks.of(boundary, 1024)));
  }
}

TEST_CASE("extreme: a batch across 2³² is the sum of its two parts") {
  for (const Estimator estimator : all_estimators) {
    const Walks walks(estimator);
    const Totals whole = walks.of(boundary - 1000, 1024);
    Totals parts = walks.of(boundary - 1000, 1000);
    parts.add(walks.of(boundary, 24));
    CHECK(whole.histories == 1024);
    CHECK(same_sums(whole, parts));
    // If the upper half of the number were lost, the second part would repeat the first photons.
    Totals wrapped = walks.of(boundary - 1000, 1000);
    wrapped.add(walks.of(0, 24));
    CHECK_FALSE(same_sums(whole, wrapped));
  }
}

TEST_CASE("extreme: a batch of launches across 2³² equals that of single photons") {
  const Walks walks(Estimator::collision);
  const Stream stream(1);
  Rays together(batch_histories);
  Rays single(batch_histories);
  std::vector<std::uint32_t> photon(batch_histories);
  walks.scene.launcher->launch_all(stream, boundary - 1000, batch_histories, together, photon.data());
  for (std::uint32_t i = 0; i < batch_histories; ++i) {
    walks.scene.launcher->launch(stream, boundary - 1000 + photon[i], single, i);
    // Directions of vectorised loops agree with those of single photons within some roundings.
    REQUIRE(together.dx[i] == Approx(single.dx[i]).margin(2e-6));
    REQUIRE(together.dy[i] == Approx(single.dy[i]).margin(2e-6));
    REQUIRE(together.dz[i] == Approx(single.dz[i]).margin(2e-6));
  }
}

TEST_CASE("extreme: twenty million weights of 0.6 add up to twelve million") {
  // A sum of floats stops growing evenly at 2²⁴ · 0.6.
  constexpr std::uint64_t photons = 20'000'000;
  for (const Engine engine : both_engines) {
    Settings settings = settings_of(Estimator::weight, engine, 1, 1, 1.0);
    settings.photons = photons;
    settings.max_bounces = 2;
    // Straight down on a floor of reflectance 0.6; the reflected light has one more impact.
    const Result result = simulate(unit_cube(0.6, lambert({0.5, 0.5, 0.5}, {0, -1, 0}, 1e30)), settings);
    const double others = result.incident - power_on(result, "floor");
    CHECK(power_on(result, "floor") == 1.0);
    CHECK(others * photons == Approx(12e6).margin(1.0));
    CHECK(result.balance.absorbed == Approx(0.4 + 0.6 * 0.4).epsilon(1e-7));
  }
}
