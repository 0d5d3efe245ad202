// Files of IES LM-63, and EULUMDAT files: from their text to a Photometry.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/photometry.hpp"
#include "photometry/measured_values.hpp"
#include "photometry/origin.hpp"

namespace lichtmc {

// The line "TILT=…" of an IES file.
struct TiltLine {
  std::string_view header;  // all before it
  std::string_view line;
  std::string_view value;  // behind "=", without blanks
  std::size_t number = 0;  // of the line
  std::string_view rest;   // all behind it
};
// The first line of a text that begins with "TILT" and "="; none in the first 10 000 lines and 1 MiB.
std::optional<TiltLine> find_tilt(std::string_view text);

// `text` is UTF-8 or of one byte per character.
Photometry parse_ies(const TiltLine& tilt, const Origin& origin, const PhotometryOptions& options,
                     const std::optional<std::filesystem::path>& folder);
Photometry parse_eulumdat(std::string_view text, const Origin& origin, const PhotometryOptions& options);

// Parts of parse_ies().
enum class IesVersion { lm_63_1986, lm_63_1991, lm_63_1995, lm_63_2002, lm_63_2019 };

// Version, keywords and texts of the lines before "TILT=".
IesVersion read_ies_keywords(std::string_view header, Photometry& photometry);
// The text of a keyword, whose case does not matter; empty if there is none.
std::string text_of_keyword(const Photometry& photometry, std::string_view keyword);

// The opening from width, length and height in m, whose signs give the form. Notes unknown signs in `warnings`.
LuminousOpening ies_opening(IesVersion version, double width_m, double length_m, double height_m,
                            std::vector<std::string>& warnings);

// The symmetry of a table from its angles; repeats the plane at 0° at 360° if that is missing. line: of the angles.
void set_ies_symmetry(const Origin& origin, std::size_t line, CandelaTable::Grid& grid, MeasuredValues& table,
                      std::vector<std::string>& warnings);

}  // namespace lichtmc
