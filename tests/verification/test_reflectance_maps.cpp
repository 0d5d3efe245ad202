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
    const Judgement verdict = compare(against(result, "ceiling", expected(rho)));
    INFO(to_string(estimator) << ": " << verdict.text);
    WARN(verdict.text);
    CHECK(verdict.agrees);
    CHECK(verdict.smallest_bias < 0.02);
    CHECK_FALSE(compare(against(result, "ceiling", expected(swapped))).agrees);
  }
}

TEST_CASE("vertex colours: the ceiling receives what a non-uniform floor reflects") {
  const auto luminance_at = [](double x, double z) { return 0.2126 * x + 0.7152 * (1.0 - z) + 0.0722 * 0.5; };
  // Exchanged axes, as from an error in the order of the corners.
  const auto swapped = [&](double x, double z) { return luminance_at(z, x); };
  const ReflectanceMap map = uneven();
  for (const bool mapped : {false, true}) {
    Room room = unit_cube(0.0, paper_emitter());
    Surface& floor = room.surfaces[0];
    for (const glm::dvec3& p : floor.positions) floor.vertex_colours.emplace_back(p.x, 1.0 - p.z, 0.5);
    if (mapped) give_map(room, 0, map);
    floor.reflectance = mean_reflectance(room, floor);
    const Result result = simulate_uneven_floor(room, Estimator::collision);
    CHECK(result.engine == Engine::embree);
    const auto figures = [&](const std::function<double(double, double)>& colour) {
      const auto rho = [&](double x, double z) { return colour(x, z) * (mapped ? reflectance_at(map, x, z) : 1.0); };
      return against(result, "ceiling", [&](const Tile& tile) {
        return tile_mean(tile.point, {0.1, 0, 0}, {0, 0, 0.1}, 2,
                         [&](const glm::dvec3& p) { return ceiling_irradiance(p, rho); });
      });
    };
    const Judgement verdict = compare(figures(luminance_at));
    INFO((mapped ? "with a map: " : "alone: ") << verdict.text);
    WARN(verdict.text);
    CHECK(verdict.agrees);
    CHECK(verdict.smallest_bias < 0.03);
    CHECK_FALSE(compare(figures(swapped)).agrees);
    const Balance& b = result.balance;
    CHECK(std::abs(b.absorbed + b.escaped + b.residual + b.lost - b.emitted) <= 16 * 0x1p-53 * b.emitted);
  }
}

TEST_CASE("reflectance maps: all three estimators agree in a room with non-uniform walls") {
  Room room = unit_cube(0.6, paper_emitter());
  for (std::size_t k = 0; k < 6; ++k) give_map(room, k, uneven());
  std::vector<Result> results;
  for (const Estimator estimator : estimators)
    results.push_back(simulate(room, settings_of(estimator, Engine::automatic, 2e6, 600 + results.size(), 0.2)));
  for (std::size_t k = 0; k < 3; ++k) {
    const Judgement verdict = compare(against(results[k], results[(k + 1) % 3]));
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

TEST_CASE("reflectance maps: a surface absorbs what its lit part absorbs, not what its mean reflectance suggests") {
  // A floor of which one half is black and one half white, in a black cube. The beam ends on the black half; the
  // look-up is bilinear, so the map is black up to u = 0.25.
  for (const double x : {0.1, 0.9}) {
    Room room = unit_cube(0.0, lambert({x, 0.5, 0.5}, {0.0, -1.0, 0.0}, 1e6, 1000.0));
    give_map(room, 0, {"half", 2, 1, {0.0F, 1.0F}, Wrap::clamp, Wrap::clamp});
    REQUIRE(room.surfaces[0].reflectance == Approx(0.5));
    for (const Estimator estimator : {Estimator::weight, Estimator::collision}) {
      for (const Direct direct : {Direct::sampled, Direct::analytic}) {
        Settings settings = settings_of(estimator, Engine::automatic, 20'000, 7, 0.5);
        settings.direct = direct;
        const Result result = simulate(room, settings);
        const SurfaceResult& floor = surface_named(result, "floor");
        CHECK(floor.absorbed == Approx(x < 0.5 ? 1000.0 : 0.0).margin(1e-9));
        // What follows from the mean reflectance, as a wrong program would do.
        CHECK(floor.power * (1.0 - floor.reflectance) == Approx(500.0).epsilon(1e-3));
      }
    }
  }
}

TEST_CASE("reflectance maps: absorbed power by surface adds up to the balance and agrees with quadrature") {
  const Room room = room_with_uneven_floor();
  // ∫ (1 − ρ) E over the floor, which receives direct light only: all other surfaces are black. The midpoints of
  // 400 × 400 cells: E is smooth, ρ has kinks, so that the error is below 1e-5 of the whole.
  constexpr int n = 400;
  double exact = 0.0;
  double incident = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const glm::dvec3 from_lamp = glm::dvec3((i + 0.5) / n, 0.0, (j + 0.5) / n) - glm::dvec3(0.5);
      const double r = glm::length(from_lamp);
      const double direct = 6.0 / (2.0 * pi) * std::pow(0.5 / r, 6) / (r * r) / (n * n);
      incident += direct;
      exact += (1.0 - reflectance_at(room.reflectance_maps[0], (i + 0.5) / n, (j + 0.5) / n)) * direct;
    }
  }
  for (const Estimator estimator : estimators) {
    for (const Direct direct : {Direct::sampled, Direct::analytic}) {
      Settings settings = settings_of(estimator, Engine::automatic, 1e6, 502, 0.2);
      settings.direct = direct;
      const Result result = simulate(room, settings);
      double sum = 0.0;
      for (const SurfaceResult& surface : result.surfaces) sum += surface.absorbed;
      CHECK(sum == Approx(result.balance.absorbed).epsilon(1e-12));
      // At most one absorption on the floor per history: p(1 − p)/N bounds the variance for every estimator. With
      // integrated direct light eight histories share their first flight.
      const double shared = direct == Direct::analytic ? 8.0 : 1.0;
      const double error = std::sqrt(exact * (1.0 - exact) * shared / 1e6);
      const double absorbed = surface_named(result, "floor").absorbed;
      const Judgement verdict = compare({{absorbed, error, exact}});
      INFO(to_string(estimator) << ": " << verdict.text);
      CHECK(verdict.smallest_bias < 0.02);
      CHECK(std::abs(absorbed - exact) < largest_z_allowed(1) * error);
      // By the mean reflectance the figure would be rejected.
      CHECK(std::abs(incident * (1.0 - room.surfaces[0].reflectance) - exact) > largest_z_allowed(1) * error);
    }
  }
}

TEST_CASE("reflectance maps: backward walks leave the absorbed power of textured surfaces open") {
  Settings settings = settings_of(Estimator::collision, Engine::automatic, 10'000, 3, 0.5);
  settings.tile_walk = WalkDirection::backward;
  const Result result = simulate(room_with_uneven_floor(), settings);
  CHECK(std::isnan(surface_named(result, "floor").absorbed));
  const SurfaceResult& ceiling = surface_named(result, "ceiling");
  CHECK(ceiling.absorbed == ceiling.power);  // it is black
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
