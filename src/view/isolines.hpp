// Lines of equal irradiance on a plane.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

#include "lichtmc/picture.hpp"

namespace lichtmc {

// Irradiance on a grid of points, row by row, with a weight per point.
struct IrradianceField {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<double> values;  // W/m² or lx; undefined where the weight is 0
  std::vector<double> weight;  // 1 on the surface, 0 outside
};

// The weighted mean over the neighbourhood of each point. The weights are IrradianceField::weight times a Gaussian of
// this standard deviation (in points).
IrradianceField smoothed(const IrradianceField& field, double radius);

// Levels for about six lines between low and high (0 ≤ low < high): multiples of 1, 2 or 5 times a power of ten; or, if
// logarithmic, 1, 2 and 5 times powers of ten.
std::vector<double> round_levels(double low, double high, bool logarithmic);

// The lines of one level, in units of points; (0, 0) is the first point. Marching squares (W. Lorensen, H. Cline,
// Marching Cubes, 1987, in two dimensions); at saddles the mean of the four corners determines the topology. The lines
// end at the border of the surface.
std::vector<Isoline> lines_of(const IrradianceField& field, double level);

}  // namespace lichtmc
