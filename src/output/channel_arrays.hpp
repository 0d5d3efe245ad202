// Impulse responses and channels as named arrays, for all files of arrays.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"
#include "output/h5_writer.hpp"

namespace lichtmc {

inline constexpr std::string_view derived_group = "derived/";

// All arrays of a result with channels.
std::vector<NamedArray> channel_arrays(const Result& result);

// The names of the orders: "0", "1", …, "6+".
std::vector<std::string> order_names(const ImpulseResponses& responses);

// What h is, for the headers of files.
inline constexpr std::string_view what_h_is =
    "h is a density of the gain, in 1/s: received power per time and per power of that emitter. Its integral is the "
    "gain H(0); the unit of power cancels. t = 0 is the emission.";

}  // namespace lichtmc
