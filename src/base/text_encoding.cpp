#include "base/text_encoding.hpp"

#include "base/utf8.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

using namespace std::string_view_literals;

struct Name {
  const std::string& name;
  const std::string& remedy;
};

[[noreturn]] void refuse(const Name& name, const std::string& what) {
  throw InputError(name.name + " " + what + " (allowed: text as UTF-8, or as UTF-16 with a byte order mark). " +
                   name.remedy);
}

// `bytes` are those after the byte order mark.
std::string from_utf16(std::string_view bytes, bool big_endian, const Name& name) {
  if (bytes.size() % 2 != 0) refuse(name, "is UTF-16 that ends with half a character");
  const auto unit = [bytes, big_endian](std::size_t k) -> char32_t {
    const auto first = static_cast<unsigned char>(bytes[k]);
    const auto second = static_cast<unsigned char>(bytes[k + 1]);
    return big_endian ? static_cast<char32_t>(first << 8U | second) : static_cast<char32_t>(second << 8U | first);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t k = 0; k < bytes.size(); k += 2) {
    char32_t code = unit(k);
    if (code >= 0xD800 && code <= 0xDFFF) {  // a character above U+FFFF takes two units: high, then low surrogate
      const char32_t low = k + 2 < bytes.size() ? unit(k + 2) : 0;
      if (code > 0xDBFF || low < 0xDC00 || low > 0xDFFF)
        refuse(name, "is UTF-16 with half a character at byte " + std::to_string(k + 2));
      code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
      k += 2;
    }
    append_utf8(text, code);
  }
  return text;
}

}  // namespace

std::string utf8_of(std::string_view bytes, const std::string& file, const std::string& remedy) {
  const Name name{file, remedy};
  if (bytes.starts_with("\xEF\xBB\xBF")) return std::string(bytes.substr(3));
  if (bytes.starts_with("\xFF\xFE\0\0"sv) || bytes.starts_with("\0\0\xFE\xFF"sv)) refuse(name, "is text as UTF-32");
  if (bytes.starts_with("\xFF\xFE")) return from_utf16(bytes.substr(2), false, name);
  if (bytes.starts_with("\xFE\xFF")) return from_utf16(bytes.substr(2), true, name);
  // The first character of a table is ASCII, of which UTF-16 makes a byte 0 and another.
  if (bytes.substr(0, 2).find('\0') != std::string_view::npos)
    refuse(name, "is not text, or UTF-16 without a byte order mark");
  if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("\xD0\xCF\x11\xE0"))
    refuse(name, "is not text but the file of a spreadsheet program");
  return std::string(bytes);
}

}  // namespace lichtmc
