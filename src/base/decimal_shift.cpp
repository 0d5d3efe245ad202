#include "base/decimal_shift.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

namespace lichtmc {

double shift_decimals(double value, int exponent) {
  std::array<char, 32> digits{};  // the longest has 24 characters; ends with a null character
  const char* end =
      std::to_chars(digits.data(), digits.data() + digits.size() - 1, value, std::chars_format::scientific).ptr;
  const std::string text(static_cast<const char*>(digits.data()), end);
  const std::size_t mark = text.find('e');
  if (mark == std::string::npos) return value;  // infinite or not a number
  const int shifted = std::atoi(text.c_str() + mark + 1) + exponent;
  const std::string number = text.substr(0, mark) + "e" + std::to_string(shifted);
  double result = 0.0;
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), result);
  if (error != std::errc()) return shifted < 0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), value);
  return result;
}

}  // namespace lichtmc
