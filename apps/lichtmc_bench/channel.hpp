// What impulse responses cost, and the time to a given error of their bins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc::bench {

// Time of a run with impulse responses (2000 bins of 0.2 ns) divided by that of the same run without, of every turn.
struct ChannelCost {
  std::vector<double> walk;   // of the walks: without direct light
  std::vector<double> whole;  // of the whole simulation
};

// scenes/living_room.glb with its lamps and this number of receivers (up to 1000), Embree, one thread, estimator
// weight. The walk is chosen by its pilot; both runs must have the same. histories: of all receivers together.
ChannelCost cost_of_channels(std::size_t receivers, std::uint64_t histories, int turns);

// Wall-clock time, s, in which configuration A of Barry et al. 1993 reaches a relative error of 1 % in bins of 1 ns:
// root mean square of those from 15 ns, where the first reflected light arrives, to 60 ns. One thread.
double seconds_to_one_percent_of_bins(std::uint64_t histories);

}  // namespace lichtmc::bench
