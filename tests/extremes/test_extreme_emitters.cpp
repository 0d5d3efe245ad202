// Emitters that touch surfaces, and emission laws at their limits.
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "extremes.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double photons = 1e5;
constexpr auto n = static_cast<std::uint64_t>(photons);

Result simulate_in(const Emitter& emitter, Engine engine, double tile_edge_m = 0.1, double reflectance = 0.0) {
  return simulate(unit_cube(reflectance, emitter), settings_of(Estimator::collision, engine, photons, 12, tile_edge_m));
}

// A beam without width.
Emitter beam(const glm::dvec3& from, const glm::dvec3& axis) {
  return lambert(from, axis, 1e30);
}

}  // namespace

TEST_CASE("extreme: an emitter on a wall does not illuminate that wall") {
  for (const Engine engine : both_engines) {
    const Result result = simulate_in(lambert({0.3, 0.0, 0.6}, {0, 1, 0}, 1.0), engine);
    CHECK(power_on(result, "floor") == 0.0);
    CHECK(result.incident == 1.0);
    CHECK(result.balance.absorbed == 1.0);
  }
}

TEST_CASE(
    "extreme: of an isotropic emitter on a wall a half stays inside, on an edge a quarter, in a corner an eighth") {
  for (const Engine engine : both_engines) {
    std::vector<Compared> shares;
    for (const auto& [position, inside] : std::vector<std::pair<glm::dvec3, double>>{
             {{0.3, 0.0, 0.6}, 0.5}, {{0.3, 0.0, 0.0}, 0.25}, {{1.0, 1.0, 0.0}, 0.125}}) {
      const Result result = simulate_in(isotropic(position), engine);
      shares.push_back(share(result.balance.absorbed, inside, n));
      CHECK(result.balance.absorbed + result.balance.escaped == Approx(1.0).epsilon(1e-15));
      CHECK(result.lost_histories == 0);
    }
    check_shares(shares);
  }
}

TEST_CASE("extreme: an emitter outside a closed room illuminates nothing inside") {
  Room room = unit_cube(0.5, isotropic({0.5, 1.5, 0.5}));
  Surface plate;
  plate.name = "plate";
  plate.positions = {{0.2, 0.5, 0.2}, {0.8, 0.5, 0.2}, {0.8, 0.5, 0.8}, {0.2, 0.5, 0.8}};
  plate.triangles = {{0, 2, 1}, {0, 3, 2}};
  room.surfaces.push_back(plate);
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::embree, photons, 14));
  CHECK(power_on(result, "plate") == 0.0);
  CHECK(power_on(result, "floor") == 0.0);
  CHECK(result.balance.escaped > 0.5);
  CHECK_FALSE(result.warnings.empty());
}

TEST_CASE("extreme: an emitter on the floor that emits downwards illuminates nothing, and the run ends") {
  for (const Engine engine : both_engines) {
    const Result result = simulate_in(lambert({0.3, 0.0, 0.6}, {0, -1, 0}, 1.0), engine);
    CHECK(result.incident == 0.0);
    CHECK(result.balance.escaped == 1.0);
  }
}

TEST_CASE(
    "extreme: a Lambert emitter a billionth of a metre over the floor that shines along it lights it with a half") {
  for (const Engine engine : both_engines) {
    const Result along = simulate_in(lambert({0.3, 1e-9, 0.6}, {1, 0, 0}, 1.0), engine);
    check_shares({share(power_on(along, "floor"), 0.5, n)});
    CHECK(along.incident == 1.0);
    CHECK(simulate_in(isotropic({0.3, 1e-9, 0.6}), engine).incident == 1.0);
    // Behind the floor by a rounding counts as on it if the emitter emits into the room.
    CHECK(simulate_in(lambert({0.3, -1e-9, 0.6}, {0, 1, 0}, 1.0), engine).incident == 1.0);
    // At 1 m the floats of files do not resolve this distance.
    check_shares({share(simulate_in(isotropic({1.0 - 1e-9, 0.3, 0.6}), engine).incident, 0.5, n)});
  }
}

TEST_CASE("extreme: an axis in the plane of a wall") {
  for (const Engine engine : both_engines) {
    const Result result = simulate_in(lambert({0.5, 0.0, 0.5}, {1, 0, 0}, 1.0), engine, 0.1, 0.6);
    check_all_finite(result);
    check_shares({share(result.balance.escaped, 0.5, n)});
  }
}

TEST_CASE("extreme: beams along the axes hit the tile that they point at") {
  for (const Engine engine : both_engines) {
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(-1, -0.0, 0.0), glm::dvec3(0, 1, 0),
                                   glm::dvec3(-0.0, -1, -0.0), glm::dvec3(0, 0, 1), glm::dvec3(0.0, -0.0, -1)}) {
      const glm::dvec3 from(0.35, 0.45, 0.65);
      const Result result = simulate_in(beam(from, axis), engine);
      REQUIRE(lit_tiles(result).size() == 1);
      const std::size_t lit = lit_tiles(result).front();
      CHECK(result.tiles[lit].power == 1.0);
      const glm::dvec3 segment = result.tiling.tiles[lit].point - from;
      CHECK(glm::length(segment - glm::dot(segment, axis) * axis) < 1e-6);
      CHECK(glm::dot(segment, axis) > 0.0);
    }
  }
}

TEST_CASE("extreme: a beam at a corner, an edge or a diagonal is counted exactly once") {
  for (const Engine engine : both_engines) {
    for (const glm::dvec3& to : {glm::dvec3(0, 0, 0), glm::dvec3(1, 1, 1), glm::dvec3(0.5, 0, 0), glm::dvec3(0, 0.5, 1),
                                 glm::dvec3(0.5, 0, 0.5), glm::dvec3(0.25, 0, 0.25), glm::dvec3(0.25, 0, 0.75)}) {
      const glm::dvec3 from(0.5, 0.5, 0.5);
      const Result result = simulate_in(beam(from, to - from), engine);
      CHECK(result.walk.impacts == n);
      CHECK(result.incident == 1.0);
      CHECK(result.lost_histories == 0);
    }
  }
}

TEST_CASE("extreme: a beam at the border of tiles is counted completely on the adjacent tiles") {
  for (const Engine engine : both_engines) {
    const Result result = simulate_in(beam({0.5, 0.5, 0.45}, {0, -1, 0}), engine);
    CHECK(result.incident == 1.0);
    for (const std::size_t lit : lit_tiles(result)) {
      const glm::dvec3 point = result.tiling.tiles[lit].point;
      CHECK(std::abs(point.x - 0.5) == Approx(0.05));
      CHECK(point.z == Approx(0.45));
      CHECK(point.y == Approx(0.0).margin(1e-12));
    }
  }
}

TEST_CASE("extreme: a uniform hemisphere (m = 0) at the cube's centre: a third down, a sixth on each wall, none up") {
  for (const Engine engine : both_engines) {
    const Result result = simulate_in(lambert({0.5, 0.5, 0.5}, {0, -1, 0}, 0.0), engine);
    CHECK(power_on(result, "ceiling") == 0.0);
    check_shares({share(power_on(result, "floor"), 1.0 / 3.0, n), share(power_on(result, "wall_x0"), 1.0 / 6.0, n),
                  share(power_on(result, "wall_x1"), 1.0 / 6.0, n), share(power_on(result, "wall_z0"), 1.0 / 6.0, n)});
  }
}

TEST_CASE("extreme: a Lambert emitter (m = 1) at the cube's centre") {
  // From the form factor of a parallel square over its corner at distances ½, ½, ½, four times.
  constexpr double floor = 0.554126423980;
  constexpr double wall = 0.111468394005;
  for (const Engine engine : both_engines) {
    const Result result = simulate_in(lambert({0.5, 0.5, 0.5}, {0, -1, 0}, 1.0), engine);
    CHECK(power_on(result, "ceiling") == 0.0);
    check_shares({share(power_on(result, "floor"), floor, n), share(power_on(result, "wall_x0"), wall, n),
                  share(power_on(result, "wall_x1"), wall, n), share(power_on(result, "wall_z1"), wall, n)});
  }
}

TEST_CASE("extreme: narrow beams (m = 10⁶, 10³⁰ and the largest number) end in the tile below") {
  for (const Engine engine : both_engines) {
    for (const double exponent : {1e6, 1e30, std::numeric_limits<double>::max()}) {
      // At ½ m distance m = 10⁶ leaves a circle of 0.1 m with the probability (1 + 0.04)^(−5·10⁵).
      const Result result = simulate_in(lambert({0.5, 0.5, 0.5}, {0, -1, 0}, exponent), engine, 0.2);
      REQUIRE(lit_tiles(result).size() == 1);
      CHECK(result.tiles[lit_tiles(result).front()].power == 1.0);
      check_all_finite(result);
    }
  }
}

TEST_CASE("extreme: exponents below 0 and NaN are refused") {
  for (const double exponent : {-1e-9, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const std::string message = refusal([&] {
      simulate_in(lambert({0.5, 0.5, 0.5}, {0, -1, 0}, exponent), Engine::cuboid);
    });
    INFO(message);
    CHECK(message.find("exponent") != std::string::npos);
  }
}

TEST_CASE("extreme: an emitter without power changes nothing") {
  for (const Engine engine : both_engines) {
    Room room = unit_cube(0.6, paper_emitter());
    room.emitters.push_back(isotropic({0.2, 0.8, 0.2}, 0.5));
    const Settings settings = settings_of(Estimator::collision, engine, photons, 51);
    const Result without = simulate(room, settings);
    room.emitters.push_back(isotropic({0.7, 0.7, 0.7}, 0.0));
    room.emitters.push_back(surface_emitter(1, 0.0));
    const Result with = simulate(room, settings);
    for (std::size_t k = 0; k < with.tiles.size(); ++k) REQUIRE(with.tiles[k].power == without.tiles[k].power);
  }
}
