// The cube of the paper: edge 1 m, generalized Lambert emitter (m = 5, 1 W) at the centre, downwards, one reflectance
// for all walls.
//
// H. Schulze, Lichtausbreitung in Räumen, 2021, example of section 2.5. Expected tile maps: tests/data/README.md. Their
// own error, 10⁻⁶ and 3·10⁻⁶, is a hundredth of the standard errors here.
#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// The tables have z up: x, y, z there are z, x, y here, so that rows of a floor table are along z or, by symmetry,
// along x.
std::vector<Compared> figures(const Result& result, const std::string& rho) {
  const std::string folder = std::string(LICHTMC_TEST_DATA) + "/cube_cos5_rho" + rho;
  const auto floor = read_table(folder + "_floor.csv");
  const auto ceiling = read_table(folder + "_ceiling.csv");
  const auto wall = read_table(folder + "_wall_x0.csv");
  const auto cell = [](double coordinate) { return static_cast<std::size_t>(coordinate * 10.0); };
  std::vector<Compared> all;
  const auto append = [&](const std::string& map, auto&& expected) {
    const std::vector<Compared> more = against(result, map, expected);
    REQUIRE(more.size() == 100);
    all.insert(all.end(), more.begin(), more.end());
  };
  append("floor", [&](const Tile& tile) { return floor[cell(tile.point.x)][cell(tile.point.z)]; });
  append("ceiling", [&](const Tile& tile) { return ceiling[cell(tile.point.x)][cell(tile.point.z)]; });
  // Rows of the wall's table run along the floor, columns upwards.
  for (const char* name : {"wall_x0", "wall_x1"}) {
    append(name, [&](const Tile& tile) { return wall[cell(tile.point.z)][cell(tile.point.y)]; });
  }
  for (const char* name : {"wall_z0", "wall_z1"}) {
    append(name, [&](const Tile& tile) { return wall[cell(tile.point.x)][cell(tile.point.y)]; });
  }
  return all;
}

Result simulate_cube(double reflectance, Estimator estimator, Engine engine, std::uint64_t seed) {
  return simulate(unit_cube(reflectance, paper_emitter()), settings_of(estimator, engine, 4e6, seed));
}

struct Case {
  Estimator estimator;
  Engine engine;
};
const std::vector<Case> cases{{Estimator::weight, Engine::cuboid},     {Estimator::weight, Engine::embree},
                              {Estimator::collision, Engine::cuboid},  {Estimator::collision, Engine::embree},
                              {Estimator::absorption, Engine::cuboid}, {Estimator::absorption, Engine::embree}};

void check_cube(double reflectance, const std::string& rho, std::uint64_t seed) {
  for (const Case& each : cases) {
    const Result result = simulate_cube(reflectance, each.estimator, each.engine, seed++);
    const Judgement maps = compare(figures(result, rho));
    const Judgement total =
        compare({{result.incident, result.incident_standard_error, 1.0 / (1.0 - reflectance), 0.0}});
    INFO(to_string(each.estimator) << ", " << to_string(each.engine) << ", " << result.walk.histories
                                   << " histories\nmaps: " << maps.text << "\ntotal: " << total.text);
    CHECK(maps.agrees);
    CHECK(result.balance.lost == 0.0);
    CHECK(result.balance.escaped == 0.0);
    if (each.estimator == Estimator::absorption) {
      // Every photon is absorbed once and scores 1/(1 − ρ): no variance, only the rounding of sums of 600 products.
      CHECK(std::abs(result.incident * (1.0 - reflectance) - 1.0) < 600 * 0x1p-53);
    } else {
      CHECK(total.agrees);
    }
    WARN(to_string(each.estimator) << ", " << to_string(each.engine) << ", reflectance " << rho << ": " << maps.text);
  }
}

}  // namespace

TEST_CASE("paper cube: tile maps are exact at reflectance 0.6 for all estimators and tracers") {
  check_cube(0.6, "0.6", 601);
}

TEST_CASE("paper cube: tile maps are exact at reflectance 0.9 for all estimators and tracers") {
  check_cube(0.9, "0.9", 901);
}

TEST_CASE("paper cube: a reflectance that is one percent off is rejected") {
  const Result result = simulate_cube(0.606, Estimator::collision, Engine::cuboid, 601);
  CHECK_FALSE(compare(figures(result, "0.6")).agrees);
}

TEST_CASE("paper cube: another exponent of the emitter is rejected") {
  Room room = unit_cube(0.6, lambert({0.5, 0.5, 0.5}, {0.0, -1.0, 0.0}, 5.1));
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::cuboid, 4e6, 601));
  CHECK_FALSE(compare(figures(result, "0.6")).agrees);
}

TEST_CASE("paper cube: totals per wall") {
  // Incident power in W: floor, one wall, ceiling; deterministic radiosity, refined and extrapolated.
  const Result result = simulate_cube(0.6, Estimator::weight, Engine::cuboid, 611);
  const auto figure = [&](const char* name, double expected) {
    const SurfaceResult& surface = surface_named(result, name);
    return Compared{surface.power, surface.standard_error * surface.area_m2, expected, 0.0};
  };
  const Judgement verdict =
      compare({figure("floor", 1.0985316), figure("wall_x0", 0.284727483), figure("wall_x1", 0.284727483),
               figure("wall_z0", 0.284727483), figure("wall_z1", 0.284727483), figure("ceiling", 0.262558469)});
  INFO(verdict.text);
  CHECK(verdict.agrees);
}

TEST_CASE("paper cube: the residual of a truncated walk is exactly the missing power") {
  // After N flights Σ P = (1 − ρ^N)/(1 − ρ) exactly, without variance, and ρ^N is the residual. Each score is rounded
  // by up to 2⁻²⁵. (From 34 flights on the weight 0.6^34 is below half a unit of 2⁻²⁴, and the photon ends.)
  for (const std::uint32_t flights : {1U, 10U, 30U}) {
    Settings settings = settings_of(Estimator::weight, Engine::embree, 20000, 1);
    settings.max_bounces = flights;
    const Result result = simulate(unit_cube(0.6, paper_emitter()), settings);
    const double rest = std::pow(0.6, flights);
    CHECK(std::abs(result.incident - (1.0 - rest) / 0.4) < flights * 0x1p-25);
    CHECK(std::abs(result.balance.residual - rest) < flights * 0x1p-25);
    CHECK(result.walk.impacts == 20000ULL * flights);
    // No variance in the total; the estimate of it from sums rounded to 64 bits leaves this much.
    CHECK(result.incident_standard_error < 1e-8);
  }
}
