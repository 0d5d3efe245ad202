#include "output/readable.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/message.hpp"

namespace lichtmc {

std::string_view power_word(Quantity quantity) {
  return quantity == Quantity::photometric ? "luminous flux" : "power";
}

std::string short_count(std::uint64_t count) {
  const auto number = static_cast<double>(count);
  return count < 999'500 ? short_number(number) : short_number(1e-6 * number) + " million";
}

std::string decimals_of(double value, int decimals) {
  std::array<char, 400> digits{};  // the largest double has 309 before the point
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals);
  return {digits.data(), end.ptr};
}

std::string with_error(double value, double standard_error) {
  constexpr int most_decimals = 9;
  constexpr int least_decimals = -4;  // a larger error hides all digits before the point that one reads
  if (!std::isfinite(value)) return "–";
  if (!std::isfinite(standard_error)) return short_number(value);
  const int decimals = standard_error > 0.0 ? 1 - static_cast<int>(std::floor(std::log10(standard_error))) : 0;
  if (!(standard_error > 0.0) || decimals > most_decimals) return rounded(value, 6);
  if (decimals < least_decimals) return short_number(value) + " ± " + rounded(standard_error, 2);
  const int shown = std::max(0, decimals);
  return decimals_of(value, shown) + " ± " + decimals_of(standard_error, shown);
}

}  // namespace lichtmc
