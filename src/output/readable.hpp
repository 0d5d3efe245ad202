// Numbers and units in the form for readers of the report and the pictures.
#pragma once

#include <cstdint>
#include <string>

namespace lichtmc {

// "150k", "1.5 million".
std::string short_count(std::uint64_t count);

// A share (0 … 1) in percent; "unknown" if it is not finite.
std::string percent(double share);

}  // namespace lichtmc
