// Whole rooms from files: balance, agreement of the estimators, mirrored nodes.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>

#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

const std::vector<Estimator> estimators{Estimator::weight, Estimator::collision, Estimator::absorption};

// Tiles that both results hit at least 50 times: a standard error from fewer hits is itself too uncertain for a
// z-score.
std::vector<Compared> well_hit(const Result& a, const Result& b) {
  std::vector<Compared> figures;
  const std::vector<Compared> all = against(a, b);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (a.tiles[i].hits >= 50 && b.tiles[i].hits >= 50) figures.push_back(all[i]);
  }
  return figures;
}

void check_balance(const Result& result) {
  const Balance& b = result.balance;
  // Four numbers, each a few roundings from an integer times the same factor.
  CHECK(std::abs(b.absorbed + b.escaped + b.residual + b.lost - b.emitted) <= 16 * 0x1p-53 * b.emitted);
  double absorbed = 0.0;
  double variance = 0.0;
  for (const SurfaceResult& surface : result.surfaces) {
    if (surface.hits == 0) continue;
    absorbed += (1.0 - surface.reflectance) * surface.power;
    const double lit_m2 = surface.area_m2 - surface.unreached_area_m2;
    variance += std::pow((1.0 - surface.reflectance) * surface.standard_error * lit_m2, 2);
  }
  // Impacts times 1 − ρ are another estimate of the absorbed power; the surfaces' errors are correlated, so their sum
  // in quadrature is a guide: three times the limit for one figure.
  CHECK(std::abs(absorbed - b.absorbed) <= 3.0 * largest_z_allowed(1) * std::sqrt(variance) + 1e-9 * b.emitted);
}

std::vector<Result> by_all_estimators(const Room& room, double photons, double tile_edge_m, std::uint64_t seed) {
  std::vector<Result> results;
  for (const Estimator estimator : estimators) {
    results.push_back(simulate(room, settings_of(estimator, Engine::automatic, photons, seed++, tile_edge_m)));
    const Result& result = results.back();
    check_balance(result);
    WARN(to_string(estimator) << ": " << result.walk.impacts << " impacts in " << result.walk.seconds << " s, escaped "
                              << result.balance.escaped << ", lost " << result.lost_histories
                              << " histories, tiles not hit " << result.tiles_without_hits << " of "
                              << result.tiles.size());
  }
  return results;
}

void check_agreement(const std::vector<Result>& results) {
  for (std::size_t k = 0; k < results.size(); ++k) {
    const std::vector<Compared> figures = well_hit(results[k], results[(k + 1) % results.size()]);
    REQUIRE(figures.size() > 100);
    const Judgement verdict = compare(figures);
    INFO(to_string(results[k].settings.estimator)
         << " against " << to_string(results[(k + 1) % results.size()].settings.estimator) << ": " << verdict.text);
    WARN(verdict.text);
    CHECK(verdict.agrees);
  }
}

}  // namespace

TEST_CASE("living room: balance closes and the three estimators agree tile by tile") {
  const Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  const std::vector<Result> results = by_all_estimators(room, 1e6, 0.25, 71);
  for (const Result& result : results) {
    CHECK(result.lost_histories == 0);
    CHECK(result.balance.escaped > 0.0);  // through the window
  }
  check_agreement(results);
}

TEST_CASE("garage from other authors: balance closes and the three estimators agree tile by tile") {
  const std::string file = std::string(LICHTMC_ROOMS) + "/real/webxr_garage/garage.gltf";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: " << file << " is not there (set LICHTMC_ROOMS to the folder of the room files)");
    return;
  }
  Room room = read_gltf(file);
  // Some base colours are exactly 1, which the absorption estimator cannot handle.
  limit_reflectance(room, 0.9);
  const std::vector<Result> results = by_all_estimators(room, 1e7, 0.25, 81);
  for (const Result& result : results) CHECK(result.lost_histories == 0);
  check_agreement(results);
}

TEST_CASE("a mirrored node is the mirrored room") {
  // The paper's cube with its emitter off the centre, once mirrored in x by a negative scale: tile maps are mirror
  // images.
  Room room = make_cuboid({1.0, 1.0, 1.0}, {0.2, 0.8, 0.3, 0.7, 0.5, 0.5});
  room.emitters.push_back(lambert({0.3, 0.8, 0.6}, {0.5, -1, 0}, 2.0));
  Room mirrored = room;
  for (Surface& surface : mirrored.surfaces) {
    for (glm::dvec3& position : surface.positions) position.x = -position.x;
    for (glm::uvec3& triangle : surface.triangles) std::swap(triangle.y, triangle.z);
  }
  mirrored.emitters[0] = lambert({-0.3, 0.8, 0.6}, {-0.5, -1, 0}, 2.0);
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const Result a = simulate(room, settings_of(Estimator::collision, engine, 2e6, 61));
    const Result b = simulate(mirrored, settings_of(Estimator::collision, engine, 2e6, 62));
    const Judgement verdict = compare(against(a, b));
    INFO(to_string(engine) << ": " << verdict.text);
    CHECK(verdict.agrees);
    for (const SurfaceResult& surface : b.surfaces) CHECK(surface.behind_share == 0.0);
  }
}

TEST_CASE("a rotated cuboid is recognised and gives the same irradiance") {
  Room room = make_cuboid({2.0, 1.0, 1.5}, {0.2, 0.8, 0.3, 0.7, 0.5, 0.6});
  room.emitters.push_back(lambert({0.3, 0.8, 0.6}, {0.5, -1, 0}, 2.0));
  // A rotation with rational elements: no coordinate is rounded twice.
  const glm::dmat3 turn(glm::dvec3(2, -2, 1) / 3.0, glm::dvec3(1, 2, 2) / 3.0, glm::dvec3(-2, -1, 2) / 3.0);
  Room turned = room;
  for (Surface& surface : turned.surfaces) {
    for (glm::dvec3& position : surface.positions) position = turn * position + glm::dvec3(3, -1, 7);
  }
  turned.emitters[0] =
      lambert(turn * glm::dvec3(0.3, 0.8, 0.6) + glm::dvec3(3, -1, 7), turn * glm::dvec3(0.5, -1, 0), 2.0);
  const Result straight = simulate(room, settings_of(Estimator::collision, Engine::cuboid, 2e6, 63));
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const Result result = simulate(turned, settings_of(Estimator::collision, engine, 2e6, 64));
    const Judgement verdict = compare(against(straight, result));
    INFO(to_string(engine) << ": " << verdict.text);
    CHECK(verdict.agrees);
  }
}

TEST_CASE("the two sides of a two-sided screen have separate tile maps") {
  // A screen across the middle of a cube, light on one side only: the other side is dark if the cube is black.
  Room room = unit_cube(0.0, isotropic({0.5, 0.75, 0.5}));
  Surface sheet;
  sheet.name = "sheet";
  sheet.reflectance = 0.5;
  sheet.sides = Sides::both;
  sheet.positions = {{0, 0.5, 0}, {1, 0.5, 0}, {0, 0.5, 1}, {1, 0.5, 1}};
  sheet.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  sheet.triangles = {{0, 2, 1}, {1, 2, 3}};
  room.surfaces.push_back(sheet);
  const Result result = simulate(room, settings_of(Estimator::collision, Engine::automatic, 1e5, 65));
  CHECK(surface_named(result, "sheet").hits > 0);
  CHECK(surface_named(result, "sheet.back").hits == 0);
  CHECK(surface_named(result, "floor").hits == 0);
  CHECK(surface_named(result, "sheet").behind_share == 0.0);
  // Turned over, the screen receives the same light on its back.
  room.surfaces.back().triangles = {{0, 1, 2}, {1, 3, 2}};
  const Result over = simulate(room, settings_of(Estimator::collision, Engine::automatic, 1e5, 65));
  CHECK(surface_named(over, "sheet").hits == 0);
  CHECK(surface_named(over, "sheet.back").hits == surface_named(result, "sheet").hits);
  // With one tile map for both sides the share from behind is reported.
  room.surfaces.back().sides = Sides::one;
  const Result one = simulate(room, settings_of(Estimator::collision, Engine::automatic, 1e5, 65));
  CHECK(surface_named(one, "sheet").behind_share == 1.0);
}
