// The intensity of a luminaire in all directions, in false colour.
#pragma once

#include "output/polar_diagram.hpp"

namespace lichtmc {

// One disc for the directions within 90° of the aim, one for those behind, each if it has light: the distance from the
// middle is the angle to the aim (to its opposite), C0 is right and C90 up, as seen from behind the luminaire. The disc
// of a narrow beam shows the inner angles only.
PicturePanel sphere_panel(const Photometry& photometry, double x, double y);

}  // namespace lichtmc
