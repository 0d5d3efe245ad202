#include "photometry/ies.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "base/contained_path.hpp"
#include "base/message.hpp"
#include "base/read_file.hpp"
#include "lichtmc/visible_text.hpp"
#include "photometry/file_lines.hpp"
#include "photometry/measured_values.hpp"
#include "photometry/numbers.hpp"

namespace lichtmc {

namespace {

constexpr double metres_per_foot = 0.3048;

// Four records: geometry of the lamp, number of angles, angles, factors.
void read_tilt_factors(NumberStream& numbers, Photometry& photometry) {
  const long geometry = numbers.whole("lamp-to-luminaire geometry of TILT", 1, 3);
  const auto count = static_cast<std::size_t>(numbers.whole("number of TILT angles", 1, photometry_limits::angles));
  read_angles(numbers, count, "TILT", -360.0, 360.0, "(list them in their order)");
  double least = 0.0;
  double greatest = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double factor = numbers.number("TILT factor");
    if (factor < 0.0)
      numbers.origin().refuse(numbers.line(), "a TILT factor is " + to_text(factor) + ". Allowed: 0 or more.");
    least = k == 0 ? factor : std::min(least, factor);
    greatest = k == 0 ? factor : std::max(greatest, factor);
  }
  photometry.tilt_factors = {least, greatest};
  if (least == 1.0 && greatest == 1.0) return;
  photometry.warnings.push_back(
      "TILT factors from " + to_text(least) + " to " + to_text(greatest) + " (lamp geometry " +
      std::to_string(geometry) +
      ") are not applied: the candela are those of the position in which the luminaire was measured. Scale its flux if "
      "its lamp burns in another position.");
}

void read_tilt_file(const TiltLine& tilt, const Origin& origin, const std::optional<std::filesystem::path>& folder,
                    Photometry& photometry) {
  const std::string name(tilt.value);
  if (name.find_first_of("/\\:") != std::string::npos || name == "." || name == "..")
    origin.refuse(tilt.number, "the tilt file " + in_double_quotes(name) +
                                   " must be a plain file name, of a file beside the photometric file. Write TILT=NONE "
                                   "if there is none.");
  const std::string remedy = " Put it there, or write TILT=NONE: TILT factors are not applied.";
  if (!folder)
    origin.refuse(tilt.number,
                  "the tilt file " + in_double_quotes(name) +
                      " cannot be read: this photometric file is embedded in another one. Write TILT=NONE: "
                      "TILT factors are not applied.");
  const ContainedPath place = path_within(*folder, name, false);
  if (!place.fault.empty())
    origin.refuse(tilt.number, "the tilt file " + in_double_quotes(name) + " must be a plain file name (" +
                                   place.fault + "). Write TILT=NONE if there is none.");
  const FileContent content = read_regular_file(place.path, std::uint64_t{1} << 20);
  if (content.missing)
    origin.refuse(tilt.number, "tilt file " + in_double_quotes(name) + " is not beside the photometric file." + remedy);
  if (!content.fault.empty())
    origin.refuse(tilt.number,
                  "the tilt file " + in_double_quotes(name) + " cannot be read (" + content.fault + ")." + remedy);
  const Origin tilt_origin{place.path.string()};
  NumberStream numbers(content.bytes, 1, tilt_origin, photometry.notes);
  read_tilt_factors(numbers, photometry);
}

void read_tilt(const TiltLine& tilt, const Origin& origin, const std::optional<std::filesystem::path>& folder,
               NumberStream& numbers, Photometry& photometry) {
  if (!tilt.line.starts_with("TILT="))
    photometry.notes.push_back("Line " + std::to_string(tilt.number) + " reads " +
                               in_double_quotes(without_blanks(tilt.line)) +
                               "; the standard writes TILT= in capitals, without blanks.");
  if (tilt.value.empty())
    origin.refuse(tilt.number, "TILT= has no value. Write TILT=NONE, TILT=INCLUDE or TILT= and the name of a file.");
  if (same_word(tilt.value, "NONE")) return;
  if (same_word(tilt.value, "INCLUDE"))
    read_tilt_factors(numbers, photometry);
  else
    read_tilt_file(tilt, origin, folder, photometry);
}

double positive(NumberStream& numbers, std::string_view what) {
  const double value = numbers.number(what);
  if (!(value > 0.0))
    numbers.origin().refuse(numbers.line(), std::string(what) + " " + to_text(value) + " must be above 0. Correct it.");
  return value;
}

// The ten numbers behind TILT.
struct IesHead {
  double lumens_per_lamp = 0.0;
  long lamps = 0;
  std::size_t vertical = 0;
  std::size_t horizontal = 0;
  PhotometricType type = PhotometricType::c;
  double width_m = 0.0;
  double length_m = 0.0;
  double height_m = 0.0;
};

double opening_size(NumberStream& numbers, std::string_view what, double unit_m) {
  constexpr double largest_m = 1e4;
  const double size = numbers.number(what) * unit_m;
  if (!(std::abs(size) <= largest_m))
    numbers.origin().refuse(numbers.line(), "the " + std::string(what) + " is " + rounded(size, 4) +
                                                " m. Allowed: up to " + decimal(largest_m, 0) +
                                                " m. Correct it, or the units type.");
  return size;
}

IesHead read_ies_head(NumberStream& numbers, Photometry& photometry) {
  IesHead head;
  head.lamps = numbers.whole("number of lamps", 0, 1'000'000);
  head.lumens_per_lamp = numbers.number("lumens per lamp");
  photometry.multiplier = positive(numbers, "candela multiplier");
  head.vertical = static_cast<std::size_t>(numbers.whole("number of vertical angles", 2, photometry_limits::angles));
  head.horizontal =
      static_cast<std::size_t>(numbers.whole("number of horizontal angles", 1, photometry_limits::angles));
  check_size(numbers.origin(), numbers.line(), head.vertical, head.horizontal);
  const double type = numbers.number("photometric type");
  if (type == 1.0)
    head.type = PhotometricType::c;
  else if (type == 2.0)
    head.type = PhotometricType::b;
  else if (type == 3.0)
    head.type = PhotometricType::a;
  else
    numbers.origin().refuse(numbers.line(),
                            "photometric type " + to_text(type) + "; known are 1 (C), 2 (B), 3 (A). Correct it.");
  const double units = numbers.number("units type");
  if (units != 1.0 && units != 2.0)
    numbers.origin().refuse(numbers.line(), "units type " + to_text(units) + "; 1 is feet, 2 is metres. Correct it.");
  const double unit_m = units == 1.0 ? metres_per_foot : 1.0;
  head.width_m = opening_size(numbers, "width of the opening", unit_m);
  head.length_m = opening_size(numbers, "length of the opening", unit_m);
  head.height_m = opening_size(numbers, "height of the opening", unit_m);
  return head;
}

// Ballast factor, a number whose meaning depends on the version, and the input power.
void read_ballast(NumberStream& numbers, IesVersion version, Photometry& photometry) {
  photometry.ballast = positive(numbers, "ballast factor");
  if (version <= IesVersion::lm_63_1991) {
    photometry.ballast_lamp = positive(numbers, "ballast-lamp photometric factor");
  } else {
    numbers.number(version == IesVersion::lm_63_2019 ? "file generation type" : "number for future use");
  }
  photometry.watts = numbers.number("input watts");
  if (photometry.watts < 0.0) {
    photometry.notes.push_back("Line " + std::to_string(numbers.line()) + ": the input power is " +
                               to_text(photometry.watts) + " W; it is taken as not stated.");
    photometry.watts = 0.0;
  }
}

void set_lamps(const IesHead& head, Photometry& photometry) {
  LampSet lamps;
  lamps.lamps = static_cast<int>(head.lamps);
  lamps.type = text_of_keyword(photometry, "LAMP");
  if (lamps.type.empty()) lamps.type = text_of_keyword(photometry, "LAMPCAT");
  lamps.colour = text_of_keyword(photometry, "_LAMPCOLOUR");
  lamps.rendering_index = text_of_keyword(photometry, "_LAMPRENDERING");
  lamps.watts = photometry.watts;
  photometry.absolute = head.lumens_per_lamp < 0.0;
  const double lumens = std::abs(head.lumens_per_lamp) * static_cast<double>(head.lamps);
  if (!photometry.absolute) {
    lamps.flux_lm = lumens;
    if (lumens > 0.0) photometry.lamp_lm = lumens;
  } else if (head.lumens_per_lamp != -1.0) {
    photometry.stated_lm = lumens;
  }
  photometry.lamp_sets = {lamps};
}

// Words of makers, who state the flux of luminaires measured absolutely in them.
void compare_flux(Photometry& photometry) {
  std::string where = "lumens per lamp";
  for (const char* keyword : {"_ABSOLUTELUMENS", "_TOTALLUMINAIRELUMENS"}) {
    if (photometry.stated_lm || !photometry.absolute) break;
    const std::string text = text_of_keyword(photometry, keyword);
    const std::optional<double> lumens = number_of(std::string_view(text).substr(0, text.find_first_of(" \t")));
    if (!lumens || !(*lumens > 0.0)) continue;
    photometry.stated_lm = lumens;
    where = keyword;
  }
  compare_stated_flux(photometry, where);
}

// Unit of the intensities: "cd" unless the file names another one.
std::string intensity_unit(const Photometry& photometry) {
  const std::string unit = text_of_keyword(photometry, "_INTENSITYUNITS");
  for (const char* candela : {"", "cd", "candela", "candelas"}) {
    if (same_word(unit, candela)) return "cd";
  }
  return unit;
}

CandelaTable::Grid read_angles_of(NumberStream& numbers, const IesHead& head) {
  CandelaTable::Grid grid;
  grid.type = head.type;
  const bool type_c = head.type == PhotometricType::c;
  const std::string hint = "(an IES file uses \".\" for decimals; \",\" separates values)";
  grid.vertical_deg =
      read_angles(numbers, head.vertical, "vertical", type_c ? 0.0 : -90.0, type_c ? 180.0 : 90.0, hint);
  grid.horizontal_deg =
      read_angles(numbers, head.horizontal, "horizontal", type_c ? 0.0 : -180.0, type_c ? 360.0 : 180.0, hint);
  return grid;
}

}  // namespace

Photometry parse_ies(const TiltLine& tilt, const Origin& origin, const PhotometryOptions& options,
                     const std::optional<std::filesystem::path>& folder) {
  if (options.lamp_set != 1)
    origin.refuse("lamp set " + std::to_string(options.lamp_set) +
                  " is asked for; an IES file has one set of lamps. Leave the option away.");
  Photometry photometry;
  photometry.source = origin.source;
  photometry.format = PhotometryFormat::ies;
  const IesVersion version = read_ies_keywords(tilt.header, photometry);
  photometry.intensity_unit = intensity_unit(photometry);

  NumberStream numbers(tilt.rest, tilt.number + 1, origin, photometry.notes);
  read_tilt(tilt, origin, folder, numbers, photometry);
  const IesHead head = read_ies_head(numbers, photometry);
  photometry.opening = ies_opening(version, head.width_m, head.length_m, head.height_m, photometry.warnings);
  read_ballast(numbers, version, photometry);
  set_lamps(head, photometry);

  CandelaTable::Grid grid = read_angles_of(numbers, head);
  const std::size_t angles_line = numbers.line();
  MeasuredValues table = read_values(numbers, head.vertical, head.horizontal, "horizontal angles");
  const std::size_t more = numbers.skip_all();
  if (more > 0)
    photometry.warnings.push_back(to_text(more, "value") + (more == 1 ? " follows" : " follow") +
                                  " after the candela table and " + (more == 1 ? "does" : "do") + " not count.");
  set_ies_symmetry(origin, angles_line, grid, table, photometry.warnings);
  grid.flip_horizontal = options.flip_horizontal && head.type != PhotometricType::c;
  set_candela(photometry, origin, std::move(grid), std::move(table),
              photometry.multiplier * photometry.ballast * photometry.ballast_lamp);
  compare_flux(photometry);
  return photometry;
}

}  // namespace lichtmc
