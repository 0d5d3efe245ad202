// Impulse responses and channels as named arrays, for all files of arrays.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"

namespace lichtmc {

// An array of numbers, the last dimension fastest.
struct ChannelArray {
  std::string name;                   // "h"; of a derived figure "derived/gain"
  std::string unit;                   // "1/s"; "1" for pure numbers
  std::string dimensions;             // "emitter, receiver, order, bin"; empty for a single number
  std::string description;            // a sentence without a full stop
  std::vector<std::size_t> sizes;     // of the dimensions
  std::vector<double> own;            // the values, if the array was made for this; else they are
  std::span<const double> elsewhere;  // in the result, which must outlive the array

  std::span<const double> values() const { return own.empty() ? elsewhere : std::span<const double>(own); }
};

inline constexpr std::string_view derived_group = "derived/";

// All arrays of a result with channels.
std::vector<ChannelArray> channel_arrays(const Result& result);

// The names of the orders: "0", "1", …, "6+".
std::vector<std::string> order_names(const ImpulseResponses& responses);

// What h is, for the headers of files.
inline constexpr std::string_view what_h_is =
    "h is a density of the gain, in 1/s: received power per time and per power of that emitter. Its integral is the "
    "gain H(0); the unit of power cancels. t = 0 is the emission.";

}  // namespace lichtmc
