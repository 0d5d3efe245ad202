// The sums of impulse responses over rounds: integers, so that the order does not matter.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/fields.hpp"
#include "base/wide.hpp"
#include "walk/backward_sums.hpp"
#include "walk/channel_axes.hpp"

namespace lichtmc {

// Sums over the rounds of a group of Σ w, Σ w L and Σ w L²: w irradiances in units of ChannelScale, L path lengths in
// units of ChannelScale::length_m.
struct MomentSums {
  uint128 weight = 0;
  uint128 first = 0;
  uint128 second = 0;
};

template <class F, AllOf<MomentSums>... Things>
void visit_fields(const F& f, Things&... sums) {
  f(Field{"weight"}, sums.weight...);
  f(Field{"first"}, sums.first...);
  f(Field{"second"}, sums.second...);
}
template <>
inline constexpr bool is_row<MomentSums> = true;

// The shortest path length, m. Its "sum" is the shorter of two. (Positive numbers are in the order of their bits.)
struct Earliest {
  std::uint64_t bits = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());

  double length_m() const { return std::bit_cast<double>(bits); }
  Earliest& operator+=(const Earliest& other) {
    bits = std::min(bits, other.bits);
    return *this;
  }
};
template <>
inline constexpr bool is_row<Earliest> = true;

struct ChannelSums {
  std::vector<BackwardSums> bins;     // [receiver][group][column][bin, the last for later light]
  std::vector<BackwardSums> columns;  // [receiver][group][column]: of all times
  std::vector<Earliest> earliest;     // [receiver][group][column]
  std::vector<MomentSums> moments;    // [receiver][group][jackknife group]
  std::vector<uint128> coarse;        // [receiver][group][jackknife group][coarse bin]
  std::vector<int128> response;       // [receiver][group][jackknife group][frequency][real, imaginary]

  ChannelSums() = default;
  ChannelSums(const ChannelAxes& axes, std::size_t receivers) {
    const std::size_t pairs = receivers * axes.groups;
    const std::size_t rows = pairs * axes.columns;
    bins.resize(rows * axes.bins_of_row());
    columns.resize(rows);
    earliest.resize(rows);
    moments.resize(pairs * jackknife_groups);
    coarse.resize(moments.size() * axes.coarse_bins);
    response.resize(moments.size() * axes.frequency_count * 2);
  }
  bool has_size_of(const ChannelSums& other) const {
    return bins.size() == other.bins.size() && columns.size() == other.columns.size() &&
           earliest.size() == other.earliest.size() && moments.size() == other.moments.size() &&
           coarse.size() == other.coarse.size() && response.size() == other.response.size();
  }
};

// Adds the sums of some rounds to those of all and clears them: most are 0, and are only read.
void move_sums(ChannelSums& all, ChannelSums& some);

template <class F, AllOf<ChannelSums>... Things>
void visit_fields(const F& f, Things&... sums) {
  f(Field{"bins"}, sums.bins...);
  f(Field{"columns"}, sums.columns...);
  f(Field{"earliest"}, sums.earliest...);
  f(Field{"moments"}, sums.moments...);
  f(Field{"coarse"}, sums.coarse...);
  f(Field{"response"}, sums.response...);
}

}  // namespace lichtmc
