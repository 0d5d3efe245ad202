// The intensity of a luminaire over directions, as measured: a table of candela over two angles.
//
// Directions are unit vectors in the luminaire's own frame: +Z is its aim, +X the side of 0° (C0), +Y that of C90. A
// direction of the angles of a photometric type is
//   type C:  (sin γ cos C, sin γ sin C, cos γ)        vertical angle γ 0 … 180°, horizontal angle C
//   type B:  (sin V, −cos V sin H, cos V cos H)       vertical angle V −90 … 90°, horizontal angle H
//   type A:  (cos V sin H, sin V, cos V cos H)
// Between the angles of the table the intensity is bilinear in the two angles, in degrees; outside its vertical range,
// and for types A and B outside its horizontal range, it is 0. At the poles the first plane counts. This is the
// definition of the luminaire: all figures follow from it, exactly.
//
// Source: IES LM-63-2002 for the types and their ranges; the signs of types A and B as in ANSI/IES LM-75.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace lichtmc {

class CandelaLookup;
class CandelaSampler;

// The axes of the two angles: photometric types of IES LM-63. EULUMDAT files are of type C.
enum class PhotometricType { c, b, a };

// How the planes of a table continue to all directions.
enum class PhotometricSymmetry {
  none,        // type C: all planes, 0 … 360°; types A and B: nothing outside of the table
  rotational,  // type C: one plane, the same at all C
  c0_c180,     // type C: mirrored in the plane C0–C180, planes within 0 … 180°
  c90_c270,    // type C: mirrored in the plane C90–C270, planes within 90 … 270° or −90 … 90°
  quadrants,   // type C: mirrored in both, planes within 0 … 90°
  horizontal,  // types A and B: I(−H) = I(H), H within 0 … 90°
  vertical,    // type B: I(−V) = I(V), V within 0 … 90°
  both,        // type B: both of these
};

std::string_view name_of(PhotometricType type);          // "C", "B", "A"
std::string_view name_of(PhotometricSymmetry symmetry);  // "none", "rotational", "C0-C180", …

// Where a table is highest: the first such angles, with the least horizontal one of those that symmetry makes equal.
struct PeakIntensity {
  double candela = 0.0;
  double horizontal_deg = 0.0;  // type C: 0 … 360
  double vertical_deg = 0.0;
};

class CandelaTable {
 public:
  struct Grid {
    PhotometricType type = PhotometricType::c;
    PhotometricSymmetry symmetry = PhotometricSymmetry::rotational;
    // Ascending. Type C without symmetry: from h to h + 360. One plane: rotational.
    std::vector<double> horizontal_deg;
    std::vector<double> vertical_deg;  // ascending, two or more
    std::vector<double> candela;       // ≥ 0, finite, one above 0; plane by plane, vertical angles within
    // Types A and B: H counts the other way. Some 30 % of the files of type B do so without saying it.
    bool flip_horizontal = false;
  };

  // Throws InputError if the grid violates what is said above.
  explicit CandelaTable(Grid grid);
  ~CandelaTable();
  CandelaTable(const CandelaTable&) = delete;
  CandelaTable& operator=(const CandelaTable&) = delete;

  const Grid& grid() const { return grid_; }

  // Intensity in cd in a direction (length 1) of the luminaire's frame.
  double candela(const glm::dvec3& direction) const;
  // The same for n directions, given by arrays of their components; faster than one by one.
  void candela(std::size_t n, const double* x, const double* y, const double* z, double* candela) const;

  // The integral over all directions, in lm: exact, cell by cell.
  double flux() const { return flux_; }
  // Its part within 90° of the aim.
  double flux_towards_aim() const;

  const PeakIntensity& peak() const { return peak_; }
  // The greatest angle to the aim, in rad, at which the intensity is above 0; a bound of it for types A and B.
  double half_angle() const { return half_angle_; }
  // The highest intensity divided by the steepest slope over an angle, in rad, at most π.
  double width() const { return width_; }
  // Whether the intensity falls to 0 at the half angle within less than 1/64 of it.
  bool has_sharp_edge() const { return sharp_edge_; }

  // Within a radius (rad) of a direction: how finely the intensity may vary, as the least distance of adjacent angles of
  // the table, in rad; and whether the intensity may fall to 0 at once, at an end of the table where it is above 0.
  double step_near(const glm::dvec3& direction, double radius) const;
  bool ends_near(const glm::dvec3& direction, double radius) const;

  // A direction with a density proportional to the intensity, by inversion: 0 < u < 1, 0 ≤ turns ≤ 1.
  glm::dvec3 sample(double u, double turns) const;

  // For samples: made when it is first needed; several threads may ask.
  const CandelaSampler& sampler() const;

 private:
  void check() const;
  void find_peak();
  void find_extent();
  void find_ends();

  Grid grid_;
  double flux_ = 0.0;
  PeakIntensity peak_;
  double half_angle_ = 0.0;
  double width_ = 0.0;
  bool sharp_edge_ = false;
  bool first_row_shines_ = false;  // the table ends there, above 0
  bool last_row_shines_ = false;
  bool first_plane_shines_ = false;
  bool last_plane_shines_ = false;
  std::unique_ptr<CandelaLookup> lookup_;
  mutable std::once_flag sampler_once_;
  mutable std::unique_ptr<CandelaSampler> sampler_;
};

}  // namespace lichtmc
