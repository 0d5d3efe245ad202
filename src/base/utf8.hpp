// UTF-8, character by character.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lichtmc {

// The character at the start of a text: its code point, and its number of bytes, 1 to 4. 0 bytes: the text does not
// begin with UTF-8 (RFC 3629: no overlong form, no surrogate, nothing above U+10FFFF).
struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};
Character first_character(std::string_view text);

// Appends a code point (0 … 0x10FFFF) as UTF-8.
void append_utf8(std::string& text, char32_t code);

// Whether a terminal may act on a character instead of showing it: the characters that visible_text() escapes.
bool acts_on_terminal(char32_t code);

}  // namespace lichtmc
