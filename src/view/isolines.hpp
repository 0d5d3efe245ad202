// Lines of equal irradiance on a flat field.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

#include "lichtmc/picture.hpp"

namespace lichtmc {

// Irradiance on a grid of points, row by row, with what there is of the surface around each.
struct Field {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<double> values;  // W/m² or lx; of no meaning where there is no surface
  std::vector<double> weight;  // 1 on the surface, 0 beside it
};

// The mean over each point's neighbourhood, weighted by a Gaussian of this radius (standard deviation, in points) and
// by the surface; what is beside the surface does not count.
Field smoothed(const Field& field, double radius);

// Levels for about six lines between low and high (0 ≤ low < high): multiples of 1, 2 or 5 times a power of ten; or, if
// logarithmic, 1, 2 and 5 times powers of ten.
std::vector<double> round_levels(double low, double high, bool logarithmic);

// The lines of one level in units of points, (0, 0) being the first (marching squares: W. Lorensen, H. Cline, Marching
// Cubes, 1987, in the plane; at saddles the mean of the four decides). They end at the surface's rim.
std::vector<Isoline> lines_of(const Field& field, double level);

}  // namespace lichtmc
