// Numbers and units as people read them, in pages and pictures.
#pragma once

#include <cstdint>
#include <string>

#include "lichtmc/units.hpp"

namespace lichtmc {

// "150k", "1.5 million".
std::string short_count(std::uint64_t count);

// A share of 1 in percent; "unknown" where it is not finite.
std::string percent(double share);

// "lx" or "W/m²"; files for programs have irradiance_unit().
std::string written_irradiance_unit(Quantity quantity);

}  // namespace lichtmc
