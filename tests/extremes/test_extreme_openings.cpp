// Rooms of few surfaces, rooms with openings, and path lengths in them.
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "chance/moments.hpp"
#include "extremes.hpp"
#include "support/gltf_text.hpp"
#include "support/surfaces.hpp"
#include "walk/scene.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double photons = 1e6;
constexpr auto n = static_cast<std::uint64_t>(photons);

Room room_of(const Surface& surface, const Emitter& emitter) {
  Room room;
  room.source = "test";
  room.quantity = Quantity::radiometric;
  room.surfaces.push_back(surface);
  room.emitters.push_back(emitter);
  return room;
}

Result walk_in(const Room& room, Engine engine = Engine::embree, double tile_edge_m = 0.1) {
  const Result result = simulate(room, settings_of(Estimator::collision, engine, photons, 3, tile_edge_m));
  check_all_finite(result);
  return result;
}

Surface one_triangle(double reflectance) {
  Surface surface;
  surface.name = "triangle";
  surface.reflectance = reflectance;
  add_triangle(surface, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  return surface;
}

}  // namespace

TEST_CASE("extreme: six walls of different reflectance that emit what they absorb, 1 everywhere") {
  const std::vector<double> rho{0.0, 0.2, 0.9, 0.5, 0.99, 0.7};
  Room room = make_cuboid({1, 1, 1}, {rho[0], rho[1], rho[2], rho[3], rho[4], rho[5]});
  room.quantity = Quantity::radiometric;
  for (std::size_t k = 0; k < 6; ++k) room.emitters.push_back(surface_emitter(k, 1.0 - rho[k]));
  for (const Engine engine : both_engines) {
    const Result result = walk_in(room, engine);
    std::vector<Compared> figures;
    for (const TileResult& tile : result.tiles) figures.push_back({tile.irradiance, tile.standard_error, 1.0, 0.0});
    check_shares(figures);
  }
}

TEST_CASE("extreme: a room of one triangle") {
  // Right angle and legs of 1 m, the emitter 1 m above the right angle: Ω = 2 atan(1/(1 + 2√2 + …)), by van Oosterom.
  const double solid_angle = 0.02704336199 * 4.0 * std::numbers::pi;
  const Result result = walk_in(room_of(one_triangle(0.0), isotropic({0, 1, 0})));
  check_shares({share(result.incident, solid_angle / (4.0 * std::numbers::pi), n)});
  CHECK(result.balance.escaped + result.incident == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("extreme: a room without surfaces is refused, a room whose surfaces receive no light is not") {
  Room room;
  room.source = "nothing";
  room.emitters.push_back(isotropic({0, 1, 0}));
  const std::string message = refusal([&] { walk_in(room); });
  INFO(message);
  CHECK(message.find("triangle") != std::string::npos);
  CHECK(message.find("nothing") != std::string::npos);

  const Result missed = walk_in(room_of(one_triangle(0.5), lambert({0, 1, 0}, {0, 1, 0}, 1.0)));
  CHECK(missed.balance.escaped == 1.0);
  CHECK(missed.incident == 0.0);
  CHECK(missed.walk.impacts == 0);
  CHECK_FALSE(missed.warnings.empty());
}

TEST_CASE("extreme: a floor of 2 m × 2 m under the open sky") {
  Surface floor = make_floor(2.0, 2.0);
  floor.reflectance = 0.0;
  const Result result = walk_in(room_of(floor, lambert({1, 1, 1}, {0, -1, 0}, 1.0)));
  check_shares({share(power_on(result, "floor"), 0.554126423980, n)});
  CHECK(result.balance.escaped + result.incident == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("extreme: a cube that lacks one triangle of twelve loses a twelfth of the direct light") {
  Room room = unit_cube(0.0, isotropic({0.5, 0.5, 0.5}));
  room.surfaces[2].triangles.pop_back();
  const Result result = walk_in(room);
  CHECK(result.lost_histories == 0);
  check_shares({share(result.balance.escaped, 1.0 / 12.0, n)});
  CHECK(result.balance.escaped + result.incident == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("extreme: invalid coordinates, normals and indices are named") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto complaint = [](const auto& spoil) {
    Room room = unit_cube(0.5, isotropic({0.5, 0.5, 0.5}));
    room.receivers.push_back({"desk", {0.5, 0.2, 0.5}, {0, 1, 0}, 90.0, 1.0});
    spoil(room);
    return refusal([&] { simulate(room, {}); });
  };
  for (const double value : {nan, infinite, -infinite}) {
    const std::string corner = complaint([&](Room& room) { room.surfaces[1].positions[2].y = value; });
    INFO(corner);
    CHECK(corner.find("position") != std::string::npos);
    CHECK(corner.find(unit_cube(0.5, isotropic({0.5, 0.5, 0.5})).surfaces[1].name) != std::string::npos);
    const std::string normal = complaint([&](Room& room) { room.receivers[0].normal.x = value; });
    INFO(normal);
    CHECK(normal.find("desk") != std::string::npos);
    const std::string message =
        complaint([&](Room& room) { std::get<IsotropicEmitter>(room.emitters[0].shape).position.z = value; });
    INFO(message);
    CHECK(message.find("isotropic") != std::string::npos);
  }
  const std::string index = complaint([](Room& room) { room.surfaces[3].triangles[1].y = 99; });
  INFO(index);
  CHECK(index.find("99") != std::string::npos);
  const std::string area = complaint([](Room& room) { room.receivers[0].area_m2 = -1.0; });
  INFO(area);
  CHECK(area.find("area") != std::string::npos);
}

TEST_CASE("extreme: an emitting triangle without area is refused") {
  Room room = unit_cube(0.5, isotropic({0.5, 0.5, 0.5}));
  Surface line;
  line.name = "line";
  add_triangle(line, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}, {0.8, 0.8, 0.8});
  room.surfaces.push_back(line);
  room.emitters.push_back(surface_emitter(room.surfaces.size() - 1, 1.0));
  const std::string message = refusal([&] { walk_in(room); });
  INFO(message);
  CHECK(message.find("line") != std::string::npos);
}

TEST_CASE(
    "extreme: no flight is shorter than the shortest possible, and from the centre of a sphere all equal the radius") {
  Surface ball = make_sphere(256);
  ball.reflectance = 0.0;
  const Room room = room_of(ball, isotropic({0, 0, 0}));
  const Tiling tiling = make_tiling(room, 0.5);
  const Scene scene(room, tiling, Engine::embree);
  Rays rays(batch_histories);
  TraceCount count;
  const Stream stream(1);
  const double metres = glm::length(scene.tracer->world_vector({1.0, 0.0, 0.0}));
  // 256 bands of flat panels stay within 1 − cos(π/256)² of the sphere; the rest is rounding to float.
  const double nearest = std::pow(std::cos(std::numbers::pi / 256.0), 2) - 1e-6;
  for (std::uint32_t i = 0; i < batch_histories; ++i) scene.launcher->launch(stream, i, rays, i);
  rays.size = batch_histories;
  scene.tracer->trace(rays, scene.misses, count);
  for (std::uint32_t i = 0; i < batch_histories; ++i) {
    REQUIRE(rays.facet[i] != no_facet);
    const double segment = rays.length[i] * metres * glm::length(rays.direction(i));
    REQUIRE(segment <= 1.0 + 1e-6);
    REQUIRE(segment >= nearest);
  }
}

TEST_CASE("extreme: no direct light around the corner of an L") {
  Room room = read_gltf(std::string(LICHTMC_SCENES) + "/l_room.gltf");
  for (Surface& surface : room.surfaces) surface.reflectance = 0.0;
  room.receivers.clear();
  const std::size_t end = surface_number(room, "end_wall_z2");
  REQUIRE(end < room.surfaces.size());
  room.emitters = {surface_emitter(end, 1.0)};
  CHECK(power_on(walk_in(room), "end_wall_x2") == 0.0);
}
