// Pictures of impulse responses.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"

namespace lichtmc {

// The pictures of one channel, as SVG.
struct ChannelPictures {
  std::size_t pair = 0;   // index into ImpulseResponses::channels
  std::string response;   // h(t) with its standard error, logarithmic
  std::string by_order;   // reflected light, stacked by the number of reflections
  std::string frequency;  // |H(f)|; empty without frequencies
};

// The channels that are shown: the one with the highest gain and, if there are others with light, that with the lowest.
std::vector<std::size_t> shown_channels(const ImpulseResponses& responses);

// The channel has light.
ChannelPictures channel_pictures(const Result& result, std::size_t pair);

// "from 'lamp' to 'desk'", or "to 'desk'" if the emitters are not kept apart.
std::string channel_name(const ImpulseResponses& responses, std::size_t pair);

}  // namespace lichtmc
