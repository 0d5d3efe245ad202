// Radiometric or photometric: which kind of power a room's numbers are.
//
// A room is one or the other, never a mixture. Nothing is converted between the two: the walk is linear in the power,
// so the same histories serve both, and only the unit written beside the numbers differs.
#pragma once

#include <string_view>

namespace lichtmc {

enum class Quantity {
  radiometric,  // power in W, irradiance in W/m²
  photometric,  // power in lm, illuminance in lx = lm/m²
};

// Unit of power: "W" or "lm".
constexpr std::string_view power_unit(Quantity quantity) {
  return quantity == Quantity::radiometric ? "W" : "lm";
}

// Unit of power per area: "W/m^2" or "lx".
constexpr std::string_view irradiance_unit(Quantity quantity) {
  return quantity == Quantity::radiometric ? "W/m^2" : "lx";
}

// Word for power per area: "irradiance" or "illuminance".
constexpr std::string_view irradiance_word(Quantity quantity) {
  return quantity == Quantity::radiometric ? "irradiance" : "illuminance";
}

}  // namespace lichtmc
