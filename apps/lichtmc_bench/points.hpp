// The time that receivers take to an error of 1 %, by the walks of a run against the plain backward walk.
#pragma once

#include <cstdint>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc::bench {

// Time of the plain walk divided by that of the run, for the same error: root mean square of the relative errors of all
// receivers, and error of the median receiver. Receivers inside bodies do not count.
struct TimeRatio {
  double rms = 0.0;
  double median = 0.0;
};

// histories: of the run, for all receivers together; plain_walks: of the plain walk, from each. One thread.
TimeRatio time_of_points(const Room& room, Engine engine, std::uint64_t histories, std::uint64_t plain_walks);

// A furnished room with one isotropic lamp and 1044 receivers at the height of desks.
Room furnished_room();
// An empty room of 5 × 4 × 3 m (height 3 m) with 20 receivers, 0.85 m above the floor.
Room empty_room();

}  // namespace lichtmc::bench
