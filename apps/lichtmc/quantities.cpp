#include "quantities.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "lichtmc/error.hpp"

namespace lichtmc::app {

namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view allowed) {
  throw InputError("The value '" + std::string(text) + "' of " + std::string(option) +
                   " cannot be used (allowed: " + std::string(allowed) + "). Give it in that form.");
}

// Splits "12.5ms" into the number and the rest; false if there is no finite number.
bool split_number(std::string_view text, double& number, std::string_view& rest) {
  const char* begin = text.data();
  const char* end = text.data() + text.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, error] = std::from_chars(begin, end, number);
  rest = std::string_view(stop, static_cast<std::size_t>(end - stop));
  return error == std::errc() && std::isfinite(number);
}

struct Suffix {
  std::string_view text;
  double factor;
};

// A number with one of these suffixes; false for anything else.
template <std::size_t N>
bool scaled(std::string_view text, const std::array<Suffix, N>& suffixes, double& number) {
  std::string_view rest;
  if (!split_number(text, number, rest)) return false;
  for (const Suffix& suffix : suffixes) {
    if (rest != suffix.text) continue;
    number *= suffix.factor;
    return true;
  }
  return false;
}

}  // namespace

double parse_number(std::string_view text, std::string_view option) {
  double number = 0.0;
  std::string_view rest;
  if (!split_number(text, number, rest) || !rest.empty()) refuse(option, text, "a number, for example 0.5");
  return number;
}

std::uint64_t parse_count(std::string_view text, std::string_view option) {
  constexpr std::string_view allowed = "a whole number from 1 to 9e18, for example 1000000, 1e6, 10M or 2G";
  // Plain digits are read exactly; other forms as a double, which represents whole numbers up to 2^53 exactly.
  std::uint64_t count = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error == std::errc() && stop == text.data() + text.size() && count <= (std::uint64_t{1} << 63)) return count;
  constexpr std::array<Suffix, 6> suffixes{{{"", 1.0}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9}, {"T", 1e12}, {"K", 1e3}}};
  double number = 0.0;
  const bool read = scaled(text, suffixes, number);
  const double whole = std::round(number);
  // 1.005M is 1004999.9999999999 in double: the product of two roundings may deviate that much from the whole number.
  if (!read || number < 0.0 || number > 0x1p63 || std::abs(number - whole) > 2.0 * 0x1p-53 * number)
    refuse(option, text, allowed);
  return static_cast<std::uint64_t>(whole);
}

std::uint64_t parse_seed(std::string_view text, std::string_view option) {
  std::uint64_t seed = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || stop != text.data() + text.size())
    refuse(option, text, "a whole number from 0 to 18446744073709551615");
  return seed;
}

unsigned parse_threads(const std::optional<int>& threads) {
  if (threads && *threads < 1) {
    throw InputError("The number of threads is " + std::to_string(*threads) +
                     " (allowed: 1 or more). Leave out --threads to use all processors.");
  }
  return static_cast<unsigned>(threads.value_or(0));
}

double parse_fraction(std::string_view text, std::string_view option) {
  constexpr std::array<Suffix, 2> suffixes{{{"", 1.0}, {"%", 0.01}}};
  double number = 0.0;
  if (!scaled(text, suffixes, number)) refuse(option, text, "a fraction above 0, for example 1% or 0.01");
  if (number >= 1.0 && text.back() != '%')
    refuse(option, text, "a fraction below 1, or a percentage with %, for example 3% or 0.03");
  return number;
}

double parse_factor(std::string_view text, std::string_view option) {
  constexpr std::array<Suffix, 2> suffixes{{{"", 1.0}, {"%", 0.01}}};
  double number = 0.0;
  if (!scaled(text, suffixes, number) || number < 0.0)
    refuse(option, text, "a number of 0 or more, for example 0.3 or 30%");
  return number;
}

double parse_seconds(std::string_view text, std::string_view option) {
  constexpr std::array<Suffix, 5> suffixes{{{"", 1.0}, {"s", 1.0}, {"min", 60.0}, {"m", 60.0}, {"h", 3600.0}}};
  double number = 0.0;
  if (!scaled(text, suffixes, number)) refuse(option, text, "a time above 0, for example 60s, 5min or 2h");
  return number;
}

namespace {

// A number with the suffix of one of these powers of ten, rounded once: "0.2ns" is the double next to 2·10⁻¹⁰, which
// the product of 0.2 and 10⁻⁹ need not be.
struct PowerOfTen {
  std::string_view suffix;
  int exponent;
};

template <std::size_t N>
std::optional<double> decimal(std::string_view text, const std::array<PowerOfTen, N>& powers) {
  double number = 0.0;
  std::string_view unit;
  if (!split_number(text, number, unit)) return std::nullopt;
  const auto power = std::find_if(powers.begin(), powers.end(), [&](const PowerOfTen& p) { return p.suffix == unit; });
  if (power == powers.end()) return std::nullopt;
  std::array<char, 32> digits{};  // the shortest decimal number is the one that was given, up to 15 digits
  const char* end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::scientific).ptr;
  const std::string_view written(digits.data(), static_cast<std::size_t>(end - digits.data()));
  const std::size_t e = written.find('e');
  const int exponent = std::atoi(written.data() + e + 1) + power->exponent;
  const std::string shifted = std::string(written.substr(0, e)) + "e" + std::to_string(exponent);
  const auto [stop, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), number);
  if (error != std::errc()) return std::nullopt;  // too small or too large for a double
  return number;
}

constexpr std::array<PowerOfTen, 6> times{{{"s", 0}, {"ms", -3}, {"us", -6}, {"µs", -6}, {"ns", -9}, {"ps", -12}}};

}  // namespace

double parse_short_time(std::string_view text, std::string_view option) {
  if (const auto seconds = decimal(text, times)) return *seconds;
  refuse(option, text, "a time with its unit ps, ns, us, ms or s, for example 5ns");
}

double parse_delay(std::string_view text, std::string_view option) {
  constexpr std::array<PowerOfTen, 3> lengths{{{"m", 0}, {"cm", -2}, {"mm", -3}}};
  if (const auto seconds = decimal(text, times)) return *seconds;
  if (const auto metres = decimal(text, lengths)) return *metres / speed_of_light;
  refuse(
      option, text,
      "a time with its unit ps, ns, us, ms or s, or a length of path with its unit mm, cm or m, for example 0.2ns or "
      "0.1m");
}

std::uint32_t parse_orders(std::string_view text, std::string_view option) {
  std::uint32_t count = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || stop != text.data() + text.size()) refuse(option, text, "a whole number from 0 to 64");
  return count;
}

FrequencyRange parse_frequencies(std::string_view text, std::string_view option) {
  constexpr std::array<PowerOfTen, 8> units{
      {{"", 0}, {"Hz", 0}, {"k", 3}, {"kHz", 3}, {"M", 6}, {"MHz", 6}, {"G", 9}, {"GHz", 9}}};
  constexpr std::string_view allowed =
      "the first frequency, the last one and the step, each with its unit Hz, kHz, MHz or GHz, for example "
      "0:400MHz:1MHz";
  std::array<double, 3> hz{};
  std::string_view rest = text;
  for (std::size_t k = 0; k < hz.size(); ++k) {
    const std::size_t colon = rest.find(':');
    const bool last = k + 1 == hz.size();
    const auto value = decimal(rest.substr(0, colon), units);
    if (!value || (colon == std::string_view::npos) != last) refuse(option, text, allowed);
    hz[k] = *value;
    if (!last) rest.remove_prefix(colon + 1);
  }
  // A step of 0 means in FrequencyRange that there are none.
  if (!(hz[2] > 0.0)) refuse(option, text, "a step above 0, for example 0:400MHz:1MHz");
  return {hz[0], hz[1], hz[2]};
}

glm::dvec3 parse_vector(std::string_view text, std::string_view option) {
  glm::dvec3 vector(0.0);
  std::string_view rest = text;
  for (int k = 0; k < 3; ++k) {
    std::string_view after;
    const bool last = k == 2;
    if (!split_number(rest, vector[k], after) || after.empty() != last || (!last && after.front() != ',')) {
      refuse(option, text, "three numbers separated by commas, for example 1,2.5,0");
    }
    rest = last ? after : after.substr(1);
  }
  return vector;
}

double parse_power(std::string_view text, std::string_view option, Quantity& quantity) {
  double power = 0.0;
  std::string_view unit;
  if (!split_number(text, power, unit) || (unit != "lm" && unit != "W") || power < 0.0) {
    refuse(option, text, "a power of 0 or more with its unit, for example 1000lm or 1W");
  }
  quantity = parse_unit(unit, option);
  return power;
}

ErrorFloor parse_error_floor(std::string_view text, std::string_view option) {
  ErrorFloor floor;
  std::string_view unit;
  const bool read = split_number(text, floor.value, unit) && floor.value >= 0.0;
  if (read && unit == "lx") floor.unit = Quantity::photometric;
  if (read && (unit == "W/m^2" || unit == "W/m2" || unit == "W/m²")) floor.unit = Quantity::radiometric;
  if (read && unit == "%") floor.value *= 0.01;
  const bool is_share = (unit.empty() && floor.value < 1.0) || unit == "%";
  if (!read || !(floor.unit || is_share))
    refuse(option, text,
           "a share of the mean of 0 or more, for example 1% or 0, or an irradiance, for example 1lx or "
           "0.1W/m^2");
  return floor;
}

Quantity parse_unit(std::string_view text, std::string_view option) {
  if (text == "W") return Quantity::radiometric;
  if (text == "lm") return Quantity::photometric;
  refuse(option, text, "W or lm");
}

std::string four_digits(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4g", value);
  const double size = std::abs(std::strtod(text, nullptr));
  const bool readable = size >= 1e-7 && size < 1e13;
  if (std::string_view(text).find('e') == std::string_view::npos || !readable) return text;
  // printf's %g changes to powers of ten below 10⁻⁴ and above 10⁴.
  const int decimals = std::max(0, 3 - static_cast<int>(std::floor(std::log10(size))));
  std::snprintf(text, sizeof text, "%.*f", decimals, std::strtod(text, nullptr));
  std::string number = text;
  if (decimals > 0) number.erase(number.find_last_not_of('0') + 1);
  return number;
}

}  // namespace lichtmc::app
