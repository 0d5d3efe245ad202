// The forward walk with a record of every flight.
#pragma once

#include <cstdint>
#include <vector>

#include "lichtmc/paths.hpp"
#include "lichtmc/settings.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// Histories first … first + n − 1 (1 ≤ n ≤ batch_histories), each ended after at most `most_flights` (≥ 1) flights. The
// room is that of the scene.
std::vector<PhotonPath> walk_paths(const Room& room, const Scene& scene, const Settings& settings,
                                   std::uint32_t most_flights, std::uint64_t first, std::uint32_t n);

}  // namespace lichtmc
