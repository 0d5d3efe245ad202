// The axes of impulse responses: groups of emitters, orders of reflection, time bins, frequencies.
//
// Times are path lengths in the walks, in m of the world; a delay of an emitter is a length that its light has come
// before it starts. Order k is light after k reflections; order 0, the line of sight, is not scored by walks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lichtmc/channel.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "walk/jackknife_groups.hpp"

namespace lichtmc {

struct ChannelAxes {
  // The room must have passed check_room(), the settings check_settings(); settings.channel.wanted().
  ChannelAxes(const Room& room, const Settings& settings);

  std::uint32_t bins = 0;  // later light is in a bin of its own, number `bins`
  double bin_width_s = 0.0;
  double bins_per_m = 0.0;
  std::uint32_t orders = 0;        // 1 … orders are kept apart from each other and from the rest
  std::uint32_t columns = 1;       // of scores: orders 1 … `orders`, the rest, and all; only all if orders = 0
  std::uint32_t coarse_shift = 0;  // a coarse bin is 2^coarse_shift bins; see ChannelSums::coarse
  std::uint32_t coarse_bins = 0;
  FrequencyRange frequencies;
  std::uint32_t frequency_count = 0;

  std::vector<std::string> group_names;         // of each emitter's name in the order of the room, or "all"
  std::vector<std::uint32_t> group_of_emitter;  // of Room::emitters
  std::vector<double> delay_m;                  // of Room::emitters
  std::uint32_t groups = 0;                     // of emitters

  std::uint32_t all_column() const { return columns - 1; }
  std::uint32_t column_of(std::uint32_t order) const { return orders == 0 ? 0 : std::min(order - 1, orders); }

  // Sizes and positions in ChannelSums. A pair is a receiver and a group of emitters, a row one of its columns.
  std::size_t pair(std::size_t receiver, std::size_t group) const { return receiver * groups + group; }
  std::size_t row(std::size_t pair, std::size_t column) const { return pair * columns + column; }
  std::size_t bins_of_row() const { return std::size_t{bins} + 1; }
};

// The number of bins for a room, if no time span is given: 10⁻⁴ of the light is later, by the mean length of flights
// and the mean reflectance (C. F. Eyring, J. Acoust. Soc. Am. 1 (1930) 217), and delays; at most 8192.
std::uint32_t usual_bins(const Room& room, double bin_width_s);

}  // namespace lichtmc
