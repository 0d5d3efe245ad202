// Rooms and comparisons that several tests need.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/lichtmc.hpp"
#include "support/statistics.hpp"

namespace lichtmc::test {

// A unit cube with one corner at the origin, the same reflectance everywhere, and one emitter of 1 W.
Room unit_cube(double reflectance, Emitter emitter);

Emitter isotropic(const glm::dvec3& position, double power = 1.0);
Emitter lambert(const glm::dvec3& position, const glm::dvec3& axis, double exponent, double power = 1.0);
Emitter surface_emitter(std::size_t surface, double power, double exponent = 1.0);

// The emitter of the paper's example: generalized Lambert, m = 5, at the cube's centre, downwards, 1 W.
Emitter paper_emitter();

// A room without one of its surfaces; emitters on later surfaces are renumbered.
Room without_surface(Room room, const std::string& name);

// Settings for tests of the forward walk: threads and reports do not matter, the seed does.
Settings settings_of(Estimator estimator, Engine engine, double photons, std::uint64_t seed, double tile_edge_m = 0.1);

// The number of a room's surface.
std::size_t surface_number(const Room& room, std::string_view name);

const SurfaceResult& surface_named(const Result& result, std::string_view name);

// Irradiance of the tiles of one map against an expectation for each tile. Hits follow Poisson's law, which is not near
// enough to a normal one where few are expected: tiles that expect fewer than 50 hits are pooled into figures that
// expect at least that many.
std::vector<Compared> against(const Result& result, const std::string& map,
                              const std::function<double(const Tile&)>& expected);

// Two results with the same tiles against each other.
std::vector<Compared> against(const Result& a, const Result& b);

// Number of a tile's cell edges from the map's grid, for tiles of a wall that is parallel to two axes: mean of a
// function over the tile by n × n midpoints. half_u and half_v are the vectors from the tile's centre to the middle of
// two of its sides.
double tile_mean(const glm::dvec3& centre, const glm::dvec3& half_u, const glm::dvec3& half_v, int n,
                 const std::function<double(const glm::dvec3&)>& f);

// A table of numbers, one row per line, lines with # left out.
std::vector<std::vector<double>> read_table(const std::string& file);

}  // namespace lichtmc::test
