// The picture of a luminaire.
#include <algorithm>
#include <filesystem>
#include <string>

#include "base/atomic_file.hpp"
#include "base/message.hpp"
#include "lichtmc/luminaire_figures.hpp"
#include "lichtmc/output.hpp"
#include "output/picture_parts.hpp"
#include "output/polar_diagram.hpp"
#include "output/sphere_picture.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

// "1357 lm, 12 W, 113 lm/W"
std::string flux_line(const Photometry& photometry, const LuminaireFigures& figures) {
  std::string text = rounded(figures.flux, 4) + " " + figures.flux_unit;
  if (photometry.watts > 0.0) text += ", " + rounded(photometry.watts, 4) + " W";
  if (const std::optional<double> efficacy = photometry.efficacy(); efficacy && figures.flux_unit == "lm")
    text += ", " + short_number(*efficacy) + " lm/W";
  return text;
}

std::string maximum_line(const Photometry& photometry) {
  const PeakIntensity& peak = photometry.candela->peak();
  return "maximum " + rounded(peak.candela, 4) + " " + photometry.intensity_unit + " at " +
         direction_text(photometry, peak.horizontal_deg, peak.vertical_deg);
}

}  // namespace

std::string luminaire_svg(const Photometry& photometry) {
  const LuminaireFigures figures = luminaire_figures(photometry);
  constexpr double top = 84.0;
  double x = picture_side;
  double height = 0.0;
  std::string svg;
  const auto add = [&](const PicturePanel& panel) {
    svg += panel.svg;
    x += panel.width;
    height = std::max(height, panel.height);
  };
  add(polar_panel(photometry, figures, x, top));
  add(beam_panel(photometry, figures, x, top));
  if (photometry.candela->grid().symmetry != PhotometricSymmetry::rotational) add(sphere_panel(photometry, x, top));
  const double width = x + picture_side;
  double y = 50.0;
  for (const std::string& line : {flux_line(photometry, figures), maximum_line(photometry)})
    svg +=
        svg_notes(shortened(line, note_size, width - 2.0 * picture_side), picture_side, y, width - 2.0 * picture_side);
  return svg_head(width, top + height + 8.0, luminaire_title(photometry), picture_side) + svg + "</svg>\n";
}

void write_luminaire_svg(const Photometry& photometry, const std::filesystem::path& file) {
  write_file_atomically(file, luminaire_svg(photometry));
}

}  // namespace lichtmc
