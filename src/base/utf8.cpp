#include "base/utf8.hpp"

#include <algorithm>
#include <array>

#include "lichtmc/visible_text.hpp"

namespace lichtmc {

Character first_character(std::string_view text) {
  if (text.empty()) return {};
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
  if (bytes == 0 || bytes > text.size()) return {};
  char32_t code = lead & (0x7FU >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    const auto next = static_cast<unsigned char>(text[k]);
    if ((next & 0xC0U) != 0x80U) return {};
    code = code << 6U | (next & 0x3FU);
  }
  constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < least[bytes] || code > 0x10FFFF || surrogate) return {};
  return {code, bytes};
}

void append_utf8(std::string& text, char32_t code) {
  const auto byte = [&text](char32_t value) { text += static_cast<char>(static_cast<unsigned char>(value)); };
  const auto rest = [&byte, code](unsigned shift) { byte(0x80U | (code >> shift & 0x3FU)); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0U | code >> 6U);
    rest(0);
  } else if (code < 0x10000) {
    byte(0xE0U | code >> 12U);
    rest(6);
    rest(0);
  } else {
    byte(0xF0U | code >> 18U);
    rest(12);
    rest(6);
    rest(0);
  }
}

bool acts_on_terminal(char32_t code) {
  struct Range {
    char32_t first, last;
  };
  constexpr std::array<Range, 8> ranges{{{0x00, 0x1F},
                                         {0x7F, 0x9F},
                                         {0x061C, 0x061C},
                                         {0x200E, 0x200F},
                                         {0x2028, 0x2029},
                                         {0x202A, 0x202E},
                                         {0x2066, 0x2069},
                                         {0xFEFF, 0xFEFF}}};
  return std::any_of(ranges.begin(), ranges.end(),
                     [code](const Range& range) { return code >= range.first && code <= range.last; });
}

std::string visible_text(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string out;
  const auto append_hex = [&](char32_t value, unsigned count) {
    for (unsigned k = count; k > 0; --k) out += digits[value >> 4U * (k - 1) & 0xFU];
  };
  while (!text.empty()) {
    const Character character = first_character(text);
    if (character.bytes == 0) {
      out += "\\x";
      append_hex(static_cast<unsigned char>(text.front()), 2);
    } else if (acts_on_terminal(character.code)) {
      out += "\\u";
      append_hex(character.code, 4);
    } else {
      out += text.substr(0, character.bytes);
    }
    text.remove_prefix(std::max<std::size_t>(character.bytes, 1));
  }
  return out;
}

}  // namespace lichtmc
