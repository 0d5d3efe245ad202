#include "walk/channel_memory.hpp"

#include <algorithm>

#include "base/lanes.hpp"
#include "walk/channel_scores.hpp"
#include "walk/channel_sums.hpp"

namespace lichtmc {

double bytes_of_sums(const ChannelAxes& axes) {
  const double row = static_cast<double>(axes.bins_of_row() + 1) * sizeof(BackwardSums) + double{sizeof(Earliest)};
  const double group = static_cast<double>(sizeof(MomentSums)) + double{1} * sizeof(uint128) * axes.coarse_bins +
                       2.0 * sizeof(int128) * axes.frequency_count;
  return axes.groups * (axes.columns * row + jackknife_groups * group);
}

double bytes_of_scores(const ChannelAxes& axes) {
  const double row = static_cast<double>(axes.bins_of_row() + 1) * sizeof(ChannelScores::Cell);
  const double group = static_cast<double>(sizeof(MomentSums)) + double{1} * sizeof(std::uint64_t) * axes.coarse_bins +
                       2.0 * sizeof(int128) * axes.frequency_count;
  return axes.groups * (axes.columns * row + jackknife_groups * group);
}

std::size_t receivers_in_block(const ChannelAxes& axes) {
  constexpr double most_bytes = 32e6;
  constexpr double most = 2048.0;
  const double fit = std::clamp(most_bytes / bytes_of_scores(axes), 1.0, most);
  return whole_lanes(static_cast<std::size_t>(fit));
}

}  // namespace lichtmc
