// Emitters as seen from a point: what each would send there if nothing stood between.
//
// Point emitters in closed form, E = I(θ) cos θ'/r²; Lambertian surface emitters by the closed polygon formula; any
// surface emitter by a random point on it. Everything here is geometry in the world, in m; who stands between is
// asked elsewhere (direct_light.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// A point with the side that it looks to, in m.
struct ReferencePoint {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0, 1.0, 0.0};  // length 1
  double least_cosine = 0.0;  // of the field of view: directions with a smaller cosine to the normal are not seen

  // The share of a hemisphere of even light that the field of view takes.
  double squared_sine() const { return (1.0 - least_cosine) * (1.0 + least_cosine); }
};

// One emitter's light on its way to a point: what it would bring if nothing stood between, and the way to it.
struct LightSample {
  double irradiance = 0.0;  // W/m² or lx; 0: none
  glm::dvec3 target{0.0};   // m, the point of the emitter
  double pdf_bsdf = 0.0;    // density with which a diffuse flight meets that point, per area; 0 for point emitters
};

class PointSource {
 public:
  // The emitter must outlive the source.
  PointSource(const Emitter& emitter, std::size_t number);

  LightSample offer(const ReferencePoint& reference) const;

  // Its light lies within a cone about the axis and changes over angles of about `width`, both in rad.
  struct Beam {
    double half_angle = 0.0;  // beyond it there is less than 10⁻¹⁶ of the intensity on the axis
    double width = 0.0;
  };
  const Beam& beam() const { return beam_; }

  std::size_t number() const { return number_; }  // into Room::emitters
  const glm::dvec3& position() const { return position_; }
  const glm::dvec3& axis() const { return axis_; }

 private:
  double intensity(const glm::dvec3& direction) const;

  const Emitter* emitter_;
  std::size_t number_;
  glm::dvec3 position_{0.0};
  glm::dvec3 axis_{0.0, 0.0, 1.0};
  Beam beam_;
};

class SurfaceSource {
 public:
  // Room and emitter must outlive the source.
  SurfaceSource(const Room& room, const Emitter& emitter);

  // The offer of the point that u, v, w (in [0, 1)) choose, uniform over the area: its mean is the emitter's
  // irradiance, if nothing stood between.
  LightSample offer(const ReferencePoint& reference, double u, double v, double w) const;

  // Where a straight way from a point first meets the emitter's front, if nothing else stood in its way.
  std::optional<glm::dvec3> nearest_hit(const glm::dvec3& point, const glm::dvec3& direction) const;

  // Whether the box about the emitter reaches over a point's horizon: else it sends nothing there.
  bool reaches_above_horizon(const ReferencePoint& reference) const;

  bool lambertian() const { return exponent_ == 1.0; }
  // The irradiance of a Lambertian emitter over the whole hemisphere, if nothing stood between.
  double by_polygons(const ReferencePoint& reference) const;
  std::size_t triangles() const { return triangles_.size(); }

  double radiance(double cosine) const;  // W/(m² sr) or cd/m² at an angle to the normal
  std::size_t surface() const { return surface_number_; }
  double area_m2() const { return area_m2_; }

 private:
  const Surface* surface_;
  std::size_t surface_number_;
  double power_;
  double area_m2_;
  double exponent_;
  glm::dvec3 low_{0.0};  // the box about it
  glm::dvec3 high_{0.0};
  std::vector<double> areas_up_to_;
  std::vector<std::size_t> triangles_;  // those with an area
};

}  // namespace lichtmc
