// A photon's random numbers: they depend on (seed, history, flight, purpose) alone, never on thread, lane or order.
#pragma once

#include <array>
#include <cstdint>

#include "chance/philox.hpp"
#include "lichtmc/walk_direction.hpp"

namespace lichtmc {

// The purpose of a draw of four words. Each purpose has its own words: a new purpose does not change the others.
enum class Purpose : std::uint32_t {
  flight = 0,    // words 0, 1: direction of the next flight; words 2, 3: whether the photon survives
  emission = 1,  // words 0, 1: direction; words 2, 3: which emitter
  place = 2,     // words 0, 1: which triangle of a surface emitter; words 2, 3: where on it
  light = 3,     // words 0, 1: which emitter is sampled for direct light; words 2, 3: unused
  on_light = 4,  // as place: point on the surface emitter that is sampled for direct light
  // Direct light that is computed outside the walks:
  direct_point = 5,   // words 0 to 2: point on a surface emitter
  direct_flight = 6,  // words 0, 1: direction of a flight that may hit one
  direct_place = 7,   // words 0, 1: where on a tile
  // Random shifts of quasi-random points (sobol.hpp); the "history" is the number of the set:
  shift = 8,            // of emission, words as there
  place_shift = 9,      // of place, words as there
  receivers = 10,       // word 0: which receivers an impact serves, of those that it probably does not reach
  cell = 11,            // words 0, 1: where in the cells of receivers an impact contributes
  direct_cell = 12,     // words 0, 1: where in a cell direct light is computed
  direct_opening = 13,  // words 0, 1: point of a luminous opening for direct light that is computed outside the walks
  bootstrap = 14,       // word 0: by which the figures of areas are varied (run/area_figures.hpp)
};

class Stream {
 public:
  explicit Stream(std::uint64_t seed, WalkDirection direction = WalkDirection::forward)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        direction_(static_cast<std::uint32_t>(direction) << 16) {}

  Words draw(std::uint64_t history, std::uint32_t flight, Purpose purpose) const {
    return philox4x32_10(
        {static_cast<std::uint32_t>(history), static_cast<std::uint32_t>(history >> 32), flight, word_of(purpose)},
        key_);
  }

  // The inputs of Philox in draw() besides history and flight.
  const std::array<std::uint32_t, 2>& key() const { return key_; }
  std::uint32_t word_of(Purpose purpose) const { return static_cast<std::uint32_t>(purpose) | direction_; }

 private:
  std::array<std::uint32_t, 2> key_;
  std::uint32_t direction_;
};

// Uniform in the open interval (0, 1), in steps of 2⁻³²: never 0, so that its logarithm is finite, and never 1.
inline double unit_open(std::uint32_t word) {
  return (word + 0.5) * 0x1p-32;
}

// Uniform in [0, 1) in steps of 2⁻⁵³: `unit_fine(…) < p` is true with probability p to the last digit of p, always
// for p = 1 and never for p = 0.
inline double unit_fine(std::uint32_t high, std::uint32_t low) {
  return high * 0x1p-32 + (low >> 11) * 0x1p-53;
}

}  // namespace lichtmc
