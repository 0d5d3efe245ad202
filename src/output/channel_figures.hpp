// The figures of channels as all files name them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lichtmc/channel.hpp"

namespace lichtmc {

// A figure that is derived from an impulse response. Its standard error has the same name with standard_error_suffix
// and the same unit.
struct ChannelFigure {
  std::string_view name;  // of the column, key or array, with the unit if that is not 1
  std::string_view unit;  // "1", "dB", "s" or "Hz"
  std::string_view description;
  bool has_error = true;
  Figure (*of)(const Channel&) = nullptr;
};

inline constexpr std::string_view standard_error_suffix = "_standard_error";

// The figures that a run with these settings determines.
std::span<const ChannelFigure> channel_figures(const ChannelSettings& settings);

// What Channel::first_arrival_s is: "exact", "upper-bound", or "none" without light.
std::string_view first_arrival_word(const Channel& channel);

// A gain as 10 log₁₀; NaN unless it is above 0.
Figure in_db(const Figure& gain);

}  // namespace lichtmc
