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

// Settings for tests of the forward walk: results depend on the seed, not on threads and reports.
Settings settings_of(Estimator estimator, Engine engine, double photons, std::uint64_t seed, double tile_edge_m = 0.1);

// The number of a room's surface.
std::size_t surface_number(const Room& room, std::string_view name);

const SurfaceResult& surface_named(const Result& result, std::string_view name);

// Irradiance of the tiles of one tile map compared with an expectation for each tile. Hits follow Poisson's law, which
// is not close enough to the normal law if few are expected: tiles with fewer than 50 expected hits are pooled into
// figures with at least 50.
std::vector<Compared> against(const Result& result, const std::string& tile_map,
                              const std::function<double(const Tile&)>& expected);

// Comparison of two results with the same tiles.
std::vector<Compared> against(const Result& a, const Result& b);

// Mean of a function over a tile of a wall that is parallel to two axes, by n × n midpoints. half_u and half_v are the
// vectors from the tile's centre to the midpoints of two of its sides.
double tile_mean(const glm::dvec3& centre, const glm::dvec3& half_u, const glm::dvec3& half_v, int n,
                 const std::function<double(const glm::dvec3&)>& f);

// A table of numbers, one row per line, without lines that begin with #.
std::vector<std::vector<double>> read_table(const std::string& file);

}  // namespace lichtmc::test
