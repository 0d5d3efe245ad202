// Reflectance maps: the walk with textures.
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/error.hpp"
#include "room/reflectance.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;
const std::vector<Estimator> estimators{Estimator::weight, Estimator::collision, Estimator::absorption};

// Gives a surface of make_cuboid() a reflectance map over its UVs, which run from 0 to 1.
void give_map(Room& room, std::size_t surface, ReflectanceMap map) {
  room.surfaces[surface].reflectance_map = room.reflectance_maps.size();
  room.surfaces[surface].reflectance_uvs = room.surfaces[surface].uvs;
  room.reflectance_maps.push_back(std::move(map));
  room.surfaces[surface].reflectance = mean_reflectance(room, room.surfaces[surface]);
}

// Dark and bright corners: 3 × 2 pixels without symmetry.
ReflectanceMap uneven() {
  return {"uneven", 3, 2, {0.1F, 0.9F, 0.3F, 0.7F, 0.2F, 0.6F}, Wrap::clamp, Wrap::repeat};
}

// Irradiance of the ceiling of a black unit cube whose floor alone reflects, by the light that the floor receives from
// the paper's emitter: ∫ ρ E_d/π · cos θ cos θ'/r² dA over the floor, 200 × 200 midpoints. Both factors change over
// about 0.3 m; the rule's error is below 1e-5 of the whole.
double ceiling_irradiance(const glm::dvec3& point, const std::function<double(double, double)>& reflectance) {
  constexpr int n = 200;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const glm::dvec3 p((i + 0.5) / n, 0.0, (j + 0.5) / n);
      const glm::dvec3 from_lamp = p - glm::dvec3(0.5);
      const double r = glm::length(from_lamp);
      const double cosine = 0.5 / r;
      const double direct = 6.0 / (2.0 * pi) * std::pow(cosine, 5) * cosine / (r * r);
      const glm::dvec3 up = point - p;
      const double distance2 = glm::dot(up, up);
      sum += reflectance(p.x, p.z) * direct / pi / (distance2 * distance2);  // both cosines are 1/distance
    }
  }
  return sum / (n * n);
}

Room room_with_uneven_floor() {
  Room room = unit_cube(0.0, paper_emitter());
  give_map(room, 0, uneven());
  return room;
}

Result simulate_uneven_floor(const Room& room, Estimator estimator) {
  return simulate(room, settings_of(estimator, Engine::automatic, 2e6, 501, 0.2));
}

}  // namespace

TEST_CASE("reflectance maps: a constant reflectance map gives the same bits as the constant") {
  for (const Estimator estimator : {Estimator::weight, Estimator::collision}) {
    Room room = unit_cube(0.5, paper_emitter());
    const Settings settings = settings_of(estimator, Engine::embree, 20000, 3);
    const Result plain = simulate(room, settings);
    for (std::size_t k = 0; k < 6; ++k) give_map(room, k, {"even", 2, 2, {0.5F, 0.5F, 0.5F, 0.5F}, {}, {}});
    const Result mapped = simulate(room, settings);
    for (std::size_t i = 0; i < plain.tiles.size(); ++i) REQUIRE(mapped.tiles[i].power == plain.tiles[i].power);
    CHECK(mapped.surfaces[0].reflectance == 0.5);
  }
}

TEST_CASE("reflectance maps: the ceiling receives what a non-uniform floor reflects") {
  const Room room = room_with_uneven_floor();
  const auto rho = [&room](double x, double z) { return reflectance_at(room.reflectance_maps[0], x, z); };
  // Exchanged axes, as from an error in the look-up.
  const auto swapped = [&room](double x, double z) { return reflectance_at(room.reflectance_maps[0], z, x); };
  for (const Estimator estimator : estimators) {
    const Result result = simulate_uneven_floor(room, estimator);
    CHECK(result.engine == Engine::embree);
    const auto expected = [](const std::function<double(double, double)>& law) {
      return [law](const Tile& tile) {
        // Over a tile the irradiance is nearly uniform: four points give its mean to 1e-4.
        return tile_mean(tile.point, {0.1, 0, 0}, {0, 0, 0.1}, 2,
                         [&](const glm::dvec3& p) { return ceiling_irradiance(p, law); });
      };
    };
    const Verdict verdict = compare(against(result, "ceiling", expected(rho)));
    INFO(to_string(estimator) << ": " << verdict.text);
    WARN(verdict.text);
    CHECK(verdict.agrees);
    CHECK(verdict.smallest_bias < 0.02);
    CHECK_FALSE(compare(against(result, "ceiling", expected(swapped))).agrees);
  }
}

TEST_CASE("reflectance maps: all three estimators agree in a room with non-uniform walls") {
  Room room = unit_cube(0.6, paper_emitter());
  for (std::size_t k = 0; k < 6; ++k) give_map(room, k, uneven());
  std::vector<Result> results;
  for (const Estimator estimator : estimators)
    results.push_back(simulate(room, settings_of(estimator, Engine::automatic, 2e6, 600 + results.size(), 0.2)));
  for (std::size_t k = 0; k < 3; ++k) {
    const Verdict verdict = compare(against(results[k], results[(k + 1) % 3]));
    INFO(to_string(estimators[k]) << " against " << to_string(estimators[(k + 1) % 3]) << ": " << verdict.text);
    WARN(verdict.text);
    CHECK(verdict.agrees);
    const Balance& b = results[k].balance;
    CHECK(std::abs(b.absorbed + b.escaped + b.residual + b.lost - b.emitted) <= 16 * 0x1p-53 * b.emitted);
    CHECK(results[k].lost_histories == 0);
  }
  // Walls that reflect 5 % more are rejected.
  for (ReflectanceMap& map : room.reflectance_maps) {
    for (float& value : map.values) value *= 1.05F;
  }
  const Result brighter = simulate(room, settings_of(Estimator::collision, Engine::automatic, 2e6, 700, 0.2));
  CHECK_FALSE(compare(against(results[1], brighter)).agrees);
}

TEST_CASE("reflectance maps: the absorption estimator refuses a texture that is white in places") {
  Room room = unit_cube(0.6, paper_emitter());
  give_map(room, 1, {"white spot", 2, 1, {0.5F, 1.0F}, Wrap::clamp, Wrap::clamp});
  CHECK_THROWS_WITH(simulate(room, settings_of(Estimator::absorption, Engine::automatic, 1000, 1)),
                    ContainsSubstring("'ceiling'") && ContainsSubstring("in parts of its texture"));
  CHECK(simulate(room, settings_of(Estimator::collision, Engine::automatic, 1000, 1)).lost_histories == 0);
}

TEST_CASE("reflectance maps: light enclosed by white textures is refused") {
  Room room = unit_cube(0.6, paper_emitter());
  for (std::size_t k = 0; k < 6; ++k) give_map(room, k, {"white", 1, 1, {1.0F}, {}, {}});
  CHECK_THROWS_AS(simulate(room, settings_of(Estimator::collision, Engine::automatic, 1000, 1)), InputError);
}
