// Irradiance at points by the backward walk.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/error.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/surfaces.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;
const std::vector<Estimator> estimators{Estimator::weight, Estimator::collision, Estimator::absorption};

Receiver at(const glm::dvec3& position, const glm::dvec3& normal, double half_angle_deg = 90.0, double area_m2 = 1.0) {
  return {"at", position, normal, half_angle_deg, area_m2};
}

Settings backward(Estimator estimator, Engine engine, double photons, std::uint64_t seed) {
  Settings settings = settings_of(estimator, engine, photons, seed);
  settings.measured = Measured::receivers;
  settings.receiver_walk = ReceiverWalk::backward;
  return settings;
}

// Receivers on the floor of a unit cube, at the centres of n × n tiles, with normals upwards.
std::vector<Receiver> on_floor(int n) {
  std::vector<Receiver> receivers;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) receivers.push_back(at({(i + 0.5) / n, 0.0, (j + 0.5) / n}, {0, 1, 0}));
  }
  return receivers;
}

std::vector<Compared> indirect_against(const Result& result, const std::function<double(std::size_t)>& expected) {
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < result.receiver_results.size(); ++k) {
    const ReceiverResult& one = result.receiver_results[k];
    figures.push_back({one.indirect, one.standard_error, expected(k), 0.0});
  }
  return figures;
}

// The direct light of a room's emitters at one receiver.
double direct_at(Room room, const Receiver& receiver, Engine engine = Engine::automatic) {
  room.receivers = {receiver};
  return simulate(room, backward(Estimator::collision, engine, 10, 1)).receiver_results[0].direct;
}

}  // namespace

TEST_CASE("receivers: CIE 171 case 5.2 to the precision of its closed form") {
  // 4 m × 4 m, source 3 m above its centre, I0 = 1000 cd, Lambert; the points of the case with their values in lx.
  Room room;
  Surface plane = make_floor(4.0, 4.0);
  for (glm::dvec3& p : plane.positions) p -= glm::dvec3(2.0, 0.0, 2.0);
  plane.reflectance = 0.0;
  room.surfaces.push_back(plane);
  room.emitters.push_back(lambert({0, 3, 0}, {0, -1, 0}, 1.0, 1000.0 * pi));
  const std::vector<std::array<double, 3>> points{
      {0, 0, 111.111111},  {0.5, 0, 105.186267},  {1, 0, 90},        {1.5, 0, 71.111111}, {0.5, 0.5, 99.722992},
      {1, 0.5, 85.663296}, {1.5, 0.5, 68.052930}, {1, 1, 74.380165}, {1.5, 1, 59.975010}, {1.5, 1.5, 49.382716}};
  for (const auto& [x, z, lux] : points)
    CHECK(direct_at(room, at({x, 0, z}, {0, 1, 0})) == Approx(lux).epsilon(1e-8).margin(1e-6));
}

TEST_CASE("receivers: CIE 171 case 5.6 by the closed polygon formula and by points") {
  // The floor, 4 m × 4 m, emits M = 1; points on a wall above its edge and on the ceiling, 3 m up, 100·E/M.
  Room room = make_cuboid({4.0, 4.0, 4.0}, uniform_reflectance(0.0));
  room.quantity = Quantity::radiometric;
  room.emitters.push_back(surface_emitter(0, 16.0));
  const std::vector<std::array<double, 2>> wall{
      {0.75, 35.900505}, {1.25, 27.991624}, {1.75, 21.638511}, {2.25, 16.716315}, {2.75, 12.967372}};
  for (const auto& [height, expected] : wall)
    CHECK(direct_at(room, at({2.0, height, 0.0}, {0, 0, 1})) == Approx(0.01 * expected).epsilon(1e-7));
  const std::vector<std::array<double, 2>> ceiling{
      {0.25, 26.795188}, {0.75, 30.938711}, {1.25, 33.975719}, {1.75, 35.566592}};
  for (const auto& [z, expected] : ceiling)
    CHECK(direct_at(room, at({2.0, 3.0, z}, {0, -1, 0})) == Approx(0.01 * expected).epsilon(1e-7));
  // By points, as in rooms with shadows: a small box far in a corner makes the room such a room.
  Surface box = make_box(glm::dvec3(0.01));
  for (glm::dvec3& p : box.positions) p += glm::dvec3(3.9, 3.9, 3.9);
  box.reflectance = 0.0;
  room.surfaces.push_back(box);
  for (const auto& [height, expected] : wall) {
    room.receivers = {at({2.0, height, 0.0}, {0, 0, 1})};
    const Result result = simulate(room, backward(Estimator::collision, Engine::automatic, 10, 1));
    const ReceiverResult& one = result.receiver_results[0];
    CHECK(result.receiver_walk.shadow_rays > 0);
    CHECK(one.standard_error > 0.0);
    CHECK(one.standard_error < 1e-2 * one.direct);
    CHECK(std::abs(one.direct - 0.01 * expected) < 5.0 * one.standard_error);
  }
}

TEST_CASE("receivers: the paper's cube, indirect light of every floor tile's centre") {
  for (const double rho : {0.6, 0.9}) {
    const auto map =
        read_table(std::string(LICHTMC_TEST_DATA) + "/cube_cos5_rho" + (rho == 0.6 ? "0.6" : "0.9") + "_floor.csv");
    Room room = unit_cube(rho, paper_emitter());
    room.receivers = on_floor(5);
    // Moved to the centres of every other tile.
    for (Receiver& receiver : room.receivers) receiver.position -= glm::dvec3(0.05, 0.0, 0.05);
    const auto direct = [](const glm::dvec3& p) {
      const glm::dvec3 segment = p - glm::dvec3(0.5);
      const double r = glm::length(segment);
      return 6.0 / (2.0 * pi) * std::pow(0.5 / r, 6) / (r * r);
    };
    // The indirect part is nearly uniform over a tile: its mean is its value at the centre within some 1e-4.
    const auto expected = [&](std::size_t k) {
      const glm::dvec3 centre = room.receivers[k].position;
      return map[2 * (k / 5)][2 * (k % 5)] - tile_mean(centre, {0.05, 0, 0}, {0, 0, 0.05}, 64, direct);
    };
    for (const Engine engine : {Engine::cuboid, Engine::embree}) {
      for (const Estimator estimator : estimators) {
        const Result result = simulate(room, backward(estimator, engine, 1e6, 31));
        CHECK(result.receiver_walk.shadow_rays == 0);
        CHECK(result.receiver_walk.histories == 1000000);
        const Judgement verdict = compare(indirect_against(result, expected));
        check(std::string(to_string(estimator)) + ", " + std::string(to_string(engine)), verdict);
        CHECK(verdict.smallest_bias < 0.05);
        const auto brighter = [&](std::size_t k) { return 1.05 * expected(k); };
        CHECK_FALSE(compare(indirect_against(result, brighter)).agrees);
      }
    }
  }
}

TEST_CASE(
    "receivers: if every wall emits what it absorbs, every receiver has the same irradiance, also at edges and "
    "corners") {
  // M_i = 1 − ρ_i: E = 1 everywhere. Receivers a millimetre from the edges get the emission of the adjacent wall from a
  // very small distance.
  const std::vector<double> rho{0.1, 0.3, 0.5, 0.7, 0.8, 0.4};
  Room room = make_cuboid({1.0, 0.5, 2.0}, {rho[0], rho[1], rho[2], rho[3], rho[4], rho[5]});
  room.quantity = Quantity::radiometric;
  for (std::size_t k = 0; k < 6; ++k)
    room.emitters.push_back(surface_emitter(k, (1.0 - rho[k]) * surface_area(room.surfaces[k])));
  for (const double x : {0.001, 0.3, 0.999}) {
    for (const double z : {0.001, 1.0, 1.9}) room.receivers.push_back(at({x, 0.0, z}, {0, 1, 0}));
    room.receivers.push_back(at({x, 0.499, 0.0}, {0, 0, 1}));
  }
  // Receivers on emitting walls are refused only if they face the wall; these face into the room.
  for (const Estimator estimator : estimators) {
    const Result result = simulate(room, backward(estimator, Engine::automatic, 2e5, 41));
    std::vector<Compared> figures;
    for (const ReceiverResult& one : result.receiver_results)
      figures.push_back({one.irradiance, one.standard_error, 1.0, 0.0});
    check(std::string(to_string(estimator)), compare(figures));
  }
}

TEST_CASE("receivers: a sphere gives every point the same indirect light") {
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/integrating_sphere.glb");
  double area = 0.0;
  for (const Surface& surface : room.surfaces) area += surface_area(surface);
  const double rho = room.surfaces[0].reflectance;
  room.receivers.clear();
  for (int k = 0; k < 12; ++k) {
    const glm::dvec3 out(std::sin(0.7 * k + 0.1) * std::cos(1.3 * k), std::cos(0.7 * k + 0.1),
                         std::sin(0.7 * k + 0.1) * std::sin(1.3 * k));
    room.receivers.push_back(at(0.99 * out, -out));
  }
  const double expected = total_power(room) * rho / ((1.0 - rho) * area);
  for (const Estimator estimator : estimators) {
    const Result result = simulate(room, backward(estimator, Engine::automatic, 2.4e5, 51));
    check(std::string(to_string(estimator)), compare(indirect_against(result, [&](std::size_t) { return expected; })));
    CHECK(result.receiver_walk.shadow_rays == 0);  // no shadows in a sphere
  }
}

TEST_CASE("receivers: a field of view receives its share of uniform light, and none at 0 degrees") {
  Room room = make_cuboid({1.0, 1.0, 1.0}, uniform_reflectance(0.5));
  for (std::size_t k = 0; k < 6; ++k) room.emitters.push_back(surface_emitter(k, 0.5));
  const std::vector<double> angles{0.0, 1.0, 10.0, 30.0, 60.0, 89.0, 90.0};
  for (const double angle : angles) room.receivers.push_back(at({0.5, 0.5, 0.5}, {1, 2, 3}, angle));
  const Result result = simulate(room, backward(Estimator::collision, Engine::automatic, 3e5, 61));
  std::vector<Compared> figures;
  for (std::size_t k = 1; k < angles.size(); ++k) {
    const double sine = std::sin(angles[k] * pi / 180.0);
    const ReceiverResult& one = result.receiver_results[k];
    figures.push_back({one.irradiance, one.standard_error, sine * sine, 0.0});
  }
  check("field of view", compare(figures));
  CHECK(result.receiver_results[0].irradiance == 0.0);
  CHECK(result.receiver_results[0].standard_error == 0.0);
}

TEST_CASE("receivers: emitters behind or outside the field of view give exactly nothing") {
  const Room room = unit_cube(0.5, isotropic({0.5, 0.9, 0.5}));
  CHECK(direct_at(room, at({0.5, 0.0, 0.5}, {0, -1, 0})) == 0.0);
  CHECK(direct_at(room, at({0.5, 0.0, 0.5}, {0, 1, 0}, 0.0)) == 0.0);
  CHECK(direct_at(room, at({0.5, 0.1, 0.5}, {1, 0, 0}, 80.0)) == 0.0);
  CHECK(direct_at(room, at({0.5, 0.0, 0.5}, {0, 1, 0}, 10.0)) == Approx(1.0 / (4.0 * pi * 0.81)).epsilon(1e-12));
  // A spot whose beam does not include the receiver.
  Room spot = unit_cube(0.5, {"spot", 1.0, SpotEmitter{{0.5, 0.9, 0.5}, {0, -1, 0}, 0.1, 0.2}});
  CHECK(direct_at(spot, at({0.1, 0.0, 0.5}, {0, 1, 0})) == 0.0);
  CHECK(direct_at(spot, at({0.5, 0.0, 0.5}, {0, 1, 0})) > 0.0);
}

TEST_CASE("receivers: one that lies on an emitter is refused by its name") {
  Room room = unit_cube(0.5, isotropic({0.5, 0.5, 0.5}));
  room.receivers = {at({0.1, 0.5, 0.5}, {0, 1, 0}), {"on the lamp", {0.5, 0.5, 0.5}, {0, 1, 0}, 90.0, 1.0}};
  CHECK_THROWS_WITH(simulate(room, backward(Estimator::collision, Engine::automatic, 100, 1)),
                    ContainsSubstring("'on the lamp'") && ContainsSubstring("'isotropic'"));
  room.emitters = {surface_emitter(1, 1.0)};
  room.receivers = {{"under the ceiling", {0.5, 1.0, 0.5}, {0, 1, 0}, 90.0, 1.0}};
  CHECK_THROWS_WITH(simulate(room, backward(Estimator::collision, Engine::automatic, 100, 1)),
                    ContainsSubstring("'under the ceiling'"));
  room.receivers.clear();
  CHECK_THROWS_WITH(simulate(room, backward(Estimator::collision, Engine::automatic, 100, 1)),
                    ContainsSubstring("no receiver"));
}

TEST_CASE("receivers: a small Lambert emitter and a small receiver are reciprocal") {
  // H = E·A/Φ of a Lambert point emitter and a receiver of the same area and position is the same if they are
  // exchanged.
  const glm::dvec3 a(0.2, 0.3, 0.4);
  const glm::dvec3 b(0.8, 0.6, 0.7);
  const glm::dvec3 n_a = glm::normalize(glm::dvec3(1.0, 0.2, 0.3));
  const glm::dvec3 n_b = glm::normalize(glm::dvec3(-0.5, -1.0, 0.1));
  const auto gain = [](const glm::dvec3& from, const glm::dvec3& n_from, const glm::dvec3& to, const glm::dvec3& n_to,
                       std::uint64_t seed) {
    Room room = make_cuboid({1.0, 0.9, 1.2}, {0.2, 0.8, 0.5, 0.7, 0.3, 0.6});
    room.emitters.push_back(lambert(from, n_from, 1.0));
    room.receivers = {at(to, n_to, 90.0, 1e-4)};
    const Result result = simulate(room, backward(Estimator::collision, Engine::automatic, 4e5, seed));
    const ReceiverResult& one = result.receiver_results[0];
    CHECK(one.gain == Approx(one.irradiance * 1e-4).epsilon(1e-12));
    return Compared{one.irradiance, one.standard_error, 0.0, 0.0};
  };
  const Compared there = gain(a, n_a, b, n_b, 71);
  const Compared back = gain(b, n_b, a, n_a, 72);
  const Judgement verdict = compare({{there.value, there.standard_error, back.value, back.standard_error}});
  check("reciprocity", verdict);
  CHECK(verdict.smallest_bias < 0.02);
}

TEST_CASE("receivers: many emitters, one of which is sampled per impact, add up") {
  Room room = make_cuboid({3.0, 2.5, 4.0}, uniform_reflectance(0.6));
  for (int k = 0; k < 9; ++k)
    room.emitters.push_back(isotropic({0.3 + 0.25 * k, 2.2, 0.4 + 0.35 * k}, k == 4 ? 0.0 : 1.0 + k));
  room.emitters.push_back(surface_emitter(1, 20.0));
  room.receivers = {at({1.5, 0.8, 2.0}, {0, 1, 0}), at({0.0, 1.0, 1.0}, {1, 0, 0})};
  const Result all = simulate(room, backward(Estimator::collision, Engine::automatic, 4e5, 81));
  std::vector<Compared> figures(2);
  for (const Emitter& emitter : room.emitters) {
    Room one = room;
    one.emitters = {emitter};
    if (emitter.power == 0.0) continue;
    const Result result = simulate(one, backward(Estimator::collision, Engine::automatic, 1e5, 82));
    for (std::size_t k = 0; k < 2; ++k) {
      figures[k].expected += result.receiver_results[k].irradiance;
      figures[k].expected_error = std::hypot(figures[k].expected_error, result.receiver_results[k].standard_error);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    figures[k].value = all.receiver_results[k].irradiance;
    figures[k].standard_error = all.receiver_results[k].standard_error;
  }
  check("ten emitters", compare(figures));
}

TEST_CASE("receivers: the same figures for any number of threads") {
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  room.receivers.clear();
  for (int k = 0; k < 40; ++k) room.receivers.push_back(at({0.5 + 0.1 * k, 0.9, 1.0 + 0.05 * k}, {0, 1, 0}));
  std::vector<ReceiverResult> first;
  for (const unsigned threads : {1U, 2U, 7U}) {
    Settings settings = backward(Estimator::collision, Engine::automatic, 40000, 91);
    settings.threads = threads;
    const Result result = simulate(room, settings);
    CHECK(result.receiver_walk.shadow_rays > 0);
    if (first.empty()) first = result.receiver_results;
    for (std::size_t k = 0; k < first.size(); ++k) {
      REQUIRE(result.receiver_results[k].irradiance == first[k].irradiance);
      REQUIRE(result.receiver_results[k].standard_error == first[k].standard_error);
    }
  }
}

TEST_CASE("receivers: backward at tile centres agrees with forward on the tiles") {
  struct Case {
    const char* scene;
    const char* surface;
    double tile;
    double photons;
  };
  for (const Case& one : {Case{"l_room.gltf", "floor", 0.1, 4e6}, Case{"living_room.glb", "floor", 0.1, 8e6}}) {
    Room room = read_gltf(std::string(LICHTMC_SCENES) + "/" + one.scene);
    room.receivers.clear();
    // Point emitters a few centimetres from their lampshades give backward walks rare large scores, whose errors cannot
    // be estimated from few samples: they are left out.
    std::erase_if(room.emitters, [](const Emitter& e) { return e.name == "floor_lamp" || e.name == "reading_lamp"; });
    const Result tiles =
        simulate(room, settings_of(Estimator::collision, Engine::automatic, one.photons, 95, one.tile));
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < tiles.tiles.size(); ++i) {
      const Tile& tile = tiles.tiling.tiles[i];
      if (tiles.tiling.maps[tile.map].name != one.surface || tiles.tiles[i].hits < 100) continue;
      numbers.push_back(i);
      room.receivers.push_back(at(tile.point, {0, 1, 0}));
    }
    REQUIRE(numbers.size() > 50);
    for (const Estimator estimator : estimators) {
      const Result points =
          simulate(room, backward(estimator, Engine::automatic, 400.0 * static_cast<double>(numbers.size()), 96));
      // Under furniture the value at a tile's centre is not its mean: the median of |z| represents most tiles.
      std::vector<double> z;
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        const ReceiverResult& point = points.receiver_results[k];
        const TileResult& tile = tiles.tiles[numbers[k]];
        z.push_back(std::abs(point.irradiance - tile.irradiance) /
                    std::hypot(point.standard_error, tile.standard_error));
      }
      std::nth_element(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end());
      const double median = z[z.size() / 2];
      WARN(one.scene << ", " << to_string(estimator) << ": " << z.size() << " tiles, median |z| " << median
                     << " (normal: 0.67)");
      // The median of n values |z| has a spread of 1.5·0.67/√n.
      CHECK(std::abs(median - 0.674) < 5.0 * 1.0 / std::sqrt(static_cast<double>(z.size())));
    }
  }
}
