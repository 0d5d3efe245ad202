#include "base/message.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "lichtmc/visible_text.hpp"

namespace lichtmc {

std::string to_text(double value) {
  std::array<char, 32> text{};  // the shortest form of a double has at most 24 characters
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string short_number(double value) {
  std::array<char, 32> text{};
  // Thousands are easier to read than powers of ten.
  const double size = std::abs(value);
  if (size >= 999.5 && size < 999'500.0) {
    const double unit = size < 9'995.0 ? 10.0 : size < 99'950.0 ? 100.0 : 1'000.0;
    return std::to_string(std::llround(value / unit) * std::llround(unit));
  }
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr;
  return {text.data(), end};
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

}  // namespace lichtmc
