// The polar diagram of a luminaire: its intensity over the angle to the aim, in two planes.
#pragma once

#include <string>

#include "lichtmc/luminaire_figures.hpp"

namespace lichtmc {

// A part of a picture, with its size in units.
struct PicturePanel {
  std::string svg;
  double width = 0.0;
  double height = 0.0;
};

// The diagram with rings of round intensities, and below it the names of its lines. The aim is down, and the side of C0
// (C90) right. Of a luminaire with light on one side of 90° only, that half. A third line is drawn in the plane of the
// maximum if that is much higher than both planes show.
PicturePanel polar_panel(const Photometry& photometry, const LuminaireFigures& figures, double x, double y);

// The same as a picture of its own, without a title.
std::string polar_svg(const Photometry& photometry);

// The intensity over the angle: what is narrower than about 40° is a needle in a polar diagram. Empty if it is wider.
PicturePanel beam_panel(const Photometry& photometry, const LuminaireFigures& figures, double x, double y);

}  // namespace lichtmc
