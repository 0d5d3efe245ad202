// The memory that impulse responses take, in bytes.
#pragma once

#include <cstddef>

#include "walk/channel_axes.hpp"

namespace lichtmc {

// Of ChannelSums, for each receiver.
double bytes_of_sums(const ChannelAxes& axes);
// Of ChannelScores, for each receiver and thread.
double bytes_of_scores(const ChannelAxes& axes);
// Receivers whose scores a thread keeps at a time: few enough for a processor's cache. A multiple of most_lanes.
std::size_t receivers_in_block(const ChannelAxes& axes);

}  // namespace lichtmc
