// Enclosures without absorption are refused before the walk; others are not.
#include "lichtmc/error.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// A room with a second, smaller cuboid in its middle.
Room with_inner_cube(double outer, double inner, const glm::dvec3& emitter_point) {
  Room room = unit_cube(outer, isotropic(emitter_point));
  for (Surface surface : make_cuboid({0.2, 0.2, 0.2}, uniform_reflectance(inner)).surfaces) {
    surface.name = "inner_" + surface.name;
    for (glm::dvec3& position : surface.positions) position += glm::dvec3(0.4);
    room.surfaces.push_back(surface);
  }
  return room;
}

Settings short_run() {
  return settings_of(Estimator::collision, Engine::automatic, 5000, 1);
}

}  // namespace

TEST_CASE("an emitter in an enclosure without absorption is refused for any room around it") {
  CHECK_THROWS_AS(simulate(unit_cube(1.0, isotropic(glm::dvec3(0.5))), short_run()), InputError);
  CHECK_THROWS_WITH(simulate(with_inner_cube(0.5, 1.0, glm::dvec3(0.5)), short_run()),
                    ContainsSubstring("reflectance"));
}

TEST_CASE("a truncated walk in an enclosure without absorption reports the residual") {
  Settings settings = short_run();
  settings.estimator = Estimator::weight;
  settings.max_bounces = 7;
  const Result result = simulate(unit_cube(1.0, isotropic(glm::dvec3(0.5))), settings);
  CHECK(result.balance.residual == 1.0);
  CHECK(result.walk.impacts == 7 * 5000);
}

TEST_CASE("perfect reflectors with something that absorbs or an opening are simulated") {
  CHECK(simulate(with_inner_cube(0.5, 1.0, glm::dvec3(0.1)), short_run()).balance.absorbed == 1.0);
  CHECK(simulate(with_inner_cube(1.0, 0.5, glm::dvec3(0.1)), short_run()).balance.absorbed == 1.0);
  // With one wall missing all light escapes: exactly, photon by photon.
  const Result open = simulate(without_surface(unit_cube(1.0, isotropic(glm::dvec3(0.5))), "ceiling"), short_run());
  CHECK(open.balance.escaped == 1.0);
  CHECK(open.walk.impacts > 5000);
}
