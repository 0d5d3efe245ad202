// Whether the error that a run states and stops at is its error: 200 runs against a long one, in a room most of which
// is darker than the error floor.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lichtmc/simulate.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr std::size_t runs = 200;
constexpr double target = 0.1;

// A narrow beam on the floor of a dark cube: 1 % of the floor's light on the other faces, most of which are below the
// error floor, and tiles without hits at the end of a run.
Room dark_room() {
  return unit_cube(0.005, lambert({0.5, 0.5, 0.5}, {0.0, -1.0, 0.0}, 40.0));
}

Result run_with(double photons, std::uint64_t seed) {
  Settings settings = settings_of(Estimator::weight, Engine::cuboid, photons, seed);
  settings.target_error = target;
  return simulate(dark_room(), settings);
}

// The mean of some values and its standard error.
struct Mean {
  double sum = 0.0;
  double squares = 0.0;
  double n = 0.0;
  void add(double value) {
    sum += value;
    squares += value * value;
    n += 1.0;
  }
  double mean() const { return sum / n; }
  double error() const { return std::sqrt(std::max(0.0, squares / n - mean() * mean()) / (n - 1.0)); }
};

// Σ area · (deviation / max(E, floor))² / Σ area, with the irradiances of a long run.
double square_error(const Result& result, const Result& truth, double floor) {
  double squares = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < result.tiles.size(); ++i) {
    const double expected = truth.tiles[i].irradiance;
    const double relative = (result.tiles[i].irradiance - expected) / std::max(expected, floor);
    squares += result.tiling.tiles[i].area_m2 * relative * relative;
    area += result.tiling.tiles[i].area_m2;
  }
  return squares / area;
}

}  // namespace

// The smallest bias that would fail: 1.3 % of the error, and 0.5 % of the forecast.
TEST_CASE("error measure: 200 runs reach the error that they are asked for, and their forecast") {
  const Result truth = simulate(dark_room(), settings_of(Estimator::weight, Engine::cuboid, 4e7, 99));
  const double of_truth = std::pow(truth.walk.rms_relative_error, 2);
  Mean actual;         // the square of the error by the long run
  Mean stated;         // by the run itself
  Mean without_floor;  // the same without a floor
  Mean required;       // histories for the target, by the error at the end
  Mean forecast;       // the same, by a run that ends after some half of them
  double without_hits = 0.0;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const Result result = run_with(1e9, 1000 + run);
    REQUIRE(result.walk.stopped_by == StopReason::target_error);
    const double error = result.walk.rms_relative_error;
    actual.add(square_error(result, truth, truth.walk.error_floor));
    stated.add(error * error);
    without_floor.add(std::pow(result.walk.rms_relative_error_without_floor, 2));
    required.add(static_cast<double>(result.walk.histories) * std::pow(error / target, 2));
    without_hits += static_cast<double>(result.tiles_without_hits) / runs;
    forecast.add(run_with(524'288, 2000 + run).walk.histories_to_target);
  }
  CHECK(without_hits > 10.0);
  CHECK(std::sqrt(stated.mean()) > 0.9 * target);  // a check after every 25 % more histories
  const auto agrees = [](const Mean& a, double factor, const Mean& b, double more) {
    const Judgement verdict = compare({{a.mean(), a.error(), factor * b.mean() + more, factor * b.error()}});
    INFO(verdict.text);
    return verdict.agrees;
  };
  CHECK(agrees(actual, 1.0, stated, of_truth));
  CHECK(agrees(forecast, 1.0, required, 0.0));
  // Mutations: the error without a floor; an error that is 3 % too small; a forecast that is 2 % too long.
  CHECK_FALSE(agrees(actual, 1.0, without_floor, of_truth));
  CHECK_FALSE(agrees(actual, 0.97 * 0.97, stated, of_truth));
  CHECK_FALSE(agrees(forecast, 1.0 / 1.02, required, 0.0));
}
