#include "base/message.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "lichtmc/visible_text.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t shown_names = 5;

// "1.50" → "1.5", "2.00" → "2", "300" → "300".
std::string without_trailing_zeros(std::string number) {
  if (number.find('.') == std::string::npos) return number;
  number.erase(number.find_last_not_of('0') + 1);
  if (number.back() == '.') number.pop_back();
  return number;
}

std::string superscript(int exponent) {
  constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> text{};  // the shortest form of a double has at most 24 characters
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string percent(double share) {
  return std::isfinite(share) ? short_number(100.0 * share) + " %" : "unknown";
}

std::string short_number(double value) {
  return rounded(value, 3);
}

std::string rounded(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return to_text(value == 0.0 ? 0.0 : value);
  // As %e: one digit, the point, the others, the exponent; it rounds 9.999 to 1.00·10¹.
  std::array<char, 64> text{};
  auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1).ptr;
  const std::string_view scientific(text.data(), static_cast<std::size_t>(end - text.data()));
  const std::size_t e = scientific.find('e');
  int exponent = 0;
  const std::size_t sign = scientific[e + 1] == '+' ? 1 : 0;
  std::from_chars(scientific.data() + e + 1 + sign, end, exponent);
  const std::string mantissa(scientific.substr(0, e));
  constexpr int largest = 12;   // 1 000 000 000 000 can still be read
  constexpr int smallest = -6;  // 0.000001 too
  if (exponent > largest || exponent < smallest)
    return without_trailing_zeros(mantissa) + "·10" + superscript(exponent);
  double short_value = 0.0;
  std::from_chars(scientific.data(), end, short_value);
  const int decimals = std::max(0, digits - 1 - exponent);
  end = std::to_chars(text.data(), text.data() + text.size(), short_value, std::chars_format::fixed, decimals).ptr;
  return without_trailing_zeros({text.data(), end});
}

std::string decimal(double value, int decimals) {
  if (!std::isfinite(value) || std::abs(value) > 1e15) return short_number(value);
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr;
  const std::string shortest = without_trailing_zeros({text.data(), end});
  return shortest == "-0" ? "0" : shortest;
}

std::string position_text(double coordinate_m) {
  const double size = std::abs(coordinate_m);
  constexpr double least = 1e-12;  // nothing is meant by less
  return decimal(coordinate_m, size >= 0.1 || !(size > least) ? 3 : 2 - static_cast<int>(std::floor(std::log10(size))));
}

std::string to_text(std::size_t count, std::string_view singular) {
  std::string text = std::to_string(count) + " " + std::string(singular);
  if (count != 1) text += "s";
  return text;
}

std::string in_quotes(std::string_view name) {
  if (name.empty()) return "(no name)";
  return "'" + visible_text(name) + "'";
}

void Names::add(const std::string& text) {
  if (count_++ < shown_names) text_ += (text_.empty() ? "" : ", ") + text;
}

std::string Names::text() const {
  return count_ > shown_names ? text_ + " and " + std::to_string(count_ - shown_names) + " more" : text_;
}

}  // namespace lichtmc
