// lichtmc luminaire: the figures and the picture of a photometric file.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/luminaire_figures.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/photometry.hpp"
#include "lichtmc/visible_text.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

namespace {

struct LuminaireCommand {
  std::string file;
  std::string output;
  std::size_t lamp_set = 1;
  bool flip = false;
  bool json = false;
};

void print_row(const char* name, const std::string& text) {
  if (text.empty()) return;
  constexpr std::size_t column = 15;
  std::string start = std::string("  ") + name;
  start.resize(column, ' ');
  std::cout << start << visible_text(text) << '\n';
}

// "12.5", "12"
std::string with_decimals(double value, int decimals) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.*f", decimals, value);
  std::string text = digits;
  if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string percent_text(double share) {
  constexpr double rounding = 1e-9;
  const double value = 100.0 * share;
  if (value > rounding && value < 0.05) return "less than 0.1 %";
  return with_decimals(value, 1) + " %";
}

std::string degrees(double angle) {
  return with_decimals(angle, std::abs(angle) < 10.0 ? 2 : 1) + "°";
}

std::string count_text(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// "37 angles γ, 0° to 180° in steps of 5°"
std::string angles_text(const AngleRange& range, const std::string& noun, const std::string& symbol) {
  const auto exact = [](double angle) { return four_digits(angle) + "°"; };
  const std::string count = count_text(range.count, noun) + " " + symbol + ", ";
  if (range.count == 1) return count + exact(range.from);
  std::string text = count + exact(range.from) + " to " + exact(range.to);
  if (range.count == 2) return text;
  return text + (range.is_even() ? " in steps of " + degrees(range.greatest_step)
                                 : " in steps of " + degrees(range.least_step) + " to " + degrees(range.greatest_step));
}

std::string symmetry_text(PhotometricSymmetry symmetry) {
  switch (symmetry) {
    case PhotometricSymmetry::none:
      return "no symmetry";
    case PhotometricSymmetry::rotational:
      return "rotationally symmetric";
    case PhotometricSymmetry::c0_c180:
      return "symmetric about the plane C0–C180";
    case PhotometricSymmetry::c90_c270:
      return "symmetric about the plane C90–C270";
    case PhotometricSymmetry::quadrants:
      return "symmetric about C0–C180 and C90–C270";
    case PhotometricSymmetry::horizontal:
      return "symmetric in H";
    case PhotometricSymmetry::vertical:
      return "symmetric in V";
    case PhotometricSymmetry::both:
      return "symmetric in H and V";
  }
  return {};
}

// What the luminaire does, for people who have never seen such a file.
std::string first_line(const Photometry& photometry, const LuminaireFigures& figures) {
  const double towards = figures.share_towards_aim;
  constexpr double nearly_all = 0.9995;
  const std::string share = towards >= nearly_all ? "sends all of its light to the side it aims at"
                            : towards <= 1.0 - nearly_all
                                ? "sends all of its light away from the side it aims at"
                                : "sends " + percent_text(towards) + " of its light to the side it aims at";
  const PeakIntensity& peak = photometry.candela->peak();
  const double away = angle_to_aim(photometry, peak.horizontal_deg, peak.vertical_deg);
  const std::string place = away < 1e-6 ? "along this aim"
                                        : degrees(away) + " away from this aim (" +
                                              direction_text(photometry, peak.horizontal_deg, peak.vertical_deg) + ")";
  return std::filesystem::path(photometry.source).filename().string() + ": a luminaire of " +
         four_digits(figures.flux) + " " + figures.flux_unit +
         (photometry.watts > 0.0 ? " and " + four_digits(photometry.watts) + " W" : "") + ". It " + share +
         " and is brightest " + place + ", with " + four_digits(peak.candela) + " " + photometry.intensity_unit + ".";
}

std::string factor_text(const Photometry& photometry) {
  std::string text = four_digits(photometry.factor);
  if (photometry.format == PhotometryFormat::eulumdat) {
    text += " (values are per 1000 lm of the lamps";
    if (photometry.conversion != 1.0) text += "; conversion factor " + four_digits(photometry.conversion);
    return text + ")";
  }
  text += " (candela multiplier " + four_digits(photometry.multiplier) + ", ballast factor " +
          four_digits(photometry.ballast);
  if (photometry.version == "LM-63-1986" || photometry.version == "LM-63-1991")
    text += ", ballast-lamp factor " + four_digits(photometry.ballast_lamp);
  return text + ")";
}

std::string lamps_text(const LampSet& set) {
  std::string text = count_text(static_cast<std::size_t>(std::max(0, set.lamps)), "lamp");
  if (!set.type.empty()) text += " " + set.type;
  if (set.flux_lm > 0.0) text += (set.lamps > 1 ? ", together " : ", ") + four_digits(set.flux_lm) + " lm";
  if (!set.colour.empty()) text += ", " + set.colour;
  if (!set.rendering_index.empty()) text += ", colour rendering " + set.rendering_index;
  if (set.watts > 0.0) text += ", " + four_digits(set.watts) + " W";
  return text;
}

std::string signed_percent(double share) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%+.1f %%", 100.0 * share);
  return digits;
}

std::string flux_text(const Photometry& photometry, const LuminaireFigures& figures) {
  std::string text = four_digits(figures.flux) + " " + figures.flux_unit + ", the integral of the intensity";
  if (photometry.stated_lm) {
    text += "; the file states " + four_digits(*photometry.stated_lm) + " " + figures.flux_unit;
    if (figures.over_stated) text += " (difference " + signed_percent(*figures.over_stated) + ")";
  }
  return text;
}

std::string ratio_text(const Photometry& photometry, const LuminaireFigures& figures) {
  std::string text;
  if (figures.output_ratio) text = percent_text(*figures.output_ratio) + " of the lamps' flux";
  if (photometry.output_ratio)
    text += (text.empty() ? "" : "; ") + std::string("the file states ") + percent_text(*photometry.output_ratio);
  return text;
}

std::string direction_shares(const Photometry& photometry, const LuminaireFigures& figures) {
  std::string text = percent_text(figures.share_towards_aim) + " within 90° of the aim, " +
                     percent_text(1.0 - figures.share_towards_aim) + " behind";
  if (photometry.downward_share) text += "; the file states " + percent_text(*photometry.downward_share);
  return text;
}

std::string zones_text(const LuminaireFigures& figures) {
  std::string text;
  for (const FluxZone& zone : figures.zones)
    text += (text.empty() ? "" : ", ") + degrees(zone.from_deg) + " to " + degrees(zone.to_deg) + ": " +
            four_digits(zone.flux) + " " + figures.flux_unit + " (" + percent_text(zone.flux / figures.flux) + ")";
  return text;
}

// "24.4° (12.2° to either side)", "46.2° (15.6° to 61.8°)", "111.8° (106.2° over 180° to -142°)"
std::string width_text(const BeamWidth& width) {
  if (width.lobes == 0) return "no light";
  if (width.width_deg() >= 360.0) return "360° (all round)";
  std::string range = degrees(width.from_deg) + " to " + degrees(width.to_deg);
  if (std::abs(width.from_deg + width.to_deg) < 1e-3 * width.width_deg())
    range = degrees(width.to_deg) + " to either side";
  if (width.from_deg < -180.0) range = degrees(width.from_deg + 360.0) + " over 180° to " + degrees(width.to_deg);
  if (width.to_deg > 180.0) range = degrees(width.from_deg) + " over 180° to " + degrees(width.to_deg - 360.0);
  if (width.lobes > 1) range += ", one of " + std::to_string(width.lobes) + " lobes";
  return degrees(width.width_deg()) + " (" + range + ")";
}

std::string widths_text(const LuminaireFigures& figures, BeamWidth LuminairePlane::*width, bool rotational) {
  if (rotational) return width_text(figures.planes[0].*width);
  std::string text;
  for (const LuminairePlane& plane : figures.planes)
    text += (text.empty() ? "" : "; ") + plane.name + " " + width_text(plane.*width);
  return text;
}

void print(const Photometry& photometry, const LuminaireFigures& figures) {
  const CandelaTable& table = *photometry.candela;
  const CandelaTable::Grid& grid = table.grid();
  const bool type_c = grid.type == PhotometricType::c;
  const bool rotational = grid.symmetry == PhotometricSymmetry::rotational;
  std::cout << visible_text(first_line(photometry, figures)) << '\n';
  print_row("File", photometry.source + ", " + photometry.version + ", " +
                        (photometry.absolute ? "absolute photometry" : "relative photometry"));
  print_row("Maker", photometry.manufacturer);
  print_row("Luminaire", photometry.luminaire);
  print_row("Catalogue", photometry.catalogue);
  print_row("Test", photometry.test);
  print_row("Type", std::string(name_of(grid.type)) + ", " + symmetry_text(grid.symmetry) +
                        (grid.flip_horizontal ? ", H counts the other way (--flip-h)" : ""));
  print_row("Table", angles_text(figures.vertical, "angle", type_c ? "γ" : "V") + "; " +
                         angles_text(figures.horizontal, type_c ? "plane" : "angle", type_c ? "C" : "H"));
  print_row("Factor", factor_text(photometry));
  for (std::size_t k = 0; k < photometry.lamp_sets.size(); ++k) {
    const std::string number = photometry.lamp_sets.size() > 1 ? "set " + std::to_string(k + 1) + ": " : "";
    const bool used = photometry.lamp_sets.size() > 1 && k == photometry.lamp_set;
    print_row(k == 0 ? "Lamps" : "", number + lamps_text(photometry.lamp_sets[k]) + (used ? " (used)" : ""));
  }
  print_row("Flux", flux_text(photometry, figures));
  print_row("Output ratio", ratio_text(photometry, figures));
  print_row("Directions", direction_shares(photometry, figures));
  print_row("Zones", zones_text(figures));
  if (photometry.watts > 0.0) {
    const std::optional<double> efficacy = photometry.efficacy();
    const bool lumens = efficacy && figures.flux_unit == "lm";
    print_row("Power", four_digits(photometry.watts) + " W" +
                           (lumens ? ", " + four_digits(*efficacy) + " lm/W" : std::string()));
  }
  const PeakIntensity& peak = table.peak();
  print_row("Maximum", four_digits(peak.candela) + " " + photometry.intensity_unit + " at " +
                           direction_text(photometry, peak.horizontal_deg, peak.vertical_deg));
  print_row("Beam angle", "at 50 %: " + widths_text(figures, &LuminairePlane::beam, rotational));
  print_row("Field angle", "at 10 %: " + widths_text(figures, &LuminairePlane::field, rotational));
  const std::string along = along_c0(photometry.opening);
  print_row("Opening", opening_text(photometry.opening) + (along.empty() ? "" : ". " + along));
  if (photometry.intensity_unit != "cd")
    std::cout << "Note: intensities are in " << visible_text(photometry.intensity_unit)
              << ", not in cd. In a room the file gives the shape; give the radiant flux in W as W=…\n";
  for (const std::string& note : photometry.notes) std::cout << "Note: " << visible_text(note) << '\n';
  for (const std::string& warning : photometry.warnings) std::cout << "Warning: " << visible_text(warning) << '\n';
}

void check_output(const std::filesystem::path& output) {
  if (output.extension() != ".svg")
    throw InputError("The picture " + output.string() + " is an SVG file (allowed: a name that ends in .svg). Choose " +
                     "another name for --output.");
  const std::filesystem::path folder = output.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw InputError("The folder " + folder.string() + " of the file " + output.string() +
                     " does not exist. Create it, or choose another file with --output.");
}

void show_luminaire(const LuminaireCommand& command) {
  if (!command.output.empty()) check_output(command.output);
  PhotometryOptions options;
  options.lamp_set = command.lamp_set;
  options.flip_horizontal = command.flip;
  const Photometry photometry = read_photometry(command.file, options);
  if (!command.output.empty()) write_luminaire_svg(photometry, command.output);
  if (command.json) {
    std::cout << luminaire_json(photometry);
  } else {
    print(photometry, luminaire_figures(photometry));
  }
}

}  // namespace

void add_luminaire_command(CLI::App& program, const Invocation& /*invocation*/) {
  CLI::App* command =
      program.add_subcommand("luminaire", "Show a photometric file (IES, EULUMDAT): figures and polar diagram");
  auto options = std::make_shared<LuminaireCommand>();
  command->add_option("FILE", options->file, "IES file (LM-63, .ies) or EULUMDAT file (.ldt)")->required();
  command->add_option("-o,--output", options->output, "Write a picture to this file: polar diagram, false colour")
      ->type_name("FILE.svg");
  command->add_option("--set", options->lamp_set, "Which lamp set of a EULUMDAT file, counted from 1")
      ->type_name("N")
      ->capture_default_str();
  command->add_flag("--flip-h", options->flip, "Types A and B: H counts the other way, as in some files of type B");
  command->add_flag("--json", options->json, "Write the figures as JSON");
  command->footer(
      "Directions: type C by the angle γ to the aim (0: down, if the luminaire is mounted facing down) and the plane "
      "C\n"
      "about it; types A and B by H and V. Beam and field angles: the width of the beam at 50 % and 10 % of the "
      "highest\n"
      "intensity in a plane, from the angle on its one side to that on the other.\n\n"
      "Examples:\n"
      "  lichtmc luminaire lamp.ies -o lamp.svg\n"
      "  lichtmc luminaire lamp.ldt --set 2 --json\n"
      "Exit status: 0 the file can be used, perhaps with warnings; 2 it cannot be read.");
  command->callback([options] { show_luminaire(*options); });
}

}  // namespace lichtmc::app
