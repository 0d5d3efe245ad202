// Whether standard errors are correct: 200 independent runs compared with the exact values, for tiles with many hits
// and with few.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr std::size_t runs = 200;
constexpr double pi = 3.14159265358979323846;

// Sums over the runs, for one tile.
struct Spread {
  double deviations = 0.0;  // Σ (E − truth)
  double squares = 0.0;     // Σ (E − truth)²
  double stated = 0.0;      // Σ standard_error²
  void add(double value, double truth, double error) {
    deviations += value - truth;
    squares += (value - truth) * (value - truth);
    stated += error * error;
  }
};

// Mean deviation of every tile in units of the stated error of that mean: standard normal.
std::vector<Compared> means_of(const std::vector<Spread>& tiles) {
  std::vector<Compared> figures;
  for (const Spread& tile : tiles) figures.push_back({tile.deviations / std::sqrt(tile.stated), 1.0, 0.0, 0.0});
  return figures;
}

// Σ deviation² over its stated expectation is χ² with as many degrees of freedom as there are runs, divided by them;
// its cube root is normal to 10⁻³ (E. Wilson, M. Hilferty, The distribution of chi-square, 1931).
std::vector<Compared> variances_of(const std::vector<Spread>& tiles) {
  constexpr double spread = 2.0 / (9.0 * runs);
  std::vector<Compared> figures;
  for (const Spread& tile : tiles)
    figures.push_back({std::cbrt(tile.squares / tile.stated), std::sqrt(spread), 1.0 - spread, 0.0});
  return figures;
}

struct Case {
  Estimator estimator;
  Direct direct;
};

// A share of all (run, tile) pairs, with the binomial error of its expectation.
void check_share(double measured, double expected, double pairs) {
  const Judgement verdict = compare({{measured, std::sqrt(expected * (1.0 - expected) / pairs), expected, 0.0}});
  INFO(verdict.text);
  CHECK(verdict.agrees);
}

}  // namespace

TEST_CASE("standard errors: 200 runs cover the exact values on the floor of the paper's cube, by every estimator") {
  const auto floor = read_table(std::string(LICHTMC_TEST_DATA) + "/cube_cos5_rho0.6_floor.csv");
  for (const Case& each :
       {Case{Estimator::weight, Direct::sampled}, Case{Estimator::collision, Direct::sampled},
        Case{Estimator::absorption, Direct::sampled}, Case{Estimator::collision, Direct::analytic}}) {
    // 200 batches, so that Student's t is normal to 10⁻³; a tile of the floor expects 500 hits and more.
    constexpr double photons = 200 * 1024;
    std::vector<Spread> tiles(100);
    double beyond = 0.0;
    double shrunk_beyond = 0.0;
    for (std::size_t run = 0; run < runs; ++run) {
      Settings settings = settings_of(each.estimator, Engine::cuboid, photons, 1000 + run);
      settings.direct = each.direct;
      const Result result = simulate(unit_cube(0.6, paper_emitter()), settings);
      const auto map = static_cast<std::size_t>(std::find_if(result.surfaces.begin(), result.surfaces.end(),
                                                             [](const auto& s) { return s.name == "floor"; }) -
                                                result.surfaces.begin());
      std::size_t k = 0;
      for (std::size_t i = 0; i < result.tiles.size(); ++i) {
        const Tile& tile = result.tiling.tiles[i];
        if (tile.map != map) continue;
        const double truth =
            floor[static_cast<std::size_t>(tile.point.x * 10.0)][static_cast<std::size_t>(tile.point.z * 10.0)];
        const TileResult& found = result.tiles[i];
        tiles.at(k++).add(found.irradiance, truth, found.standard_error);
        const double z = std::abs(found.irradiance - truth) / found.standard_error;
        beyond += z > 1.96 ? 1.0 : 0.0;
        shrunk_beyond += z > 1.96 * 0.85 ? 1.0 : 0.0;
      }
      REQUIRE(k == 100);
    }
    const Judgement means = compare(means_of(tiles));
    const Judgement variances = compare(variances_of(tiles));
    INFO(to_string(each.estimator) << ' ' << to_string(each.direct) << "\nmeans: " << means.text
                                   << "\nvariances: " << variances.text << "\nbeyond 1.96: " << beyond / 20000);
    CHECK(means.agrees);
    CHECK(variances.agrees);
    // Tails: 5.0 % beyond 1.96 errors; 20 000 pairs find 0.75 % more or less of them, errors off by 8 %.
    check_share(beyond / 20000.0, 0.05, 20000.0);
    // The mutation: errors that are 15 % too small are rejected, by their tails and by their variances.
    CHECK_FALSE(compare({{shrunk_beyond / 20000.0, std::sqrt(0.05 * 0.95 / 20000.0), 0.05, 0.0}}).agrees);
    for (Spread& tile : tiles) tile.stated *= 0.85 * 0.85;
    CHECK_FALSE(compare(variances_of(tiles)).agrees);
  }
}

// A black cube with an isotropic emitter at the centre: photons are independent and each hits one tile, with a known
// probability p. So hits follow the binomial law, and the probability that an interval of one standard error contains
// the exact value is a sum over that law: not 68 %, because hits are integers.
TEST_CASE("standard errors: tiles with half a hit to three hits expected") {
  constexpr double photons = 20'000;
  constexpr double edge = 0.02;
  const auto p_of = [](const Tile& tile) {
    const glm::dvec3 half(0.5 * edge, 0.0, 0.0);
    return edge * edge * tile_mean(tile.point, half, glm::dvec3(0.0, 0.0, 0.5 * edge), 4, [](const glm::dvec3& at) {
             const glm::dvec3 segment = at - glm::dvec3(0.5);
             return 0.5 / (4.0 * pi * std::pow(glm::dot(segment, segment), 1.5));
           });
  };
  double covered = 0.0;
  double expected_covered = 0.0;
  double expected_variance = 0.0;
  double empty_covered = 0.0;
  double empty = 0.0;
  double expected_empty = 0.0;
  double stated = 0.0;
  double squares = 0.0;
  double pairs = 0.0;
  for (std::size_t run = 0; run < runs; ++run) {
    const Result result = simulate(unit_cube(0.0, isotropic({0.5, 0.5, 0.5})),
                                   settings_of(Estimator::absorption, Engine::cuboid, photons, 3000 + run, edge));
    for (std::size_t i = 0; i < result.tiles.size(); ++i) {
      const Tile& tile = result.tiling.tiles[i];
      if (result.surfaces[tile.map].name != "floor") continue;
      const TileResult& found = result.tiles[i];
      const double p = p_of(tile);
      REQUIRE(found.standard_error > 0.0);
      const bool holds = std::abs(found.power - p) <= found.standard_error * tile.area_m2;
      pairs += 1.0;
      covered += holds ? 1.0 : 0.0;
      if (found.hits == 0) {
        empty += 1.0;
        empty_covered += holds ? 1.0 : 0.0;
        CHECK(found.irradiance == 0.0);
      } else {
        stated += std::pow(found.standard_error * tile.area_m2, 2);
      }
      squares += std::pow(found.power - p, 2);
      if (run > 0) continue;
      // The law of the hits, and the numbers of hits whose interval contains the exact value.
      double probability = std::pow(1.0 - p, photons);
      expected_empty += probability;
      double holds_with = photons * p <= 1.1479 ? probability : 0.0;
      for (double hits = 1.0; hits < 40.0; hits += 1.0) {
        probability *= (photons - hits + 1.0) / hits * p / (1.0 - p);
        const double share = hits / photons;
        if (std::abs(share - p) <= std::sqrt(share * (1.0 - share) / (photons - 1.0))) holds_with += probability;
      }
      expected_covered += holds_with;
      expected_variance += holds_with * (1.0 - holds_with);
    }
  }
  constexpr double tiles = 2500.0;
  REQUIRE(pairs == tiles * runs);
  const double error = std::sqrt(expected_variance * runs);
  const Judgement verdict = compare({{covered, error, expected_covered * runs, 0.0}});
  INFO("covered " << covered / pairs << ", by the binomial law " << expected_covered / tiles << "; " << verdict.text);
  CHECK(verdict.agrees);
  // Squared errors are correct in the mean, for any number of hits: no hits count as an error of 0 here.
  const Judgement variance = compare({{stated, stated * std::sqrt(1.0 / (stated / (1.0 / photons / photons))), squares,
                                       squares * std::sqrt(3.0 / pairs)}});
  INFO("variance: " << variance.text);
  CHECK(variance.agrees);
  // The number of tiles without hits follows the law, and their stated error includes the exact value if fewer than
  // 1.15 hits are expected.
  check_share(empty / pairs, expected_empty / tiles, pairs);
  CHECK(empty_covered > 0.0);
  CHECK(empty_covered < empty);
}
