// Numbers and units in the form for readers of the report and the pictures.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/message.hpp"
#include "lichtmc/units.hpp"

namespace lichtmc {

// Name of a power: "luminous flux" or "power".
std::string_view power_word(Quantity quantity);

// "150k", "1.5 million".
std::string short_count(std::uint64_t count);

// A number with this many decimals: "0.60".
std::string decimals_of(double value, int decimals);

// A value with its standard error, the error to two digits, both to the same decimals: "23.202 ± 0.041". An error of 0
// is left out, the value then has six digits; an unknown one too, the value then has three. "–" without a value.
std::string with_error(double value, double standard_error);

}  // namespace lichtmc
