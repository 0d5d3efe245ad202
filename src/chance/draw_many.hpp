// Random words for many photons at once: the same words as Stream::draw(), by vector instructions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "chance/stream.hpp"

namespace lichtmc {

// The four words of photon i: 0 in polar[i], 1 in azimuth[i], 2 and 3 in chance[i], word 2 in the upper half, so that
// unit_fine(word 2, word 3) = (chance[i] >> 11) · 2⁻⁵³. All arrays have whole_lanes(n) elements, see base/lanes.hpp.
void draw_many(const Stream& stream, std::size_t n, const std::uint64_t* history, std::uint32_t flight, Purpose purpose,
               std::uint32_t* polar, std::uint32_t* azimuth, std::uint64_t* chance);

}  // namespace lichtmc
