// No photons are lost: not at edges and corners, not in hundreds of millions of impacts, for any position and size of
// the room.
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// The cube of the paper, scaled about the origin and moved.
Room cube_at(double scale, const glm::dvec3& offset) {
  Room room = unit_cube(0.6, paper_emitter());
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& position : surface.positions) position = scale * position + offset;
  }
  auto& emitter = std::get<LambertEmitter>(room.emitters[0].shape);
  emitter.position = scale * emitter.position + offset;
  return room;
}

}  // namespace

// With LICHTMC_LONG_TESTS=1 a billion, which take more than a minute.
TEST_CASE("lost is 0 in 200 million impacts in the closed cuboid by Embree") {
  const double share = std::getenv("LICHTMC_LONG_TESTS") != nullptr ? 1.0 : 0.2;
  // Reflectance 0.9: ten impacts per history. A photon that left the room would be counted lost, and a photon behind a
  // wall would count as a hit from behind.
  const Room room = unit_cube(0.9, isotropic({0.5, 0.5, 0.5}));
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::embree, share * 1.001e8, 1));
  REQUIRE(static_cast<double>(result.walk.impacts) >= share * 1e9);
  WARN(result.walk.impacts << " impacts, lost " << result.lost_histories << ", traced again " << result.walk.retraced
                           << ", " << result.walk.seconds << " s");
  CHECK(result.lost_histories == 0);
  CHECK(result.balance.lost == 0.0);
  CHECK(result.balance.escaped == 0.0);
  CHECK(result.balance.absorbed == result.balance.emitted);
  for (const SurfaceResult& surface : result.surfaces) CHECK(surface.behind_share == 0.0);
  const Judgement verdict = compare({{result.incident, result.incident_standard_error, 10.0, 0.0}});
  INFO(verdict.text);
  CHECK(verdict.agrees);
}

TEST_CASE("a room scaled by a power of two gives the same bits") {
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const Result reference = simulate(cube_at(1.0, glm::dvec3(0.0)), settings_of(Estimator::collision, engine, 1e5, 2));
    for (const double scale : {0x1p-20, 0x1p20}) {
      const Result scaled =
          simulate(cube_at(scale, glm::dvec3(0.0)), settings_of(Estimator::collision, engine, 1e5, 2, 0.1 * scale));
      CHECK(scaled.lost_histories == 0);
      bool same = scaled.tiles.size() == reference.tiles.size();
      for (std::size_t i = 0; same && i < scaled.tiles.size(); ++i)
        same = scaled.tiles[i].power == reference.tiles[i].power;
      CHECK(same);
    }
  }
}

TEST_CASE("a room a million metres away gives the same irradiance") {
  // (At this distance float coordinates do not resolve the walls, so the room is not recognised as a cuboid.)
  for (const Engine engine : {Engine::automatic, Engine::embree}) {
    const Result here = simulate(cube_at(1.0, glm::dvec3(0.0)), settings_of(Estimator::collision, engine, 1e6, 3));
    const Result there = simulate(cube_at(1.0, {1e6, -1e6, 1e6}), settings_of(Estimator::collision, engine, 1e6, 4));
    CHECK(there.lost_histories == 0);
    CHECK(there.balance.escaped == 0.0);
    const Judgement verdict = compare(against(here, there));
    INFO(to_string(engine) << ": " << verdict.text);
    CHECK(verdict.agrees);
  }
}

TEST_CASE("an isotropic emitter on a wall emits half of its flux outwards and on an edge three quarters") {
  struct Case {
    glm::dvec3 position;
    double escaped;
  };
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    std::vector<Compared> figures;
    for (const Case& each : {Case{{0.5, 0.0, 0.5}, 0.5}, Case{{0.0, 0.0, 0.5}, 0.75}, Case{{0.0, 0.0, 0.0}, 0.875}}) {
      const Result result =
          simulate(unit_cube(0.0, isotropic(each.position)), settings_of(Estimator::collision, engine, 1e6, 6));
      const double e = each.escaped;
      figures.push_back({result.balance.escaped, std::sqrt(e * (1.0 - e) / 1e6), e, 0.0});
      CHECK(result.lost_histories == 0);
      CHECK(std::abs(result.balance.escaped + result.incident - 1.0) < 1e-12);
    }
    const Judgement verdict = compare(figures);
    INFO(to_string(engine) << ": " << verdict.text);
    CHECK(verdict.agrees);
  }
}

TEST_CASE("an emitter on a wall that emits into the room loses no flux") {
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const Result result = simulate(unit_cube(0.0, lambert({0.5, 1.0, 0.5}, {0, -1, 0}, 1.0)),
                                   settings_of(Estimator::collision, engine, 1e6, 6));
    CHECK(surface_named(result, "ceiling").hits == 0);
    CHECK(result.walk.impacts == 1'000'000);
  }
}
