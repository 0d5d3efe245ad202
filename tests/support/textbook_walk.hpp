// The textbook walk: one photon at a time, double precision, in an empty cuboid.
//
// H. Schulze, Lichtausbreitung in Räumen: Skizzen zur Monte-Carlo-Simulation, 2021, eq. 1-17, variant 2 (collision). It
// is plain on purpose: tests and the benchmark compare the engine with it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lichtmc::test {

struct TextbookRoom {
  std::array<double, 3> size{1.0, 1.0, 1.0};  // m, from the origin
  double reflectance = 0.6;
  std::array<double, 3> emitter{0.5, 0.5, 0.5};
  double exponent = 5.0;  // of the generalized Lambert emitter, axis −y
  int cells = 10;         // tiles along each edge of a wall
};

// Hits per tile for a number of photons: 6 walls (x = 0, x = X, y = 0, …) of cells × cells tiles each. Adds the
// impacts.
std::vector<std::uint64_t> textbook_walk(const TextbookRoom& room, std::uint64_t photons, std::uint64_t seed,
                                         std::uint64_t& impacts);

}  // namespace lichtmc::test
