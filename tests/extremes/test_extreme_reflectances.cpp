// Surfaces that reflect nothing, everything, or nearly so.
#include <limits>

#include "extremes.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

const Emitter centre = isotropic({0.5, 0.5, 0.5});

}  // namespace

TEST_CASE("extreme: black surfaces end every history at its first impact, and the estimators are equal") {
  for (const Engine engine : both_engines) {
    std::vector<Result> results;
    for (const Estimator estimator : all_estimators)
      results.push_back(simulate(unit_cube(0.0, centre), settings_of(estimator, engine, 1e5, 29)));
    for (const Result& result : results) {
      CHECK(result.walk.impacts == result.walk.histories);
      CHECK(result.walk.rays == result.walk.histories);
      for (std::size_t k = 0; k < result.tiles.size(); ++k) {
        REQUIRE(result.tiles[k].irradiance == results[0].tiles[k].irradiance);
        REQUIRE(result.tiles[k].hits == results[0].tiles[k].hits);
      }
    }
  }
}

TEST_CASE("extreme: from white walls under an open top all light escapes; in a closed white room the run is refused") {
  Room room = without_surface(unit_cube(1.0, isotropic({0.5, 0.4, 0.5})), "ceiling");
  for (const Estimator estimator : {Estimator::weight, Estimator::collision}) {
    const Result result = simulate(room, settings_of(estimator, Engine::embree, 2e4, 30));
    CHECK(result.balance.escaped == 1.0);
    CHECK(result.balance.absorbed == 0.0);
    CHECK(result.balance.residual == 0.0);
    check_all_finite(result);
  }
  for (const Engine engine : both_engines) {
    const std::string message =
        refusal([&] { simulate(unit_cube(1.0, centre), settings_of(Estimator::collision, engine, 1e4, 30)); });
    INFO(message);
    CHECK(message.find("reflect") != std::string::npos);
  }
}

TEST_CASE(
    "extreme: where light goes round a thousand million times a run ends when it is told to, and says what is left") {
  Settings settings = settings_of(Estimator::collision, Engine::cuboid, 1e6, 31);
  settings.max_seconds = 1.0;
  const Result result = simulate(unit_cube(1.0 - 1e-9, centre), settings);
  CHECK_FALSE(result.warnings.empty());
  CHECK(result.balance.residual > 0.0);

  settings = settings_of(Estimator::weight, Engine::cuboid, 1e4, 31);
  settings.max_bounces = 50;
  const Result cut = simulate(unit_cube(1.0 - 1e-9, centre), settings);
  CHECK(cut.balance.residual == Approx(1.0).epsilon(1e-6));
  CHECK_FALSE(cut.warnings.empty());
}

TEST_CASE("extreme: reflectances outside 0 to 1 are refused") {
  for (const double reflectance : {-1e-9, 1.0 + 1e-9, std::numeric_limits<double>::quiet_NaN()}) {
    Room room = unit_cube(0.5, centre);
    room.surfaces[2].reflectance = reflectance;
    const std::string message =
        refusal([&] { simulate(room, settings_of(Estimator::collision, Engine::automatic, 1e4, 32)); });
    INFO(message);
    CHECK(message.find(room.surfaces[2].name) != std::string::npos);
    CHECK(message.find("reflectance") != std::string::npos);
  }
}

TEST_CASE("extreme: one white wall among black ones absorbs nothing") {
  for (const Engine engine : both_engines) {
    for (const Estimator estimator : {Estimator::weight, Estimator::collision}) {
      Room room = unit_cube(0.0, centre);
      for (Surface& surface : room.surfaces) surface.reflectance = surface.name == "floor" ? 1.0 : 0.0;
      const Result result = simulate(room, settings_of(estimator, engine, 1e5, 33));
      CHECK(result.incident - power_on(result, "floor") == Approx(1.0).epsilon(1e-14));
      check_shares({share(power_on(result, "floor"), 1.0 / 6.0, 100'000)});
      CHECK(result.balance.absorbed == 1.0);
    }
  }
}
