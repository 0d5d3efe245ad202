// The photons of a wave that survive their surfaces, determined several at a time, and the compaction of the wave.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "chance/moments.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

struct Survivors {
  std::size_t count = 0;
  std::array<std::uint8_t, batch_histories / 8> sets;       // bit i % 8 of sets[i / 8]: photon i survives
  std::array<std::uint32_t, batch_histories + 8> ended_at;  // list_ended(): positions of the others, in order
};

// Those whose random number (see draw_many()), in units of 2⁻⁵³, is below survival_of their surface.
void choose_survivors(const Wave& wave, const std::int64_t* survival_of, Survivors& survivors);

// Those marked with 1 (others: 0) in an array of whole_lanes() elements of the wave.
void choose_marked(const std::uint8_t* marks, std::size_t n, Survivors& survivors);

void list_ended(std::size_t n, Survivors& survivors);

// Moves the survivors, in their order, to the beginning of the wave, with their data for the next flight.
void compact_wave(Wave& wave, const Survivors& survivors);

}  // namespace lichtmc
