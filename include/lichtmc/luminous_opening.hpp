// The luminous opening of a luminaire: the body that its light leaves, of a given size, centred at its position.
#pragma once

#include <string_view>

#include <glm/vec3.hpp>

namespace lichtmc {

// Axes as in lichtmc/candela_table.hpp: x towards C0, y towards C90, z along the aim.
enum class OpeningForm {
  point,
  rectangle,     // in the plane across the aim
  ellipse,       // in that plane; a disc if both diameters are equal
  box,           // its six faces
  cylinder,      // elliptic, along the aim: its side and both ends
  cylinder_c0,   // along x; of length 0: an ellipse across x
  cylinder_c90,  // along y
  ellipsoid,     // a sphere if all diameters are equal
};

std::string_view name_of(OpeningForm form);  // "point", "rectangle", …

struct LuminousOpening {
  OpeningForm form = OpeningForm::point;
  glm::dvec3 size_m{0.0};  // lengths or diameters along x, y and z, ≥ 0

  // The largest dimension, in m.
  double largest_m() const;
  // Half the diagonal of the box around it, in m.
  double half_diagonal_m() const;
  // A point of it, uniform over its area, for u and v in [0, 1); relative to its centre. Equal parts of the unit square
  // have equal areas. Elliptic cylinders and ellipsoids: points of a round one, stretched to the three sizes.
  glm::dvec3 place(double u, double v) const;
};

}  // namespace lichtmc
