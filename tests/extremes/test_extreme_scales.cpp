// Rooms of any size, position and rotation.
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "extremes.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double photons = 2e5;

// A room rotated, scaled and moved, with its emitters.
Room moved(Room room, const glm::dmat3& turn, double factor, const glm::dvec3& offset) {
  const auto to = [&](const glm::dvec3& point) { return factor * (turn * point) + offset; };
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& position : surface.positions) position = to(position);
  }
  for (Emitter& emitter : room.emitters) {
    std::visit(
        [&](auto& shape) {
          if constexpr (requires { shape.position; }) shape.position = to(shape.position);
          if constexpr (requires { shape.axis; }) shape.axis = turn * shape.axis;
        },
        emitter.shape);
  }
  return room;
}

Room scaled(const Room& room, double factor) {
  return moved(room, glm::dmat3(1.0), factor, glm::dvec3(0.0));
}

Result walk_in(const Room& room, Engine engine, double tile_edge_m, std::uint64_t seed = 1) {
  const Result result = simulate(room, settings_of(Estimator::collision, engine, photons, seed, tile_edge_m));
  check_all_finite(result);
  return result;
}

// Powers of the tiles, whose sizes may differ.
std::vector<Compared> powers(const Result& a, const Result& b) {
  REQUIRE(a.tiles.size() == b.tiles.size());
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < a.tiles.size(); ++k) {
    figures.push_back({a.tiles[k].power, a.tiles[k].standard_error * a.tiling.tiles[k].area_m2, b.tiles[k].power,
                       b.tiles[k].standard_error * b.tiling.tiles[k].area_m2});
  }
  return figures;
}

void check_same_digits(const Result& a, const Result& b, double factor) {
  REQUIRE(a.tiles.size() == b.tiles.size());
  for (std::size_t k = 0; k < a.tiles.size(); ++k) {
    REQUIRE(a.tiles[k].power == b.tiles[k].power);
    REQUIRE(a.tiles[k].irradiance * factor * factor == Approx(b.tiles[k].irradiance).epsilon(1e-14));
  }
}

}  // namespace

TEST_CASE("extreme: scales of powers of two give the same powers bit for bit, others the same powers") {
  const Room cube = unit_cube(0.6, paper_emitter());
  for (const Engine engine : both_engines) {
    const Result one = walk_in(cube, engine, 0.1);
    for (const int power_of_two : {-20, -10, 10, 20, 60}) {
      const double factor = std::ldexp(1.0, power_of_two);
      check_same_digits(walk_in(scaled(cube, factor), engine, 0.1 * factor), one, factor);
    }
    for (const double factor : {1e-6, 1e-3, 1e3, 1e6}) {
      // Another seed: not the same photons, which would agree by rounding only.
      const Result other = walk_in(scaled(cube, factor), engine, 0.1 * factor, 2);
      check_shares(powers(other, one));
    }
  }
}

TEST_CASE("extreme: a cube a thousand kilometres from the origin") {
  const Room cube = unit_cube(0.6, paper_emitter());
  const glm::dvec3 offset(1e6, -1e6, 1e6);
  const Result here = walk_in(cube, Engine::embree, 0.1);
  // Corners and emitter are exact doubles there: no bit changes.
  const Room far = moved(cube, glm::dmat3(1.0), 1.0, offset);
  check_same_digits(walk_in(far, Engine::automatic, 0.1), here, 1.0);
  // The floats of files would be rounded to 6 cm: the walls would not be perpendicular.
  CHECK_FALSE(refusal([&] { walk_in(far, Engine::cuboid, 0.1); }).empty());
  // A size of a millimetre, in double, is rounded to 10⁻⁷ of its value.
  const Room small = moved(cube, glm::dmat3(1.0), 1e-3, offset);
  check_shares(powers(walk_in(small, Engine::automatic, 1e-4, 2), here));
}

TEST_CASE("extreme: no light escapes from a cube of 1 m at the centre of one of 1000 km") {
  Room room = unit_cube(0.6, paper_emitter());
  for (Surface surface : make_cuboid({1e6, 1e6, 1e6}, uniform_reflectance(0.0)).surfaces) {
    surface.name = "far_" + surface.name;
    for (glm::dvec3& position : surface.positions) position -= glm::dvec3(0.5e6 - 0.5);
    room.surfaces.push_back(surface);
  }
  const Result result = walk_in(room, Engine::embree, 1e6);
  for (const SurfaceResult& surface : result.surfaces) {
    if (surface.name.starts_with("far_")) CHECK(surface.power == 0.0);
  }
  const Result alone = walk_in(unit_cube(0.6, paper_emitter()), Engine::embree, 1e6, 2);
  std::vector<Compared> figures;
  for (const SurfaceResult& surface : alone.surfaces) {
    const SurfaceResult& inner = surface_named(result, surface.name);
    figures.push_back({inner.power, inner.standard_error, surface.power, surface.standard_error});
  }
  check_shares(figures);
}

TEST_CASE("extreme: a room of 1000 km × 1000 km that is 1 m high") {
  Room room = make_cuboid({1e6, 1.0, 1e6}, uniform_reflectance(0.0));
  room.emitters.push_back(lambert({5e5, 0.5, 5e5}, {0, -1, 0}, 1.0));
  for (const Engine engine : both_engines) {
    const Result result = walk_in(room, engine, 1e5);
    CHECK(power_on(result, "ceiling") == 0.0);
    // Walls are a million times farther than the floor: they receive 10⁻¹² of the light.
    CHECK(power_on(result, "floor") == 1.0);
  }
}

TEST_CASE("extreme: a room of 1 m × 1 m between walls a micrometre apart") {
  constexpr double rho = 0.6;
  constexpr double gap = 1e-6;
  for (const Engine engine : both_engines) {
    Room room = make_cuboid({gap, 1.0, 1.0}, uniform_reflectance(rho));
    room.emitters.push_back(isotropic({0.5 * gap, 0.5, 0.5}));
    const Result lit = walk_in(room, engine, 0.25);
    check_shares({{lit.incident, lit.incident_standard_error, 1.0 / (1.0 - rho), 0.0}});
    // From one wall to the other: all light except 2·10⁻⁶, which the four slits receive.
    room = make_cuboid({gap, 1.0, 1.0}, uniform_reflectance(0.0));
    room.emitters.push_back(surface_emitter(surface_number(room, "wall_x0"), 1.0));
    const Result across = walk_in(room, engine, 0.25);
    CHECK(power_on(across, "wall_x0") == 0.0);
    // 2·10⁵ · 2·10⁻⁶: 0.4 photons in the slits; more than 8 have a probability below 10⁻⁹.
    CHECK(power_on(across, "wall_x1") >= 1.0 - 8.0 / photons);
    CHECK(across.incident == 1.0);
  }
}

TEST_CASE("extreme: a room of 10⁻⁴⁰ m is simulated like any other or refused") {
  const Room cube = unit_cube(0.6, paper_emitter());
  const double factor = std::ldexp(1.0, -133);  // 9.2·10⁻⁴¹ m: subnormal in float, with fewer digits; normal in double
  for (const Engine engine : both_engines) {
    const Result one = walk_in(cube, engine, 0.1);
    const Result tiny = walk_in(scaled(cube, factor), engine, 0.1 * factor);
    for (std::size_t k = 0; k < one.tiles.size(); ++k) REQUIRE(tiny.tiles[k].power == one.tiles[k].power);
  }
  // Areas below the smallest double.
  const std::string message = refusal([&] { walk_in(scaled(cube, 1e-170), Engine::embree, 1e-171); });
  INFO(message);
  CHECK_FALSE(message.empty());
}

TEST_CASE("extreme: a rotated cube receives the same light; normals near (0, 0, −1)") {
  const Room cube = unit_cube(0.6, paper_emitter());
  std::vector<glm::dmat3> turns;
  turns.emplace_back(glm::rotate(glm::dmat4(1.0), 1.234, glm::normalize(glm::dvec3(1.0, -2.0, 0.7))));
  // Normals (0, 0, −1), and normals that differ from it by the smallest possible angles.
  turns.emplace_back(glm::rotate(glm::dmat4(1.0), std::numbers::pi, glm::dvec3(1.0, 0.0, 0.0)));
  turns.emplace_back(glm::rotate(glm::dmat4(1.0), 1e-8, glm::dvec3(1.0, 0.0, 0.0)));
  turns.emplace_back(glm::rotate(glm::dmat4(1.0), std::numeric_limits<double>::epsilon(), glm::dvec3(0.0, 1.0, 0.0)));
  for (const Engine engine : both_engines) {
    const Result straight = walk_in(cube, engine, 0.1);
    for (const glm::dmat3& turn : turns) {
      const Result turned = walk_in(moved(cube, turn, 1.0, glm::dvec3(0.0)), engine, 0.1, 2);
      check_shares(powers(turned, straight));
    }
  }
}
