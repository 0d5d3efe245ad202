// Impulse responses in summary.json.
#pragma once

#include <cstddef>

#include "lichtmc/result.hpp"
#include "output/json.hpp"

namespace lichtmc {

// What belongs to all channels: bins, orders, emitters, frequencies. The result has channels.
Json impulse_responses_of(const Result& result);

// One channel: names, derived figures, gains by order.
Json channel_of(const Result& result, std::size_t pair);

}  // namespace lichtmc
