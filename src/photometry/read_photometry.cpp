#include <cstddef>
#include <string>
#include <string_view>

#include "base/read_file.hpp"
#include "base/text_encoding.hpp"
#include "lichtmc/visible_text.hpp"
#include "photometry/file_lines.hpp"
#include "photometry/ies.hpp"
#include "photometry/measured_values.hpp"
#include "photometry/numbers.hpp"

namespace lichtmc {

namespace {

bool is_number(std::string_view line) {
  std::string point(without_blanks(line).substr(0, 40));
  if (const std::size_t comma = point.find(','); comma != std::string::npos) point[comma] = '.';
  return number_of(point).has_value();
}

// Lines 2 to 7 of a EULUMDAT file are numbers.
bool looks_like_eulumdat(std::string_view text) {
  FileLines lines(text);
  std::string_view line;
  for (int k = 1; k <= 7; ++k) {
    if (!lines.next(line)) return false;
    if (k > 1 && !is_number(line)) return false;
  }
  return true;
}

// Formats that are known, and not read.
void refuse_other_formats(std::string_view bytes, const Origin& origin) {
  if (bytes.starts_with("PK\3\4")) origin.refuse("this is a zip file (GLDF?). Take the .ldt or .ies file out of it.");
  std::string_view start = bytes.substr(0, 4096);
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  start = without_blanks(start);
  if (start.empty() && bytes.size() <= 4096)
    origin.refuse("the file is empty. Get it anew: an IES LM-63 or EULUMDAT file is needed.");
  if (start.starts_with("<?xml") || start.starts_with("<IES") ||
      start.find("LuminaireOpticalData") != std::string_view::npos)
    origin.refuse(
        "this is XML (TM-33, UNI 11733?), which is not read. Get the .ldt or .ies file of this luminaire from its "
        "maker.");
}

bool has_suffix(std::string_view name, std::string_view suffix) {
  return name.size() > suffix.size() && same_word(name.substr(name.size() - suffix.size()), suffix);
}

}  // namespace

Photometry parse_photometry(std::string_view content, const std::string& source, const PhotometryOptions& options,
                            const std::optional<std::filesystem::path>& folder) {
  const Origin origin{source};
  if (content.size() > photometry_limits::bytes)
    origin.refuse("the file has " + std::to_string(content.size()) + " bytes; at most " +
                  std::to_string(photometry_limits::bytes) + " are read. Use a file with a coarser grid.");
  refuse_other_formats(content, origin);
  const std::string text = utf8_of(content, visible_text(source), "Save it as plain text.");
  const std::optional<TiltLine> tilt = find_tilt(text);
  const bool eulumdat = !tilt && looks_like_eulumdat(text);
  if (tilt && has_suffix(source, ".ldt"))
    origin.refuse(tilt->number, "the line " + in_double_quotes(without_blanks(tilt->line)) +
                                    " says that this is an IES LM-63 file, its name that it is EULUMDAT. Rename it to "
                                    ".ies if it is the right one.");
  if (eulumdat && has_suffix(source, ".ies"))
    origin.refuse(
        "lines 2 to 7 say that this is a EULUMDAT file, its name that it is IES. Rename it to .ldt if it is the "
        "right one.");
  if (tilt || eulumdat || has_suffix(source, ".ldt")) {
    Photometry photometry = tilt ? parse_ies(*tilt, origin, options, folder) : parse_eulumdat(text, origin, options);
    if (!is_utf8(tilt ? tilt->header : std::string_view(text)))
      photometry.notes.emplace_back("Its texts are not UTF-8; they are read as Windows-1252.");
    return photometry;
  }
  origin.refuse(
      "no line starts with \"TILT=\", so this is not an IES LM-63 file; and lines 2 to 7 are not numbers, so it is not "
      "a EULUMDAT file. Give a photometric file of one of these formats.");
}

Photometry read_photometry(const std::filesystem::path& file, const PhotometryOptions& options) {
  const std::string name = file.string();
  const std::string bytes =
      require_regular_file(file, photometry_limits::bytes, visible_text(name), "Give an IES LM-63 or EULUMDAT file.");
  return parse_photometry(bytes, name, options, file.parent_path());
}

}  // namespace lichtmc
