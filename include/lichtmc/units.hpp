// Radiometric or photometric: the quantity of a room's powers. Power means radiant flux (W) or luminous flux (lm).
//
// A room has one quantity, never both. There is no conversion between the two: results are linear in the power, so the
// same histories serve both, and only the unit of the numbers differs.
#pragma once

#include <string>
#include <string_view>

namespace lichtmc {

enum class Quantity {
  radiometric,  // radiant flux in W, irradiance in W/m²
  photometric,  // luminous flux in lm, illuminance in lx = lm/m²
};

// Unit of power: "W" or "lm".
constexpr std::string_view power_unit(Quantity quantity) {
  return quantity == Quantity::radiometric ? "W" : "lm";
}

// Unit of power per area: "W/m^2" or "lx".
constexpr std::string_view irradiance_unit(Quantity quantity) {
  return quantity == Quantity::radiometric ? "W/m^2" : "lx";
}

// The same in texts for readers: "W/m²" or "lx". Files for programs have irradiance_unit().
inline std::string written_irradiance_unit(Quantity quantity) {
  return quantity == Quantity::radiometric ? "W/m²" : "lx";
}

// Name of power per area: "irradiance" or "illuminance".
constexpr std::string_view irradiance_word(Quantity quantity) {
  return quantity == Quantity::radiometric ? "irradiance" : "illuminance";
}

}  // namespace lichtmc
