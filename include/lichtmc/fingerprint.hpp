// Identification of a room, independent of its file.
#pragma once

#include <array>
#include <cstdint>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Two rooms with the same fingerprint give the same figures: a hash (XXH3, 128 bits) of surfaces, reflectances,
// emitters and receivers as modelled, not of the file.
using Fingerprint = std::array<std::uint64_t, 2>;
Fingerprint fingerprint(const Room& room);

}  // namespace lichtmc
