// Which photons of a wave survive their surfaces, found several at a time, and how the wave closes ranks.
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
  std::array<std::uint32_t, batch_histories + 8> ended_at;  // list_ended(): places of the others, in order
};

// Those whose chance (see draw_many()), counted in 2⁻⁵³, is below the survival of the surface that they are on.
void choose_survivors(const Wave& wave, const std::int64_t* survival_of, Survivors& survivors);

// Those marked with 1 in an array that reaches to whole_lanes() of the wave; the others with 0.
void choose_marked(const std::uint8_t* marks, std::size_t n, Survivors& survivors);

void list_ended(std::size_t n, Survivors& survivors);

// The survivors move up, in their order, with what the next flight needs of them.
void compact_wave(Wave& wave, const Survivors& survivors);

}  // namespace lichtmc
