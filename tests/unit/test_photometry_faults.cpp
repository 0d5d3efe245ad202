// Malformed photometric files: each is refused in one line with the file, the line, the value and the cure.
#include <fstream>
#include <string>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/photometric_files.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

const std::string ies =
    "IESNA:LM-63-2002\n[TEST] T1\n[MANUFAC] maker\nTILT=NONE\n1 -1 1 4 2 1 2 0 0 0\n1 1 50\n0 30 60 90\n0 90\n"
    "400 500 450 325\n400 470 390 240\n";

const std::string ldt =
    "maker\n3\n4\n4\n90\n3\n45\nreport\nname\nnumber\nfile\ndate\n600\n300\n80\n500\n250\n0\n0\n0\n0\n100\n100\n1\n0\n1"
    "\n"
    "1\nLED\n1000\n4000\n80\n20\n.5\n.5\n.5\n.5\n.5\n.5\n.5\n.5\n.5\n."
    "5\n0\n90\n180\n270\n0\n45\n90\n300\n200\n100\n300\n"
    "190\n90\n";

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), replacement);
}

// Replaces a line, counted from 1.
std::string with_line(const std::string& text, std::size_t number, const std::string& replacement) {
  std::string result;
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = text.find('\n', at);
    result += line == number ? replacement : text.substr(at, end - at);
    result += '\n';
    at = end + 1;
  }
  return result;
}

std::string fault_of(const std::string& content, const std::string& name, const PhotometryOptions& options = {}) {
  try {
    parse_photometry(content, name, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// One line that begins with the file, has the words, and ends as a sentence.
void check_message(const std::string& message, const std::string& file, const std::string& words) {
  INFO(message);
  CHECK(message.rfind(file, 0) == 0);
  CHECK(message.find(words) != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
  CHECK((message.back() == '.' || message.back() == ')'));
}

struct BadFile {
  const char* file;
  const char* words;
};

}  // namespace

TEST_CASE("bad photometric files are refused with the file, the line, the value and the cure") {
  const std::vector<BadFile> files{
      {"b_not_photometric.ies", ": no line starts with \"TILT=\", so this is not an IES LM-63 file"},
      {"b_no_tilt.ies", ": no line starts with \"TILT=\", so this is not an IES LM-63 file"},
      {"b_truncated.ies",
       ": 234 candela values are announced (18 vertical x 13 horizontal angles), the file ends after 181"},
      {"b_nan.ies", ":10: \"nan\" is not a number (candela)"},
      {"b_zero_angles.ies", ":5: the number of vertical angles is 0; at least 2 are needed"},
      {"b_huge_count.ies", ":5: the number of vertical angles is 900000000; at most 20000 are read"},
      {"b_v_not_increasing.ies", ":7: vertical angles must rise: 30 follows 60"},
      {"b_h_range.ies", ":8: horizontal angles run from 0 to 100; type C allows 0, 0-90, 0-180, 90-270 or 0-360"},
      {"b_type4.ies", ":5: photometric type 4; known are 1 (C), 2 (B), 3 (A)"},
      {"b_tilt_traversal.ies", ":4: the tilt file \"../../../../etc/passwd\" must be a plain file name"},
      {"b_tilt_missing.ies", ":4: tilt file \"NOSUCH.TLT\" is not beside the photometric file"},
      {"b_all_zero.ies", ": every candela value is 0, the luminaire gives no light"},
      {"b_decimal_comma.ies",
       ":7: vertical angles must rise: 0 follows 30 (an IES file uses \".\" for decimals; \",\" separates values)"},
      {"b_unit_word.ies", ":6: \"50W\" is not a number (input watts)"},
      {"b_ldt_truncated.ldt", ": 44 candela values are announced (11 vertical x 4 C planes), the file ends after 37"},
      {"b_ldt_mc_wrong.ldt", ":55: C angles must rise: 0 follows 330 (line 4 announces 24 C planes)"},
      {"b_ldt_isym7.ldt", ":3: symmetry 7; known are 0-4"},
      {"b_ldt_line_missing.ldt", ":27: \"LED\" is not a number (number of lamps); is a line missing above?"},
      {"b_ldt_flux0.ldt", ": lamp flux 0 of set 1, so cd per 1000 lm cannot be scaled; give lm="},
      {"b_ldt_is_ies.ldt", ":4: the line \"TILT=NONE\" says that this is an IES LM-63 file"}};
  for (const BadFile& bad : files) {
    const std::string path = photometric_file(bad.file).string();
    try {
      read_photometry(path);
      FAIL_CHECK(path << " is accepted");
    } catch (const InputError& error) {
      check_message(error.what(), path + bad.words, bad.words);
    }
  }
}

TEST_CASE("bad photometric files of other authors are refused") {
  for (const TableRow& row : rows_of(foreign_luminaires() / "SOURCES.tsv")) {
    if (row.at("kind") != "reject") continue;
    INFO(row.at("path"));
    CHECK_THROWS_AS(read_photometry(row.at("path")), InputError);
  }
}

TEST_CASE("every number of an IES file is checked") {
  const std::vector<std::pair<std::string, std::string>> cases{
      {with(ies, "1 -1 1 4", "1.5 -1 1 4"), ":5: the number of lamps is 1.5. Allowed: a whole number"},
      {with(ies, "1 -1 1 4", "-1 -1 1 4"), ":5: the number of lamps is -1; at least 0"},
      {with(ies, "1 -1 1 4", "1 x 1 4"), ":5: \"x\" is not a number (lumens per lamp)"},
      {with(ies, "1 -1 1 4", "1 -1 0 4"), ":5: candela multiplier 0 must be above 0"},
      {with(ies, "1 -1 1 4", "1 -1 -1 4"), ":5: candela multiplier -1 must be above 0"},
      {with(ies, "1 -1 1 4", "1 -1 inf 4"), ":5: \"inf\" is not a number (candela multiplier)"},
      {with(ies, "1 -1 1 4", "1 -1 1e999 4"), ":5: \"1e999\" is not a number"},
      {with(ies, "1 -1 1 4", "1 -1 0x1 4"), ":5: \"0x1\" is not a number"},
      {with(ies, "1 -1 1 4", "1 -1 1 1"), ":5: the number of vertical angles is 1; at least 2 are needed"},
      {with(ies, "1 4 2 1 2", "1 4 0 1 2"), ":5: the number of horizontal angles is 0; at least 1 is needed"},
      {with(ies, "1 4 2 1 2", "1 20000 20000 1 2"),
       ":5: 20000 vertical x 20000 horizontal angles are 400000000 values"},
      {with(ies, "1 4 2 1 2", "1 4 2 1 3"), ":5: units type 3; 1 is feet, 2 is metres"},
      {with(ies, "2 0 0 0", "2 0 0 1e5"), ":5: the height of the opening is 100000 m. Allowed: up to 10000 m"},
      {with(ies, "1 1 50", "0 1 50"), ":6: ballast factor 0 must be above 0"},
      {with(ies, "0 30 60 90\n", "0 30 60 190\n"), ":7: a vertical angle is 190°. Allowed: 0 to 180°"},
      {with(ies, "0 30 60 90\n", "0 30 60 60\n"), ":7: vertical angles must rise: 60 follows 60"},
      {with(ies, "\n0 90\n", "\n0 91\n"), ":8: horizontal angles run from 0 to 91"},
      {with(ies, "\n0 90\n", "\n45 90\n"), ":8: horizontal angles run from 45 to 90"},
      {with(ies, "\n0 90\n", "\n0 150\n"), ":8: horizontal angles run from 0 to 150"},
      {with(ies, "500", "-10"),
       ":9: a candela value is -10. Allowed: 0 or more, and down to -1 % of the maximum (470)"},
      {with(ies, "1 -1 1 4", "1 -1 1e14 4"), ": the maximum is 5e+16 cd (table 500 times factors 1e+14)"},
      {with(ies, "4 2 1 2", "4 1 2 2"), ":8: 1 horizontal angle; type B needs 2 or more"},
      {with(ies, "4 2 1 2", "4 2 2 2").replace(0, 0, ""), "accepted"},
      {with(ies, "TILT=NONE", "TILT="), ":4: TILT= has no value"},
      {with(ies, "TILT=NONE", "TILT=lamp.tlt"),
       ":4: the tilt file \"lamp.tlt\" cannot be read: this photometric file is embedded"},
      {with(ies, "TILT=NONE", "TILT=INCLUDE\n4 1 0 1"), ":5: the lamp-to-luminaire geometry of TILT is 4; at most 3"},
      {with(ies, "TILT=NONE", "TILT=INCLUDE\n1\n2\n0 90\n1 -1"), ":8: a TILT factor is -1. Allowed: 0 or more"},
      {with(ies, "TILT=NONE", "TILT=INCLUDE\n1\n2\n90 0\n1 1"), ":7: TILT angles must rise: 0 follows 90"},
      {ies.substr(0, ies.find("1 -1")), ": the file ends where the number of lamps should follow"},
      {ies.substr(0, ies.find("\n0 90")), ": the file ends where the horizontal angle should follow"}};
  for (const auto& [content, words] : cases) {
    const std::string message = fault_of(content, "lamp.ies");
    INFO(words);
    if (words == "accepted") {
      CHECK(message == words);
    } else {
      check_message(message, "lamp.ies" + words, words);
    }
  }
  // Of versions with a ballast-lamp factor.
  check_message(fault_of(with(with(ies, "IESNA:LM-63-2002", "IESNA91"), "1 1 50", "1 0 50"), "lamp.ies"), "lamp.ies:6",
                "ballast-lamp photometric factor 0 must be above 0");
}

TEST_CASE("every number of a EULUMDAT file is checked") {
  REQUIRE(fault_of(ldt, "lamp.ldt") == "accepted");
  const std::vector<std::pair<std::string, std::string>> cases{
      {with_line(ldt, 2, "9"), ":2: the type of luminaire is 9; at most 3"},
      {with_line(ldt, 3, "2.5"), ":3: symmetry 2.5; known are 0-4"},
      {with_line(ldt, 4, "9"), ":4: symmetry 4 needs a number of C planes divisible by 4, found 9"},
      {with_line(ldt, 4, "30000"), ":4: the number of C planes is 30000; at most 20000"},
      {with_line(ldt, 6, "1"), ":6: the number of angles per plane is 1; at least 2 are needed"},
      {with_line(ldt, 13, ""),
       ":13: an empty line is not a number (length of the luminaire); is a line missing above?"},
      {with_line(ldt, 16, "-5"), ":16: the length of the luminous area is -5 mm. Allowed: 0 to"},
      {with_line(ldt, 24, "0"), ":24: conversion factor 0 must be above 0"},
      {with_line(ldt, 26, "0"), ": "},
      {with_line(ldt, 26, "101"), ":26: the number of lamp sets is 101; at most 100"},
      {with_line(ldt, 27, "LED"), ":27: \"LED\" is not a number (number of lamps)"},
      {with_line(ldt, 29, "1.000,5"), ":29: \"1.000,5\" is not a number (flux of the lamps)"},
      {with_line(ldt, 29, "-5"), ": lamp flux -5 of set 1, so cd per 1000 lm cannot be scaled"},
      {with_line(ldt, 44, "95"), ": symmetry 4 needs planes from C0 to C90, found C0 to C95"},
      {with_line(ldt, 48, "0"), ":48: vertical angles must rise: 0 follows 0 (line 6 announces 3 angles per plane)"},
      {with_line(ldt, 49, "190"), ":49: a vertical angle is 190°. Allowed: 0 to 180°"},
      {with_line(ldt, 55, "nan"), ":55: \"nan\" is not a number (candela)"}};
  for (const auto& [content, words] : cases) {
    const std::string message = fault_of(content, "lamp.ldt");
    INFO(words);
    check_message(message, "lamp.ldt", words);
  }
  // Planes that do not cover the turn, and all of them where the first one is not the first of the symmetry.
  std::string gap = with_line(with_line(ldt, 3, "0"), 46, "200");
  gap += "300\n190\n90\n300\n190\n90\n";
  check_message(fault_of(gap, "lamp.ldt"), "lamp.ldt",
                "the C angles run from 0 to 200°; symmetry 0 needs planes all round");
  std::string all = with_line(ldt, 3, "3");
  all += "300\n190\n90\n300\n190\n90\n";
  check_message(fault_of(all, "lamp.ldt"), "lamp.ldt", "symmetry 3, but all 4 C planes are written");
  check_message(fault_of(with_line(with_line(ldt, 3, "2"), 4, "3"), "lamp.ldt"), "lamp.ldt",
                "symmetry 2 needs a number of C planes divisible by 2, found 3");
}

TEST_CASE("other formats are refused with what to do") {
  check_message(fault_of("", "lamp.ies"), "lamp.ies: ", "the file is empty");
  check_message(fault_of(" \r\n \x1A", "lamp.ies"), "lamp.ies: ", "the file is empty");
  check_message(fault_of("PK\3\4...", "lamp.gldf"),
                "lamp.gldf: ", "this is a zip file (GLDF?). Take the .ldt or .ies file");
  check_message(fault_of("\xEF\xBB\xBF<?xml version=\"1.0\"?><LuminaireOpticalData>", "lamp.xml"),
                "lamp.xml: ", "this is XML (TM-33");
  check_message(fault_of(std::string("1\0\0", 3), "lamp.ies"), "lamp.ies ", "is not text");
  check_message(fault_of("milk\nbread\n", "list"), "list: ", "no line starts with \"TILT=\"");
  check_message(fault_of("maker\nx\n", "lamp.ldt"), "lamp.ldt:2", "\"x\" is not a number (type of luminaire)");
  check_message(fault_of(ldt, "lamp.ies"), "lamp.ies: ", "lines 2 to 7 say that this is a EULUMDAT file");
  check_message(fault_of(std::string((std::size_t{16} << 20) + 1, ' '), "lamp.ies"),
                "lamp.ies: ", "the file has 16777217 bytes; at most 16777216 are read");
  CHECK_THROWS_WITH(read_photometry("no/such.ies"), ContainsSubstring("Cannot read no/such.ies (No such file"));
  CHECK_THROWS_WITH(read_photometry("/"), ContainsSubstring("it is a folder"));
  // Names from elsewhere are shown, not acted on.
  CHECK(fault_of("", "a\x1B[2Jb\n.ies").find("a\\u001b[2Jb\\u000a.ies: ") == 0);
}

TEST_CASE("a EULUMDAT file without flux is relative if its flux is given elsewhere") {
  PhotometryOptions options;
  options.needs_flux = false;
  const Photometry flux0 = parse_photometry(with_line(ldt, 29, "0"), "lamp.ldt", options);
  CHECK(flux0.factor == 1.0);
  CHECK(flux0.candela->peak().candela == 300.0);
  CHECK(!flux0.lamp_lm);
  CHECK(!flux0.stated_lm);
  // With a flux the options change nothing.
  CHECK(parse_photometry(ldt, "lamp.ldt", options).factor == 1.0 * 1000.0 / 1000.0);
}
