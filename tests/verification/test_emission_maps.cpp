// Emission maps: area lights whose exitance varies over the surface, by all methods.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "room/emission.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;

// The ceiling of a unit cube as emitter of 1 W with a map. uv_of: position → coordinates on the map.
Room cube_with_map(double reflectance, EmissionMap map, double exponent,
                   const std::function<glm::dvec2(const glm::dvec3&)>& uv_of) {
  Room room = unit_cube(reflectance, surface_emitter(0, 1.0, exponent));
  auto& shape = std::get<SurfaceEmitter>(room.emitters[0].shape);
  shape.surface = surface_number(room, "ceiling");
  shape.emission_map = 0;
  for (const glm::dvec3& p : room.surfaces[shape.surface].positions) shape.emission_uvs.push_back(uv_of(p));
  room.emission_maps.push_back(std::move(map));
  return room;
}

// Black for x < ½, white beyond: two pixels, so far apart on the surface that the step between them is 10⁻⁶ m wide.
Room half_black(double reflectance, double exponent = 1.0) {
  return cube_with_map(reflectance, {"step", 2, 1, {0.0F, 1.0F}, Wrap::clamp, Wrap::clamp}, exponent,
                       [](const glm::dvec3& p) { return glm::dvec2(0.5 + 5e5 * (p.x - 0.5), 0.5); });
}

// The same room with two surfaces as ceiling, of which the one at x > ½ emits uniformly.
Room half_panel(double reflectance, double exponent = 1.0) {
  Room room = unit_cube(reflectance, surface_emitter(0, 1.0, exponent));
  const std::size_t ceiling = surface_number(room, "ceiling");
  Surface rest = room.surfaces[ceiling];
  rest.name = "rest";
  for (glm::dvec3& p : rest.positions) p.x *= 0.5;
  for (glm::dvec3& p : room.surfaces[ceiling].positions) p.x = 0.5 + 0.5 * p.x;
  room.surfaces.push_back(rest);
  std::get<SurfaceEmitter>(room.emitters[0].shape).surface = ceiling;
  return room;
}

// The mutation that the tests must reject: the map is forgotten.
Room without_map(Room room) {
  auto& shape = std::get<SurfaceEmitter>(room.emitters[0].shape);
  shape.emission_map.reset();
  shape.emission_uvs.clear();
  return room;
}

// Mean irradiance of the tiles of the floor by a reference result, with its error.
std::vector<Compared> floor_against(const Result& result, const Result& expected) {
  std::vector<Compared> figures;
  for (std::size_t i = 0; i < result.tiles.size(); ++i) {
    if (result.tiling.maps[result.tiling.tiles[i].map].name != "floor") continue;
    const TileResult& a = result.tiles[i];
    for (std::size_t k = 0; k < expected.tiles.size(); ++k) {
      const Tile& tile = expected.tiling.tiles[k];
      if (expected.tiling.maps[tile.map].name != "floor" ||
          glm::distance(tile.point, result.tiling.tiles[i].point) > 1e-9)
        continue;
      figures.push_back(
          {a.irradiance, a.standard_error, expected.tiles[k].irradiance, expected.tiles[k].standard_error});
    }
  }
  return figures;
}

void check_both(const std::string& what, const std::vector<Compared>& right, const std::vector<Compared>& mutated,
                double bias) {
  const Judgement verdict = compare(right);
  INFO(what << ": " << verdict.text);
  WARN(what << ": " << verdict.text);
  CHECK(verdict.agrees);
  CHECK(verdict.smallest_bias < bias);
  CHECK_FALSE(compare(mutated).agrees);
}

Receiver receiver_at(const glm::dvec3& position, const glm::dvec3& normal, double half_angle_deg = 90.0) {
  return {"at", position, normal, half_angle_deg, 1.0};
}

std::vector<Receiver> some_receivers() {
  std::vector<Receiver> receivers;
  for (const double x : {0.1, 0.35, 0.6, 0.9}) {
    receivers.push_back(receiver_at({x, 0.2, 0.4}, {0, 1, 0}));
    receivers.push_back(receiver_at({x, 0.9, 0.7}, {0, 1, 0}));
    receivers.push_back(receiver_at({x, 0.5, 0.5}, {0.5, 1, 0.2}, 40.0));
  }
  return receivers;
}

Result receive(Room room, Estimator estimator, std::uint64_t seed) {
  room.receivers = some_receivers();
  Settings settings = settings_of(estimator, Engine::automatic, 400'000, seed);
  settings.measured = Measured::receivers;
  return simulate(room, settings);
}

std::vector<Compared> receivers_against(const Result& a, const Result& b) {
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < a.receiver_results.size(); ++k) {
    const ReceiverResult& left = a.receiver_results[k];
    const ReceiverResult& right = b.receiver_results[k];
    figures.push_back({left.irradiance, left.standard_error, right.irradiance, right.standard_error});
  }
  return figures;
}

// Dark and bright corners: 3 × 2 pixels without symmetry.
const EmissionMap uneven{"uneven", 3, 2, {0.1F, 2.0F, 0.3F, 0.7F, 0.0F, 5.0F}, Wrap::clamp, Wrap::repeat};

// Irradiance of the floor of a black unit cube by the ceiling: ∫ M (m+1)/(2π) cos^m θ cos θ'/r² dA, 300 × 300
// midpoints.
double by_uneven_ceiling(const glm::dvec3& point, double exponent) {
  constexpr int n = 300;
  double sum = 0.0;
  double mean = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const glm::dvec3 p((i + 0.5) / n, 1.0, (j + 0.5) / n);
      const double value = value_at(uneven, p.x, p.z);
      const glm::dvec3 d = p - point;
      const double r2 = glm::dot(d, d);
      const double cosine = d.y / std::sqrt(r2);
      sum += value * (exponent + 1.0) / (2.0 * pi) * std::pow(cosine, exponent) * cosine / r2;
      mean += value;
    }
  }
  return sum / mean;
}

}  // namespace

TEST_CASE("emission maps: a half-black ceiling lights as half a ceiling, by photons and by integration") {
  for (const double exponent : {1.0, 4.0}) {
    const Room mapped = half_black(0.5, exponent);
    const auto run = [](const Room& room, Direct direct, std::uint64_t seed) {
      Settings settings = settings_of(Estimator::collision, Engine::automatic, 1e6, seed, 0.2);
      settings.direct = direct;
      return simulate(room, settings);
    };
    const Result half = run(half_panel(0.5, exponent), Direct::sampled, 71);
    CHECK(run(mapped, Direct::sampled, 1).engine == Engine::embree);
    for (const Direct direct : {Direct::sampled, Direct::analytic}) {
      check_both("m = " + std::to_string(exponent) + ", " + std::string(to_string(direct)),
                 floor_against(run(mapped, direct, 72), half),
                 floor_against(run(without_map(mapped), direct, 73), half), 0.02);
    }
  }
}

TEST_CASE("emission maps: a half-black ceiling lights as half a ceiling, by backward walks from tiles") {
  const auto run = [](const Room& room, std::uint64_t seed) {
    Settings settings = settings_of(Estimator::weight, Engine::automatic, 200'000, seed, 0.25);
    settings.tile_walk = WalkDirection::backward;
    return simulate(room, settings);
  };
  const Result half = run(half_panel(0.5), 81);
  check_both("backward", floor_against(run(half_black(0.5), 82), half),
             floor_against(run(without_map(half_black(0.5)), 83), half), 0.03);
}

TEST_CASE("emission maps: a half-black ceiling lights receivers as half a ceiling") {
  for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption}) {
    const Result half = receive(half_panel(0.6), estimator, 91);
    const Result mapped = receive(half_black(0.6), estimator, 92);
    const Result mutated = receive(without_map(half_black(0.6)), estimator, 93);
    check_both(std::string(to_string(estimator)), receivers_against(mapped, half), receivers_against(mutated, half),
               0.02);
  }
}

TEST_CASE("emission maps: direct light of a half-black ceiling at receivers") {
  // Black walls: all light is direct, and has an error where it is sampled.
  const Result half = receive(half_panel(0.0), Estimator::collision, 95);
  const Result mapped = receive(half_black(0.0), Estimator::collision, 96);
  const Result mutated = receive(without_map(half_black(0.0)), Estimator::collision, 97);
  check_both("direct", receivers_against(mapped, half), receivers_against(mutated, half), 0.01);
}

TEST_CASE("emission maps: the floor receives the integral over a map without symmetry") {
  const auto uv_of = [](const glm::dvec3& p) { return glm::dvec2(p.x, p.z); };
  const auto swapped = [](const glm::dvec3& p) { return glm::dvec2(p.z, p.x); };
  for (const double exponent : {1.0, 3.0}) {
    const auto figures = [&](const Room& room) {
      const Result result = simulate(room, settings_of(Estimator::collision, Engine::automatic, 1e6, 31, 0.2));
      // Over a tile the irradiance is nearly uniform: nine points give its mean to 1e-4.
      return against(result, "floor", [&](const Tile& tile) {
        return tile_mean(tile.point, {0.1, 0, 0}, {0, 0, 0.1}, 3,
                         [&](const glm::dvec3& p) { return by_uneven_ceiling(p, exponent); });
      });
    };
    check_both("m = " + std::to_string(exponent), figures(cube_with_map(0.0, uneven, exponent, uv_of)),
               figures(cube_with_map(0.0, uneven, exponent, swapped)), 0.02);
  }
}
