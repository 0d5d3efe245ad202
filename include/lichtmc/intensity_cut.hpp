// The intensity of a luminaire in a plane through its aim, and the widths of its beam there.
#pragma once

#include <cstddef>
#include <vector>

#include "lichtmc/candela_table.hpp"

namespace lichtmc {

// Angles are from the aim, −180 … 180°: above 0 on the side of the plane, below on the opposite one.
struct IntensityPoint {
  double angle_deg = 0.0;
  double candela = 0.0;
};

// All round: the intensity is linear in the angle from each point to the next; two points of one angle are a step. The
// first point is at −180°, the last at 180°.
using IntensityCut = std::vector<IntensityPoint>;

// The cut through the planes C and C + 180°, positive angles towards C. For types A and B: 0 or 90, the planes that
// contain the aim and C0, or the aim and C90. A table with n vertical angles has at most 4 n + 6 points (types A and B:
// with the horizontal angles).
IntensityCut intensity_cut(const CandelaTable& table, double plane_deg);

// The highest point of a cut; of equal ones that next to the aim, and of these the one with the positive angle.
IntensityPoint highest_of(const IntensityCut& cut);

// The angles about the highest point of a cut at which the intensity is at least a share of it.
struct BeamWidth {
  double from_deg = -180.0;  // −540 < from ≤ highest point ≤ to < 540: beyond ±180° where it passes the direction
  double to_deg = 180.0;     // opposite to the aim
  std::size_t lobes = 1;     // ranges of such angles in the whole cut: 2 with two peaks and a dip between

  double width_deg() const { return to_deg - from_deg; }
};

// share: above 0, at most 1. Half of the highest point: the full width at half of the maximum, FWHM. A cut without
// light has the width 0, and no lobe.
BeamWidth beam_width(const IntensityCut& cut, double share);

}  // namespace lichtmc
