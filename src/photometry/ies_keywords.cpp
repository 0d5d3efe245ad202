#include <array>
#include <utility>

#include "photometry/file_lines.hpp"
#include "photometry/ies.hpp"
#include "photometry/origin.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t most_header_lines = 10'000;
constexpr std::size_t most_header_bytes = std::size_t{1} << 20;

// Editions by their year, as the first line names them: "IESNA91", "IESNA:LM-63-1995", "IES:LM-63-2019".
struct Edition {
  std::string_view year;
  std::string_view short_year;
  IesVersion version;
};
constexpr std::array<Edition, 5> editions{{
    {"1986", "86", IesVersion::lm_63_1986},
    {"1991", "91", IesVersion::lm_63_1991},
    {"1995", "95", IesVersion::lm_63_1995},
    {"2002", "02", IesVersion::lm_63_2002},
    {"2019", "19", IesVersion::lm_63_2019},
}};

// Sets the version by the first line; false: the line does not name one.
bool read_version(std::string_view line, Photometry& photometry, IesVersion& version) {
  if (!begins_with(line, "IESNA") && !begins_with(line, "IES:")) return false;
  for (const Edition& edition : editions) {
    if (line.find(edition.year) == std::string_view::npos && !line.ends_with(edition.short_year)) continue;
    version = edition.version;
    photometry.version = "LM-63-" + std::string(edition.year);
    return true;
  }
  version = IesVersion::lm_63_2019;
  photometry.version = "LM-63-2019";
  photometry.warnings.push_back("The version " + in_double_quotes(line) +
                                " is not known (known: LM-63-1986 to LM-63-2019); the file is read as LM-63-2019.");
  return true;
}

void read_keyword(std::string_view line, Photometry& photometry) {
  const std::size_t close = line.find(']');
  std::string keyword;
  std::string text;
  if (line.front() == '[' && close != std::string_view::npos) {
    keyword = text_of(line.substr(1, close - 1));
    text = text_of(line.substr(close + 1));
  } else {
    text = text_of(line);  // a label
  }
  if (same_word(keyword, "MORE") && !photometry.texts.empty()) {
    std::string& last = photometry.texts.back().second;
    if (!last.empty() && !text.empty()) last += ' ';
    last += text;
    return;
  }
  photometry.texts.emplace_back(std::move(keyword), std::move(text));
}

}  // namespace

std::optional<TiltLine> find_tilt(std::string_view text) {
  FileLines lines(text);
  std::string_view line;
  while (lines.line() < most_header_lines && text.size() - lines.rest().size() < most_header_bytes &&
         lines.next(line)) {
    const std::string_view word = without_blanks(line);
    if (!begins_with(word, "TILT")) continue;
    const std::string_view behind = without_blanks(word.substr(4));
    if (behind.empty() || behind.front() != '=') continue;
    const auto before = static_cast<std::size_t>(line.data() - text.data());
    return TiltLine{text.substr(0, before), line, without_blanks(behind.substr(1)), lines.line(), lines.rest()};
  }
  return std::nullopt;
}

IesVersion read_ies_keywords(std::string_view header, Photometry& photometry) {
  IesVersion version = IesVersion::lm_63_1986;
  photometry.version = "LM-63-1986";
  FileLines lines(header);
  std::string_view line;
  bool first = true;
  while (lines.next(line)) {
    line = without_blanks(line);
    if (line.empty()) continue;
    const bool is_version = first && read_version(line, photometry, version);
    first = false;
    if (!is_version) read_keyword(line, photometry);
  }
  photometry.manufacturer = text_of_keyword(photometry, "MANUFAC");
  photometry.luminaire = text_of_keyword(photometry, "LUMINAIRE");
  photometry.catalogue = text_of_keyword(photometry, "LUMCAT");
  photometry.test = text_of_keyword(photometry, "TEST");
  // Files of 1986 have labels only.
  if (photometry.luminaire.empty() && !photometry.texts.empty() && photometry.texts.front().first.empty())
    photometry.luminaire = photometry.texts.front().second;
  return version;
}

std::string text_of_keyword(const Photometry& photometry, std::string_view keyword) {
  for (const auto& [name, text] : photometry.texts) {
    if (same_word(name, keyword)) return text;
  }
  return "";
}

}  // namespace lichtmc
