// Numbers of the command line: 1e6, 10M, 2G; 1%; 60s, 5min, 2h; 0.2ns; 0:400MHz:1MHz; 0.3,0.5,0.2; 1000lm.
//
// Each function throws InputError that names the option, the value, what is allowed and an example.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

#include "lichtmc/channel.hpp"
#include "lichtmc/units.hpp"

namespace lichtmc::app {

// A finite number.
double parse_number(std::string_view text, std::string_view option);

// A count up to 2^63: "1000000", "1e6", "10k", "10M", "2G".
std::uint64_t parse_count(std::string_view text, std::string_view option);

// The seed: a whole number from 0 to 2^64 − 1.
std::uint64_t parse_seed(std::string_view text, std::string_view option);

// --threads: 1 or more; 0, one per processor, if it is not given.
unsigned parse_threads(const std::optional<int>& threads);

// A fraction: "1%" or "0.01"; 1 and more only with the percent sign.
double parse_fraction(std::string_view text, std::string_view option);

// A factor, 0 or more: "0.3", "30%", "1.2".
double parse_factor(std::string_view text, std::string_view option);

// Seconds: "60", "60s", "5min", "2h".
double parse_seconds(std::string_view text, std::string_view option);

// A time in s, "0.2ns", with the unit ps, ns, us, ms or s: the double next to the decimal number.
double parse_short_time(std::string_view text, std::string_view option);

// The same, or the time in s that light takes for a length of path in m, cm or mm: "0.1m".
double parse_delay(std::string_view text, std::string_view option);

// A number of reflections.
std::uint32_t parse_orders(std::string_view text, std::string_view option);

// "A:B:STEP", each with the unit Hz, kHz, MHz or GHz or as k, M or G: "0:400MHz:1MHz".
FrequencyRange parse_frequencies(std::string_view text, std::string_view option);

// Three numbers separated by commas.
glm::dvec3 parse_vector(std::string_view text, std::string_view option);

// A luminous flux, "1000lm", or a radiant flux, "1W".
double parse_power(std::string_view text, std::string_view option, Quantity& quantity);

// An error floor: a share of the mean irradiance, "1%", "0.01" or "0", or an irradiance, "1lx", "0.1W/m^2" ("0.1W/m2").
struct ErrorFloor {
  double value = 0.0;
  std::optional<Quantity> unit;  // none for a share
};
ErrorFloor parse_error_floor(std::string_view text, std::string_view option);

// "W" or "lm".
Quantity parse_unit(std::string_view text, std::string_view option);

// A number to four digits, as people write it: "0.1234", "13270", "1.234e13".
std::string four_digits(double value);

}  // namespace lichtmc::app
