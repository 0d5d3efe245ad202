// The choice of the estimator by pilots, and the forecast of the remaining histories from error checks.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "run/forecast.hpp"
#include "run/pilot.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

Pilot pilot(Estimator estimator, double flights, const std::vector<double>& errors) {
  Pilot one;
  one.estimator = estimator;
  one.flights = flights;
  one.errors = errors;
  one.values.assign(errors.size(), 1.0);
  one.hits.assign(errors.size(), 10.0);
  return one;
}

}  // namespace

TEST_CASE("candidates are the requested estimator, or those that the room allows") {
  Settings settings;
  settings.estimator = Estimator::weight;
  CHECK(candidates_for(unit_cube(0.5, paper_emitter()), settings) == std::vector<Estimator>{Estimator::weight});
  settings.estimator = Estimator::automatic;
  CHECK(candidates_for(unit_cube(0.5, paper_emitter()), settings).size() == 3);
  Room white_wall = unit_cube(0.5, paper_emitter());
  white_wall.surfaces[0].reflectance = 1.0;
  CHECK(candidates_for(white_wall, settings) == std::vector<Estimator>{Estimator::collision, Estimator::weight});
}

TEST_CASE("a pilot takes a small share of a long run, and never more than it needs") {
  CHECK(pilot_histories(1000, Estimator::weight) == 16 * 1024);
  CHECK(pilot_histories(20 * 1024 * 100, Estimator::weight) == 100 * 1024);
  CHECK(pilot_histories(20 * 1024 * 100, Estimator::absorption) == 25 * 1024);
  CHECK(pilot_histories(std::uint64_t{1} << 60U, Estimator::collision) == 256 * 1024);
}

TEST_CASE("the pilot with the smallest variance for the same number of flights is chosen") {
  // Variances 4 and 1, flights 1 and 5: the first needs 4, the second 5 for the same error.
  const std::vector<Pilot> pilots{pilot(Estimator::collision, 1000.0, {0.2, 0.2}),
                                  pilot(Estimator::weight, 5000.0, {0.1, 0.1})};
  const Choice choice = choose_best(pilots, {1.0, 1.0}, 0.0, {1.0, 1.0}, "the tiles");
  CHECK(choice.best == 0);
  CHECK(choice.reason.find("'collision' was chosen for the tiles") != std::string::npos);
  CHECK(choice.reason.find("'weight' needs 1.25 times as many flights") != std::string::npos);
  // Weights count: the second is better where the area is, and errors are relative to the means given.
  const std::vector<Pilot> uneven{pilot(Estimator::collision, 1000.0, {0.1, 0.4}),
                                  pilot(Estimator::weight, 1000.0, {0.4, 0.1})};
  CHECK(choose_best(uneven, {1.0, 1.0}, 0.0, {1.0, 9.0}, "the tiles").best == 1);
  CHECK(choose_best(uneven, {1.0, 1.0}, 0.0, {9.0, 1.0}, "the tiles").best == 0);
  CHECK(choose_best(uneven, {1.0, 100.0}, 0.0, {1.0, 9.0}, "the tiles").best == 0);
}

TEST_CASE("tiles with few hits of the pilots take the mean irradiance of their tile map, reduced by the missing hits") {
  // One tile map of three tiles of equal areas, 100 hits each expected at the mean of 1; one was not hit at all.
  Pilot one = pilot(Estimator::collision, 1000.0, {0.1, 0.1, 0.0});
  one.values = {1.5, 1.5, 0.0};
  one.hits = {150.0, 150.0, 0.0};
  const CountedTiles tiles{{1.0, 1.0, 1.0}, {0, 0, 0}, 1};
  const std::vector<double> likely = likely_values({one}, tiles);
  CHECK(likely[0] == Approx(151.0 / 101.0));
  CHECK(likely[2] == Approx(1.0 / 101.0));
  // A tile map without hits is dark.
  const CountedTiles apart{{1.0, 1.0, 1.0}, {0, 0, 1}, 2};
  CHECK(likely_values({one}, apart)[2] == 0.0);
}

TEST_CASE("dark tiles share the variance of a hit, so that a tile without hits does not count as exact") {
  // 100 dark tiles; one pilot hit half of them, 80 times each, the other all of them; a bright tile, and a very dark
  // one. Variance of a power by the first: 0.25 times its mean where it is dark, once where it is bright.
  Pilot first = pilot(Estimator::weight, 1000.0, std::vector<double>(102, 0.0));
  Pilot second = pilot(Estimator::collision, 1000.0, std::vector<double>(102, std::sqrt(0.01)));
  first.hits.assign(102, 0.0);
  second.hits.assign(102, 40.0);
  std::vector<double> likely(102, 0.01);
  for (std::size_t t = 1; t < 100; t += 2) {
    first.hits[t] = 80.0;
    first.errors[t] = std::sqrt(2.0 * 0.25 * 0.01);
  }
  likely[100] = 1.0;
  first.hits[100] = 1e5;
  first.errors[100] = second.errors[100] = 1.0;
  likely[101] = 1e-5;
  second.hits[101] = second.errors[101] = 0.0;
  std::vector<Pilot> pilots{first, second};
  make_errors_likely(pilots, likely, {std::vector<double>(102, 1.0), std::vector<std::uint32_t>(102, 0), 1});
  for (std::size_t t = 0; t < 100; ++t) {
    CHECK(pilots[0].errors[t] == Approx(std::sqrt(0.25 * 0.01)));
    CHECK(pilots[1].errors[t] == Approx(std::sqrt(0.01)));
  }
  CHECK(pilots[0].errors[100] == Approx(1.0));
  // No hits are known there at all.
  CHECK(pilots[0].errors[101] == 0.0);
  CHECK(pilots[1].errors[101] == 0.0);
}

TEST_CASE("if pilots had no hits, no estimator is chosen and the report says so") {
  const std::vector<Pilot> dark{pilot(Estimator::collision, 1000.0, {0.0}), pilot(Estimator::weight, 1000.0, {0.0})};
  const Choice choice = choose_best(dark, {0.0}, 0.0, {1.0}, "the tiles");
  CHECK(choice.best == 0);
  CHECK(choice.reason.find("too few photons scored") != std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Pilot> unknown{pilot(Estimator::collision, 1000.0, {nan}), pilot(Estimator::weight, 1000.0, {nan})};
  CHECK(choose_best(unknown, {1.0}, 0.0, {1.0}, "the tiles").reason.find("too few photons scored") !=
        std::string::npos);
}

TEST_CASE("a forecast extrapolates the slope of the errors") {
  Forecast none;
  CHECK(std::isnan(none.histories_to(0.01)));
  // R = 10/√N.
  Forecast steady;
  for (const std::uint64_t n : {1000U, 2000U, 4000U}) steady.add(n, 10.0 / std::sqrt(n));
  CHECK(steady.histories_to(0.01) == Approx(1e6));
  CHECK(steady.histories_to(1.0) == 4000.0);  // met
  // R = N^(−1/4) while tiles still get their first hits: half the error requires 16 times the histories. After 100
  // times the histories all have hits: R(4·10⁵) = 0.0398, and from there the square-root law holds.
  Forecast slow;
  for (const std::uint64_t n : {1000U, 2000U, 4000U}) slow.add(n, std::pow(n, -0.25));
  CHECK(slow.histories_to(std::pow(4000.0, -0.25) / 2.0) == Approx(64'000.0));
  CHECK(slow.histories_to(0.01) == Approx(4e5 * std::pow(std::pow(4e5, -0.25) / 0.01, 2.0)));
  // Errors that decrease faster than any law, and one that does not decrease: the result is a number in both cases.
  Forecast lucky;
  lucky.add(1000, 1.0);
  lucky.add(2000, 0.1);
  CHECK(lucky.histories_to(0.01) == Approx(2000.0 * 100.0));
  Forecast stuck;
  stuck.add(1000, 0.5);
  stuck.add(2000, 0.5);
  CHECK(std::isfinite(stuck.histories_to(0.25)));
  CHECK(stuck.histories_to(0.25) > 1e5);
  // A value that is no error is no error check.
  Forecast unknown;
  unknown.add(1000, std::numeric_limits<double>::quiet_NaN());
  CHECK(std::isnan(unknown.histories_to(0.01)));
}
