// The light that reaches a receiver without reflection, as a part of its channels.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "run/channel_figures.hpp"
#include "walk/channel_axes.hpp"
#include "walk/line_of_sight.hpp"

namespace lichtmc {

using Response = std::vector<std::complex<double>>;

// The light without reflection of one channel, as gains.
struct SightOfChannel {
  bool sampled = false;
  DelayMoments moments;
  std::array<DelayMoments, jackknife_groups> of_set{};  // of sampled paths only
  DelayMoments exact;
  std::vector<std::pair<std::uint32_t, std::array<double, jackknife_groups>>> bins;  // of sampled paths, by set
  std::vector<std::pair<std::uint32_t, double>> exact_bins;
  Response response;  // of all paths
  std::vector<Response> response_of_set;
  Response mean_of_sets;

  // Moments whose difference from `moments` has the part of set j in the jackknife; leverage: see sight_leverage().
  DelayMoments without_set(std::size_t j, double leverage) const {
    DelayMoments sum = moments;
    if (sampled) sum += (moments - exact - of_set[j]) * leverage;
    return sum;
  }
};

// The mean of the sets of sampled paths and its standard error, from their differences.
Figure mean_of_sets(const std::array<double, jackknife_groups>& sets);

// The parts of area lights add up to the direct irradiance of the receiver, which was sampled apart. Its error is given
// to the sets: each of them is higher or lower by √31 of it, so that the mean of 32 has this error.
void match_direct(LineOfSight& sight, const DirectIrradiance& direct);

// Of the emitters of a group; gain: of an irradiance of 1.
SightOfChannel sight_of_group(const LineOfSight& sight, std::uint32_t group, double gain, const ChannelAxes& axes,
                              const std::vector<double>& frequencies_hz);

}  // namespace lichtmc
