// Meshes at the limits of validity.
#include <cmath>
#include <limits>
#include <string_view>

#include <glm/geometric.hpp>

#include "extremes.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double photons = 1e6;

Result walk_in(const Room& room, double tile_edge_m = 0.1, std::uint64_t seed = 1) {
  return simulate(room, settings_of(Estimator::collision, Engine::embree, photons, seed, tile_edge_m));
}

// Removes a surface's triangles and UVs.
Surface& cleared(Room& room, std::string_view name) {
  Surface& surface = room.surfaces[surface_number(room, name)];
  surface.positions.clear();
  surface.uvs.clear();
  surface.triangles.clear();
  return surface;
}

// UVs of a floor [0, 1] × [0, 1] as a file may give them.
void lay_flat(Surface& floor) {
  floor.uvs.clear();
  for (const glm::dvec3& p : floor.positions) floor.uvs.emplace_back(p.x, p.z);
}

void check_same_tile_powers(const Result& a, const Result& b) {
  REQUIRE(a.tiles.size() == b.tiles.size());
  for (std::size_t k = 0; k < a.tiles.size(); ++k) REQUIRE(a.tiles[k].power == b.tiles[k].power);
}

// The mean irradiances of all walls of two rooms, whose tiles may differ.
std::vector<Compared> walls(const Result& a, const Result& b) {
  std::vector<Compared> figures;
  for (const SurfaceResult& wall : b.surfaces) {
    const SurfaceResult& other = surface_named(a, wall.name);
    figures.push_back({other.mean_irradiance, other.standard_error, wall.mean_irradiance, wall.standard_error});
  }
  return figures;
}

// Two squares of 1 m, `gap` apart, that face each other across the origin; each emits 1 − ρ on its inside.
Room plates(double gap, double reflectance) {
  Room room;
  room.source = "plates";
  room.quantity = Quantity::radiometric;
  for (const double side : {-1.0, 1.0}) {
    Surface plate;
    plate.name = side < 0.0 ? "lower" : "upper";
    plate.reflectance = reflectance;
    plate.sides = Sides::both;
    const glm::dvec3 corner(-0.5, 0.5 * side * gap, -0.5);
    const glm::dvec3 x(1.0, 0.0, 0.0);
    const glm::dvec3 z(0.0, 0.0, 1.0);
    // The fronts face each other.
    add_quad(plate, corner, side < 0.0 ? z : x, side < 0.0 ? x : z);
    room.surfaces.push_back(plate);
  }
  return room;
}

// From a square of 1 m to another, opposite it at a distance c (Howell, A Catalog of Radiation Heat Transfer
// Configuration Factors, C-11 with sides of 1).
double opposite_squares(double c) {
  const double a = 1.0 / c;
  const double s = 1.0 + a * a;
  return 2.0 / (std::numbers::pi * a * a) *
         (0.5 * std::log(s * s / (1.0 + 2.0 * a * a)) + 2.0 * a * std::sqrt(s) * std::atan(a / std::sqrt(s)) -
          2.0 * a * std::atan(a));
}

}  // namespace

TEST_CASE("extreme: a floor of slivers, a thousand strips down to a billionth of a metre") {
  const Room plain = unit_cube(0.6, paper_emitter());
  Room room = plain;
  Surface& floor = cleared(room, "floor");
  // 997 strips of widths that fall by the same factor from 0.015 m to 10⁻⁹ m, and three that fill the rest.
  constexpr int strips = 997;
  std::vector<double> edges{0.0};
  for (int k = 0; k < strips; ++k)
    edges.push_back(edges.back() + 1e-9 * std::pow(0.015 / 1e-9, static_cast<double>(k) / (strips - 1)));
  const double rest = 1.0 - edges.back();
  REQUIRE(rest > 0.0);
  for (const double share : {0.3, 0.7}) edges.push_back(1.0 - rest * (1.0 - share));
  edges.push_back(1.0);
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    add_quad(floor, {edges[k], 0.0, 0.0}, {0.0, 0.0, 1.0}, {edges[k + 1] - edges[k], 0.0, 0.0});
  lay_flat(floor);
  const Result slivers = walk_in(room, 0.1, 2);
  const Result whole = walk_in(plain);
  CHECK(slivers.lost_histories == 0);
  CHECK(slivers.balance.escaped == 0.0);
  check_shares(against(slivers, whole));
  check_shares({{slivers.incident, slivers.incident_standard_error, 2.5, 0.0}});
}

TEST_CASE("extreme: a floor with corners on the middle of walls' edges (T-junctions) leaks nothing") {
  const Room plain = unit_cube(0.6, paper_emitter());
  for (const int n : {3, 7, 100}) {
    Room room = plain;
    Surface& floor = cleared(room, "floor");
    const Surface fine = make_floor(1.0, 1.0, n);
    floor.positions = fine.positions;
    floor.triangles = fine.triangles;
    lay_flat(floor);
    const Result split = walk_in(room, 0.1, 2);
    CHECK(split.balance.escaped == 0.0);
    CHECK(split.lost_histories == 0);
    check_shares(walls(split, walk_in(plain)));
  }
}

TEST_CASE("extreme: a duplicate triangle does not count light twice") {
  const Room plain = unit_cube(0.6, paper_emitter());
  for (const bool turned : {false, true}) {
    Room room = plain;
    Surface& floor = room.surfaces[surface_number(room, "floor")];
    const glm::uvec3 first = floor.triangles[0];
    floor.triangles.push_back(turned ? glm::uvec3(first.x, first.z, first.y) : first);
    const Result twice = walk_in(room, 0.1, 2);
    CHECK(twice.lost_histories == 0);
    CHECK(twice.balance.escaped == 0.0);
    const Result once = walk_in(plain);
    check_shares({{power_on(twice, "floor"), std::hypot(surface_named(twice, "floor").standard_error * 1.5, 0.0),
                   power_on(once, "floor"), surface_named(once, "floor").standard_error}});
    check_shares({{power_on(twice, "ceiling"), surface_named(twice, "ceiling").standard_error,
                   power_on(once, "ceiling"), surface_named(once, "ceiling").standard_error}});
  }
}

TEST_CASE("extreme: a second floor at the position of the first one, turned over, with another reflectance") {
  // Photons hit the one that looks to them.
  Room room = unit_cube(0.6, paper_emitter());
  Surface second = room.surfaces[surface_number(room, "floor")];
  second.name = "second";
  second.reflectance = 0.2;
  for (glm::uvec3& triangle : second.triangles) std::swap(triangle.y, triangle.z);
  room.surfaces.push_back(second);
  const Result result = walk_in(room);
  check_all_finite(result);
  CHECK(result.balance.escaped == 0.0);
  CHECK(result.balance.absorbed == Approx(1.0).epsilon(1e-12));
  CHECK(power_on(result, "second") == 0.0);
  check_shares({{result.incident, result.incident_standard_error, 2.5, 0.0}});
  bool told = false;
  for (const Finding& finding : inspect(room).findings) told = told || finding.text.find("second") != std::string::npos;
  CHECK(told);
}

TEST_CASE("extreme: triangles without area change no bit") {
  const Room plain = unit_cube(0.6, paper_emitter());
  Room room = plain;
  Surface& floor = room.surfaces[surface_number(room, "floor")];
  const auto first = static_cast<std::uint32_t>(floor.positions.size());
  for (const double x : {0.25, 0.5, 0.75}) {
    floor.positions.emplace_back(x, 0.0, 0.5);
    if (!floor.uvs.empty()) floor.uvs.push_back(floor.uvs[0]);
  }
  floor.triangles.emplace_back(first, first, first);
  floor.triangles.emplace_back(first, first + 1, first + 2);
  floor.triangles.emplace_back(0, first, 0);
  const Result with = walk_in(room);
  check_all_finite(with);
  check_same_tile_powers(with, walk_in(plain));
}

TEST_CASE("extreme: a triangle of 10⁻³⁰ m² receives no light and all its figures are finite") {
  Room room = unit_cube(0.6, paper_emitter());
  Surface speck;
  speck.name = "speck";
  add_triangle(speck, {0.25, 0.5, 0.25}, {0.25, 0.5, 0.25 + 1.4e-15}, {0.25 + 1.4e-15, 0.5, 0.25});
  room.surfaces.push_back(speck);
  const Result result = walk_in(room);
  check_all_finite(result);
  CHECK(power_on(result, "speck") == 0.0);
  CHECK(surface_named(result, "speck").mean_irradiance == 0.0);
}

TEST_CASE("extreme: a wall against the back of another, without a gap") {
  // Two cubes side by side, each with a wall of its own where they touch.
  Room room = unit_cube(0.6, paper_emitter());
  for (Surface surface : unit_cube(0.6, paper_emitter()).surfaces) {
    surface.name = "next_" + surface.name;
    for (glm::dvec3& position : surface.positions) position.x += 1.0;
    room.surfaces.push_back(surface);
  }
  const Result result = walk_in(room);
  check_all_finite(result);
  CHECK(result.balance.escaped == 0.0);
  for (const SurfaceResult& surface : result.surfaces) {
    // Of the two walls in one plane, the one that looks to the light counts.
    if (surface.name.starts_with("next_")) CHECK(surface.power == 0.0);
  }
  check_shares({{result.incident, result.incident_standard_error, 2.5, 0.0}});
}

TEST_CASE("extreme: plates a billionth of a metre apart keep their light") {
  constexpr double rho = 0.5;
  Room room = plates(1e-9, rho);
  for (std::size_t k = 0; k < 2; ++k) room.emitters.push_back(surface_emitter(k, 1.0 - rho));
  const Result result = walk_in(room, 0.25);
  check_all_finite(result);
  CHECK(power_on(result, "lower.back") == 0.0);
  CHECK(power_on(result, "upper.back") == 0.0);
  // A photon escapes at the edges once in 10⁹ flights.
  check_shares({{result.incident, result.incident_standard_error, 2.0, 0.0}});
}

TEST_CASE("extreme: plates 1 mm and 1 µm apart exchange light by their form factor") {
  // Twice the gap, minus the part of the corners.
  CHECK(1.0 - opposite_squares(1e-3) == Approx(0.00199436809).epsilon(1e-8));
  for (const double gap : {1e-3, 1e-4, 1e-5, 1e-6}) {
    Room room = plates(gap, 0.0);
    room.emitters.push_back(surface_emitter(0, 1.0));
    const Result result = walk_in(room, 0.25);
    const double escapes = 1.0 - opposite_squares(gap);
    const double expected = escapes * photons;
    const auto escaped = std::round(result.balance.escaped * photons);
    INFO(gap << " m: " << escaped << " photons, expected " << expected);
    CHECK(result.balance.escaped + power_on(result, "upper") == Approx(1.0).epsilon(1e-15));
    if (expected > 50.0) {
      check_shares({share(result.balance.escaped, escapes, static_cast<std::uint64_t>(photons))});
    } else {
      // Poisson's law: of 20 more than 48 in 10⁷ runs once, of 2 more than 13; and of 20 less than 3.
      CHECK(escaped <= (expected > 10.0 ? 48.0 : 13.0));
      if (expected > 10.0) CHECK(escaped >= 3.0);
    }
  }
}

TEST_CASE("extreme: a box flush on the floor") {
  Room room = unit_cube(0.5, isotropic({0.5, 0.8, 0.5}));
  Surface box = make_box({0.4, 0.3, 0.4});
  box.reflectance = 0.5;
  for (glm::dvec3& position : box.positions) position += glm::dvec3(0.3, 0.0, 0.3);
  room.surfaces.push_back(box);
  const Result result = walk_in(room);
  check_all_finite(result);
  CHECK(result.balance.escaped == 0.0);
  CHECK(result.balance.absorbed == Approx(1.0).epsilon(1e-12));
  // No light arrives under it: on the floor tiles that it covers, and on its own underside.
  std::size_t covered = 0;
  for (std::size_t k = 0; k < result.tiles.size(); ++k) {
    const Tile& tile = result.tiling.tiles[k];
    const bool of_floor = result.tiling.maps[tile.map].name == "floor";
    if (!of_floor || std::abs(tile.point.x - 0.5) > 0.16 || std::abs(tile.point.z - 0.5) > 0.16) continue;
    ++covered;
    CHECK(result.tiles[k].power == 0.0);
  }
  CHECK(covered == 16);
}

TEST_CASE("extreme: corners that differ by one float step, or in the sign of a zero, leave no gap") {
  Room room = unit_cube(0.6, paper_emitter());
  std::uint32_t bits = 1;
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& position : surface.positions) {
      for (int k = 0; k < 3; ++k) {
        bits = bits * 1664525U + 1013904223U;
        const float to = (bits >> 31U) != 0U ? 2.0F : -2.0F;
        // One step of the floats of a file, up or down; for zeros the sign.
        position[k] = position[k] == 0.0 ? std::copysign(0.0, double{to})
                                         : double{std::nextafter(static_cast<float>(position[k]), to)};
      }
    }
  }
  const Result result = walk_in(room, 0.1, 2);
  CHECK(result.lost_histories == 0);
  CHECK(result.balance.escaped == 0.0);
  check_shares(walls(result, walk_in(unit_cube(0.6, paper_emitter()))));
}
