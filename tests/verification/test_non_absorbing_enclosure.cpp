// Enclosures without absorption are refused before the walk; others are not.
#include "lichtmc/error.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "walk/non_absorbing_enclosure.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// A room with a second, smaller cuboid in its middle.
Room with_inner_cube(double outer, double inner, const glm::dvec3& emitter_point, double edge = 0.2) {
  Room room = unit_cube(outer, isotropic(emitter_point));
  for (Surface surface : make_cuboid(glm::dvec3(edge), uniform_reflectance(inner)).surfaces) {
    surface.name = "inner_" + surface.name;
    for (glm::dvec3& position : surface.positions) position += glm::dvec3(0.5 - 0.5 * edge);
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

TEST_CASE(
    "a speck that absorbs one flight in ten thousand is enough; a trap for a hundredth of the light is too much") {
  const auto refused = [](const Room& room) {
    return has_non_absorbing_enclosure(Scene(room, make_tiling(room, 0.5), Engine::embree), 1);
  };
  // A cube of 1 cm in one of 1 m: 10⁻⁴ of the walls' area.
  CHECK_FALSE(refused(with_inner_cube(1.0, 0.0, glm::dvec3(0.1), 0.01)));
  Room room = with_inner_cube(0.9, 1.0, glm::dvec3(0.1));
  CHECK_FALSE(refused(room));
  room.emitters.push_back(isotropic(glm::dvec3(0.5), 0.01));  // into the inner cube
  CHECK(refused(room));
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
