#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/message.hpp"
#include "photometry/ies.hpp"
#include "photometry/measured_values.hpp"
#include "photometry/numbers.hpp"

namespace lichtmc {

namespace {

struct EulumdatHead {
  long symmetry = 0;
  std::size_t planes = 0;  // of the whole turn
  std::size_t vertical = 0;
};

EulumdatHead read_eulumdat_head(NumberLines& lines, Photometry& photometry) {
  EulumdatHead head;
  const auto keep = [&photometry](const char* name, const std::string& text) {
    photometry.texts.emplace_back(name, text);
    return text;
  };
  photometry.manufacturer = keep("company", lines.text("company"));
  lines.whole("type of luminaire", 0, 3);
  const double symmetry = lines.number("symmetry");
  if (!(symmetry >= 0.0 && symmetry <= 4.0) || symmetry != std::floor(symmetry))
    lines.origin().refuse(lines.line(), "symmetry " + to_text(symmetry) + "; known are 0-4. Correct it.");
  head.symmetry = static_cast<long>(symmetry);
  head.planes = static_cast<std::size_t>(lines.whole("number of C planes", 1, photometry_limits::angles));
  const std::size_t divisor = head.symmetry < 2 ? 1 : (head.symmetry == 2 ? 2 : 4);
  if (head.planes % divisor != 0)
    lines.origin().refuse(lines.line(), "symmetry " + std::to_string(head.symmetry) +
                                            " needs a number of C planes divisible by " + std::to_string(divisor) +
                                            ", found " + std::to_string(head.planes) + ". Correct lines 3 and 4.");
  lines.number("distance of C planes");
  head.vertical = static_cast<std::size_t>(lines.whole("number of angles per plane", 2, photometry_limits::angles));
  lines.number("distance of angles");
  photometry.test = keep("report", lines.text("report"));
  photometry.luminaire = keep("luminaire", lines.text("name of the luminaire"));
  photometry.catalogue = keep("number", lines.text("number of the luminaire"));
  keep("file", lines.text("file name"));
  keep("date", lines.text("date"));
  return head;
}

double size_in_m(NumberLines& lines, std::string_view what) {
  constexpr double largest_m = 1e4;
  const double size = lines.number(what) / 1000.0;
  if (!(size >= 0.0 && size <= largest_m))
    lines.origin().refuse(lines.line(), "the " + std::string(what) + " is " + decimal(size * 1000.0, 3) +
                                            " mm. Allowed: 0 to " + decimal(largest_m * 1000.0, 0) +
                                            " mm. Correct it.");
  return size;
}

// Sizes of the luminaire, then of its luminous area: length along C90, width along C0; width 0: round.
LuminousOpening read_opening(NumberLines& lines, std::vector<std::string>& warnings) {
  for (const char* what : {"length of the luminaire", "width of the luminaire", "height of the luminaire"})
    size_in_m(lines, what);
  const double length = size_in_m(lines, "length of the luminous area");
  const double width = size_in_m(lines, "width of the luminous area");
  double height = 0.0;
  for (const char* what :
       {"luminous height at C0", "luminous height at C90", "luminous height at C180", "luminous height at C270"})
    height = std::max(height, size_in_m(lines, what));
  if (length == 0.0 && width == 0.0) {
    if (height > 0.0)
      warnings.push_back("The luminous area has a height of " + to_text(height) +
                         " m, but no length and width; it is taken as a point.");
    return {};
  }
  if (width == 0.0) return {height > 0.0 ? OpeningForm::cylinder : OpeningForm::ellipse, {length, length, height}};
  return {height > 0.0 ? OpeningForm::box : OpeningForm::rectangle, {width, length, height}};
}

// A share in %, or none if the number cannot be one.
std::optional<double> read_share(NumberLines& lines, const std::string& what, double most,
                                 std::vector<std::string>& notes) {
  const double share = lines.number(what);
  if (share >= 0.0 && share <= most) return share / 100.0;
  notes.push_back("Line " + std::to_string(lines.line()) + ": the " + what + " is " + to_text(share) +
                  " %; it is taken as not stated.");
  return std::nullopt;
}

void read_lamp_sets(NumberLines& lines, const PhotometryOptions& options, Photometry& photometry) {
  constexpr long most_sets = 100;
  const auto count = static_cast<std::size_t>(lines.whole("number of lamp sets", 0, most_sets));
  bool absolute = false;
  for (std::size_t k = 0; k < count; ++k) {
    LampSet set;
    const long lamps = lines.whole("number of lamps", -1'000'000, 1'000'000);
    set.lamps = static_cast<int>(std::abs(lamps));
    set.type = lines.text("type of lamps");
    set.flux_lm = lines.number("flux of the lamps");
    set.colour = lines.text("colour of the lamps");
    set.rendering_index = lines.text("colour rendering of the lamps");
    set.watts = lines.number("input watts");
    if (k + 1 == options.lamp_set) absolute = lamps < 0;
    photometry.lamp_sets.push_back(std::move(set));
  }
  if (options.lamp_set < 1 || options.lamp_set > std::max<std::size_t>(count, 1))
    lines.origin().refuse("lamp set " + std::to_string(options.lamp_set) + " is asked for; the file has " +
                          to_text(count, "set") + ". Ask for one of them, counted from 1.");
  photometry.absolute = absolute;
  if (photometry.lamp_sets.empty()) photometry.lamp_sets.emplace_back();
  photometry.lamp_set = options.lamp_set - 1;
  LampSet& chosen = photometry.lamp_sets[photometry.lamp_set];
  if (!(chosen.flux_lm > 0.0) && options.needs_flux)
    lines.origin().refuse(
        (count == 0 ? std::string("no lamp set")
                    : "lamp flux " + to_text(chosen.flux_lm) + " of set " + std::to_string(options.lamp_set)) +
        ", so cd per 1000 lm cannot be scaled; give lm=… (the luminaire's flux in lm).");
  if (chosen.flux_lm > 0.0) photometry.lamp_lm = chosen.flux_lm;
  photometry.watts = std::max(chosen.watts, 0.0);
}

// The planes of which a file has values, by its symmetry: angles in the order of the values.
std::vector<double> written_planes(const Origin& origin, const EulumdatHead& head, const std::vector<double>& planes,
                                   std::vector<std::string>& warnings, PhotometricSymmetry& symmetry) {
  const std::size_t n = head.planes;
  const auto require_angles = [&](double first, double found_first, double last, double found_last) {
    if (first != found_first || last != found_last)
      origin.refuse("symmetry " + std::to_string(head.symmetry) + " needs planes from C" + to_text(first) + " to C" +
                    to_text(last) + ", found C" + to_text(found_first) + " to C" + to_text(found_last) +
                    ". Correct the C angles or the symmetry.");
  };
  const auto upto = [&planes](std::size_t last) {
    return std::vector<double>(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  };
  switch (head.symmetry) {
    case 1:
      symmetry = PhotometricSymmetry::rotational;
      return {0.0};
    case 2:
      require_angles(0.0, planes[0], 180.0, planes[n / 2]);
      symmetry = PhotometricSymmetry::c0_c180;
      return upto(n / 2);
    case 3: {
      // From C270 through C0 to C90, as −90 … 90°.
      require_angles(270.0, planes[3 * n / 4], 90.0, planes[n / 4]);
      symmetry = PhotometricSymmetry::c90_c270;
      std::vector<double> turned;
      for (std::size_t k = 3 * n / 4; k < n; ++k) turned.push_back(planes[k] - 360.0);
      turned.insert(turned.end(), planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(n / 4) + 1);
      return turned;
    }
    case 4:
      require_angles(0.0, planes[0], 90.0, planes[n / 4]);
      symmetry = PhotometricSymmetry::quadrants;
      return upto(n / 4);
    default:
      break;
  }
  if (n == 1) {
    warnings.push_back("Symmetry 0 with one C plane; the luminaire is taken as rotationally symmetric.");
    symmetry = PhotometricSymmetry::rotational;
    return {0.0};
  }
  symmetry = PhotometricSymmetry::none;
  return planes;
}

// Without symmetry: repeats the first plane after a whole turn, if the file does not.
void close_turn(const Origin& origin, CandelaTable::Grid& grid, MeasuredValues& table,
                std::vector<std::string>& warnings) {
  const double first = grid.horizontal_deg.front();
  const double last = grid.horizontal_deg.back();
  if (last == first + 360.0) {
    compare_seam(grid, table, warnings);
    return;
  }
  if (first + 360.0 - last > widest_step(grid.horizontal_deg) + least_step_deg)
    origin.refuse("the C angles run from " + to_text(first) + " to " + to_text(last) +
                  "°; symmetry 0 needs planes all round. Correct the C angles or the symmetry.");
  repeat_first_plane(grid, table);
}

// Values behind the table: with symmetries some programs write all planes.
void note_more_values(const Origin& origin, const EulumdatHead& head, std::size_t planes, std::size_t more,
                      std::vector<std::string>& warnings) {
  if (more == 0) return;
  const bool all_planes = head.symmetry > 0 && more == (head.planes - planes) * head.vertical;
  if (all_planes && head.symmetry == 3)
    origin.refuse("symmetry 3, but all " + std::to_string(head.planes) +
                  " C planes are written: it is not clear which one is the first. Write those from C270 through C0 to "
                  "C90, or symmetry 0.");
  warnings.push_back(to_text(more, "value") + (more == 1 ? " follows" : " follow") + " after the table and " +
                     (more == 1 ? "does" : "do") + " not count" +
                     (all_planes
                          ? ": all " + std::to_string(head.planes) + " C planes are written, of which symmetry " +
                                std::to_string(head.symmetry) + " needs the first " + std::to_string(planes)
                          : std::string()) +
                     ".");
}

// Lines 13 to the direct ratios: sizes, fluxes, lamps.
void read_luminaire(NumberLines& lines, const PhotometryOptions& options, Photometry& photometry) {
  photometry.opening = read_opening(lines, photometry.warnings);
  photometry.downward_share = read_share(lines, "downward flux fraction", 100.0, photometry.notes);
  photometry.output_ratio = read_share(lines, "light output ratio", 1000.0, photometry.notes);
  photometry.conversion = lines.number("conversion factor");
  const std::size_t conversion_line = lines.line();
  lines.number("tilt of the luminaire during measurement");
  read_lamp_sets(lines, options, photometry);
  // Behind the lamps: if a line is missing above, their texts tell it.
  if (!(photometry.conversion > 0.0))
    lines.origin().refuse(conversion_line, "conversion factor " + to_text(photometry.conversion) +
                                               " must be above 0. Write 1 if there is none.");
  for (int k = 0; k < 10; ++k) lines.number("direct ratio");
}

}  // namespace

Photometry parse_eulumdat(std::string_view text, const Origin& origin, const PhotometryOptions& options) {
  Photometry photometry;
  photometry.source = origin.source;
  photometry.format = PhotometryFormat::eulumdat;
  photometry.version = "EULUMDAT";
  photometry.intensity_unit = "cd";
  NumberLines lines(text, origin, photometry.notes);
  const EulumdatHead head = read_eulumdat_head(lines, photometry);
  read_luminaire(lines, options, photometry);

  lines.skip_empty_lines();
  const std::vector<double> all_planes =
      read_angles(lines, head.planes, "C", 0.0, 360.0,
                  "(line 4 announces " + to_text(head.planes, "C plane") + "). Correct the number or the angles");
  CandelaTable::Grid grid;
  grid.vertical_deg = read_angles(
      lines, head.vertical, "vertical", 0.0, 180.0,
      "(line 6 announces " + to_text(head.vertical, "angle") + " per plane). Correct the number or the angles");
  grid.horizontal_deg = written_planes(origin, head, all_planes, photometry.warnings, grid.symmetry);
  const std::size_t written = grid.horizontal_deg.size();
  check_size(origin, 0, head.vertical, written);
  MeasuredValues table = read_values(lines, head.vertical, written, "C planes");
  note_more_values(origin, head, written, lines.skip_all(), photometry.warnings);
  if (grid.symmetry == PhotometricSymmetry::none) close_turn(origin, grid, table, photometry.warnings);

  const double flux = photometry.lamp_lm.value_or(0.0);
  if (flux > 0.0 && photometry.output_ratio.value_or(0.0) > 0.0) photometry.stated_lm = flux * *photometry.output_ratio;
  if (photometry.conversion != 1.0)
    photometry.warnings.push_back("The conversion factor " + to_text(photometry.conversion) +
                                  " multiplies all intensities.");
  set_candela(photometry, origin, std::move(grid), std::move(table),
              flux > 0.0 ? flux / 1000.0 * photometry.conversion : 1.0);
  compare_stated_flux(photometry, "light output ratio times flux of the lamps");
  return photometry;
}

}  // namespace lichtmc
