// Tables as text, their encoding, and texts for terminals.
#include <sstream>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "base/text_encoding.hpp"
#include "base/utf8.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/visible_text.hpp"
#include "support/catch.hpp"

using namespace lichtmc;
using namespace std::string_literals;

namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string& text, char separator = ',') {
  std::istringstream in(text);
  CsvReader reader(in, separator);
  Rows rows;
  for (CsvRow row; reader.next(row);) {
    rows.emplace_back();
    for (const CsvField& field : row.fields) rows.back().push_back(field.text);
  }
  return rows;
}

std::vector<std::size_t> lines_of(const std::string& text) {
  std::istringstream in(text);
  CsvReader reader(in, ',');
  std::vector<std::size_t> lines;
  for (CsvRow row; reader.next(row);) lines.push_back(row.line);
  return lines;
}

}  // namespace

TEST_CASE("csv: rows end with LF, CR LF or CR, and the last with nothing") {
  const Rows expected{{"a", "b"}, {"c", ""}, {""}, {"d", "e"}};
  CHECK(rows_of("a,b\nc,\n\nd,e") == expected);
  CHECK(rows_of("a,b\r\nc,\r\n\r\nd,e\r\n") == expected);
  CHECK(rows_of("a,b\rc,\r\rd,e\r") == expected);
  CHECK(rows_of("a,b\r\nc,\n\rd,e\n") == expected);
  CHECK(rows_of("").empty());
  CHECK(rows_of("a,") == Rows{{"a", ""}});
}

TEST_CASE("csv: quotes contain separators, line ends and doubled quotes; blanks around them do not count") {
  CHECK(rows_of("\"a,b\",\"c\nd\r\ne\",\"say \"\"so\"\"\",\"\"") == Rows{{"a,b", "c\nd\r\ne", "say \"so\"", ""}});
  CHECK(rows_of("  \"a\"  , b ,c\"d\"") == Rows{{"a", " b ", "c\"d\""}});
  CHECK(rows_of("\"a\tb\"\t\" c\"", '\t') == Rows{{"a\tb", " c"}});
  CHECK(rows_of("  1 \t 2  \"x y\" \n3", ' ') == Rows{{"1", "2", "x y"}, {"3"}});
}

TEST_CASE("csv: rows have the line numbers of an editor, also behind line ends in quotes") {
  CHECK(lines_of("a\n\"b\nc\r\nd\re\"\nf\n") == std::vector<std::size_t>{1, 2, 6});
  CHECK(lines_of("a\r\rb\r\nc") == std::vector<std::size_t>{1, 2, 3, 4});
}

TEST_CASE("csv: a quote that is not closed, or closed inside a field, is a fault with its line") {
  for (const auto& [text, line] : {std::pair{"a\nb,\"c\nd\n", 2}, std::pair{"a\n\n\"b\"c,d\n", 3}}) {
    try {
      rows_of(text);
      FAIL("accepted " << text);
    } catch (const CsvFault& fault) {
      CHECK(fault.line == static_cast<std::size_t>(line));
    }
  }
}

TEST_CASE("csv: any text survives as a field") {
  for (const std::string& name : {"plain"s, ""s, "a,b"s, "say \"so\""s, "\""s, "a\nb"s, "a\r\nb"s, "a\rb"s, "\n"s,
                                  " a "s, "\ta"s, "a\0b"s, "\xFF\xC3"s, "#a"s, "\x1B[31m"s, "\xE2\x80\xA8"s}) {
    CAPTURE(name);
    CHECK(rows_of("1," + csv_field(name) + ",2\n3,4,5\n") == Rows{{"1", name, "2"}, {"3", "4", "5"}});
  }
}

TEST_CASE("text files: UTF-8 and UTF-16 with a byte order mark are read, other encodings refused with the cause") {
  CHECK(utf8_of("x,y", "f") == "x,y");
  CHECK(utf8_of("\xEF\xBB\xBFx", "f") == "x");
  CHECK(utf8_of("\xFF\xFEx\0\xE4\0\x3D\xD8\x02\xDE"s, "f") == "x\xC3\xA4\xF0\x9F\x98\x82");
  CHECK(utf8_of("\xFE\xFF\0x\0\xE4\xD8\x3D\xDE\x02"s, "f") == "x\xC3\xA4\xF0\x9F\x98\x82");
  CHECK(utf8_of("", "f").empty());
  for (const std::string& bytes : {"\xFF\xFEx\0y"s, "\xFF\xFE\x3D\xD8x\0"s, "\xFF\xFE\x02\xDEx\0"s, "x\0,\0"s,
                                   "\0x\0,"s, "\xFF\xFE\0\0x\0\0\0"s, "PK\x03\x04..."s, "\xD0\xCF\x11\xE0..."s}) {
    CAPTURE(bytes);
    CHECK_THROWS_AS(utf8_of(bytes, "f.csv"), InputError);
    CHECK_THROWS_WITH(utf8_of(bytes, "f.csv"), ContainsSubstring("f.csv is ") && ContainsSubstring("CSV in UTF-8"));
  }
}

TEST_CASE("visible text: what a terminal would obey is escaped, all other text is unchanged") {
  CHECK(visible_text("W\xC3\xA4nde \xE5\xBA\x8A \xF0\x9F\x98\x82 'a\\b'") ==
        "W\xC3\xA4nde \xE5\xBA\x8A \xF0\x9F\x98\x82 'a\\b'");
  CHECK(visible_text("a\nb\r\tc\0d\x7F"s) == "a\\u000ab\\u000d\\u0009c\\u0000d\\u007f");
  CHECK(visible_text("\x1B[2J\xC2\x9B[2J") == "\\u001b[2J\\u009b[2J");
  CHECK(visible_text("\xE2\x80\xA8\xE2\x80\xAE\xE2\x81\xA6\xD8\x9C\xEF\xBB\xBF") ==
        "\\u2028\\u202e\\u2066\\u061c\\ufeff");
  // Not UTF-8: a lone byte, an overlong form, a surrogate, a character that is cut off.
  CHECK(visible_text("\x9B") == "\\x9b");
  CHECK(visible_text("\xC0\x8A") == "\\xc0\\x8a");
  CHECK(visible_text("\xED\xA0\x80") == "\\xed\\xa0\\x80");
  CHECK(visible_text("a\xE2\x80") == "a\\xe2\\x80");
}

TEST_CASE("utf-8: every code point is written and read back") {
  for (char32_t code = 0; code <= 0x10FFFF; code += code < 0x3000 ? 1 : 101) {
    if (code >= 0xD800 && code <= 0xDFFF) continue;
    std::string text;
    append_utf8(text, code);
    const Character back = first_character(text);
    REQUIRE(back.code == code);
    REQUIRE(back.bytes == text.size());
  }
}
