// Exact form factors: the share of the flux from one diffuse surface that falls directly on another.
//
// F is dimensionless, between 0 and 1, for a surface of uniform exitance without obstacles. By reciprocity A₁ F₁₂ = A₂
// F₂₁. For an element of area F is also the irradiance on the element over the exitance of the other surface, E/M.
// Lengths may be in any unit, the same for all. The formulas are in J. R. Howell, A Catalog of Radiation Heat Transfer
// Configuration Factors; the .cpp names their authors.
#pragma once

namespace lichtmc::test {

// A rectangle in a plane with two perpendicular axes: first_low < first_high along the first, likewise the second.
struct Rectangle {
  double first_low = 0.0;
  double first_high = 1.0;
  double second_low = 0.0;
  double second_high = 1.0;
};

// Element → rectangle in a plane parallel to it. The foot of the perpendicular from the element, a distance > 0 away,
// divides the rectangle into `left` and `right` along one direction, `front` and `back` along the other; if it lies
// outside, one of a pair is negative and the other larger than the rectangle.
double element_to_parallel_rectangle(double distance, double left, double right, double front, double back);

// Element → rectangle in a plane perpendicular to it. The foot of the perpendicular from the element onto the
// rectangle's plane, a distance > 0 away, divides the rectangle into `left` and `right` as above; in the direction that
// the element faces, the rectangle extends from `near` ≥ 0 to `far`.
double element_to_perpendicular_rectangle(double distance, double left, double right, double far, double near = 0.0);

// Rectangle a × b → equal rectangle opposite, a distance > 0 away.
double opposite_rectangles(double a, double b, double distance);

// Rectangle `common` × `from` → rectangle `common` × `to`, which is perpendicular to it at the common edge.
double rectangles_with_common_edge(double common, double from, double to);

// Rectangle → rectangle in a parallel plane a distance > 0 away, both given by the same two axes.
double parallel_rectangles(const Rectangle& from, const Rectangle& to, double distance);

// Rectangle → rectangle in a plane perpendicular to it. `first` of either is the coordinate along the line where the
// planes meet, `second` ≥ 0 the distance from that line.
double perpendicular_rectangles(const Rectangle& from, const Rectangle& to);

// Disk of radius r1 > 0 → parallel disk of radius r2 on the same axis, a distance > 0 away.
double coaxial_disks(double r1, double r2, double distance);

// Generalized Lambert point emitter of exponent m ≥ 0 → disk around its axis: share of its power. m = 1 is an element
// of area facing the disk.
double point_to_coaxial_disk(double exponent, double radius, double distance);

// Isotropic point emitter → rectangle: share of its power, the solid angle over 4π. Arguments as for
// element_to_parallel_rectangle().
double isotropic_point_to_rectangle(double distance, double left, double right, double front, double back);

}  // namespace lichtmc::test
