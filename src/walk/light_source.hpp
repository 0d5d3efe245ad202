// The irradiance by each emitter at a reference point, without shadows.
//
// Point lights in closed form, E = I(θ) w/r², w = cos θ' unless the receiver is a cylinder; Lambertian area lights of
// uniform exitance by the polygon formula; any area light by a random point on it, with a density proportional to its
// exitance. World coordinates in m; shadows are in direct_light.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "base/frame.hpp"
#include "lichtmc/emitter_law.hpp"
#include "lichtmc/room.hpp"
#include "room/emission.hpp"
#include "room/emitter_shape.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

// A sample of one emitter's light at a reference point, without shadows.
struct LightSample {
  double irradiance = 0.0;  // W/m² or lx; 0: none
  glm::dvec3 target{0.0};   // m, the point of the emitter
  double pdf_bsdf =
      0.0;  // density per area with which a diffuse flight (of a cylinder: first_flight()) hits it; 0: point lights
  double relative = 1.0;  // of area lights: exitance at that point, divided by its mean
};

class PointLight {
 public:
  // flux: in W or lm; number: index into Room::emitters.
  template <PointShape Shape>
  PointLight(const Shape& shape, double flux, std::size_t number)
      : position_(shape.position),
        frame_(frame_of(shape)),
        law_(shape.law()),
        extent_(shape.law().extent()),
        flux_(flux),
        number_(number) {
    if (const LuminousOpening* opening = opening_of(shape)) opening_ = *opening;
  }

  // Of light that starts at its position, or at a point of its opening (world, m).
  LightSample sample_light(const ReferencePoint& reference) const { return sample_light(reference, position_); }
  LightSample sample_light(const ReferencePoint& reference, const glm::dvec3& from) const;

  // Whether its light starts all over an opening: its irradiance is the mean over that.
  bool has_opening() const { return opening_.has_value(); }
  // A point of it, uniform over its area, for u and v in [0, 1); world, m.
  glm::dvec3 place(double u, double v) const;
  // No point of it is further from the position, in m.
  double reach_m() const { return opening_ ? opening_->half_diagonal_m() : 0.0; }

  const EmitterExtent& extent() const { return extent_; }
  std::size_t number() const { return number_; }
  const glm::dvec3& position() const { return position_; }
  const glm::dvec3& axis() const { return frame_.normal; }
  double flux() const { return flux_; }
  // The intensity, if it is the same in all directions.
  std::optional<double> uniform_intensity() const;
  const Frame& frame() const { return frame_; }
  // A direction of the world in that frame.
  glm::dvec3 in_frame(const glm::dvec3& direction) const {
    return {glm::dot(direction, frame_.tangent), glm::dot(direction, frame_.bitangent),
            glm::dot(direction, frame_.normal)};
  }
  // Of measured luminaires; null for others.
  const CandelaTable* table() const;
  // Density of the directions of its light, 1/sr, in a direction (world, length 1).
  double density(const glm::dvec3& away) const;

 private:
  glm::dvec3 position_;
  Frame frame_;  // its normal is the emitter's axis
  EmitterLaw law_;
  EmitterExtent extent_;
  double flux_;
  std::size_t number_;
  std::optional<LuminousOpening> opening_;
};

class AreaLight {
 public:
  // emission: of the emitter, none if it is uniform; flux: in W or lm; first_facet: the tracer's facet of the surface's
  // first triangle; with an emission map the facets of a surface must be its triangles in their order, with s and t to
  // the second and third corner. planes: faces in one plane, or null; covered parts of the emitter give no light. The
  // room must outlive the light.
  AreaLight(const Room& room, const SurfaceEmitter& emitter, std::optional<SurfaceEmission> emission, double flux,
            std::uint32_t first_facet, const FacesInOnePlane* planes);

  // The sample at a point chosen by u, v, w (in [0, 1)) with a density proportional to the exitance: relative/area. Its
  // mean is the irradiance by the emitter, without shadows.
  LightSample sample_light(const ReferencePoint& reference, double u, double v, double w) const;

  // The same at the point that p and q in [0, 1) select. Equal parts of the unit square are parts of the emitter of
  // equal flux; with an emission map only roughly.
  LightSample sample_evenly(const ReferencePoint& reference, double p, double q) const;

  // What a flight by Lambert's law from a reference point in a direction (world, length 1) brings from the emitter:
  // adds a sample, π times the radiance, for the front of each triangle that it meets. Their mean over flights is the
  // irradiance over the whole hemisphere, without shadows.
  void add_fronts_hit(const ReferencePoint& reference, const glm::dvec3& direction,
                      std::vector<LightSample>& samples) const;

  // A lower bound of the distance of a point from the emitter, in m.
  double least_distance_m(const glm::dvec3& point) const;

  // The least distance, in m, of a point from the part of the emitter whose front it sees; infinite if it sees none.
  double distance_m(const glm::dvec3& point) const;

  // The number of triangles whose front a ray from a point hits, one behind the other; polygon_irradiance() is π times
  // the radiance times its mean over directions by Lambert's law.
  int fronts_hit(const glm::dvec3& point, const glm::dvec3& direction) const;

  // Whether the emitter's bounding box reaches above the horizon of a reference point; if not, the irradiance is 0.
  bool reaches_above_horizon(const ReferencePoint& reference) const;

  // Whether polygon_irradiance() is valid: the emitter is Lambertian, and its exitance is uniform.
  bool has_closed_form() const { return law_.exponent == 1.0 && !emission_; }
  // The irradiance over the whole hemisphere, without shadows; not of cylinders.
  double polygon_irradiance(const ReferencePoint& reference) const;
  std::size_t triangles() const { return triangles_.size(); }

  // The mean radiance over the emitter, W/(m² sr) or cd/m², at an angle of this cosine to the normal.
  double radiance(double cosine) const;
  // The exitance at a point of a facet of the emitter, divided by its mean.
  double relative_exitance(std::uint32_t facet, float s, float t) const {
    return emission_ ? emission_->relative(facet - first_facet_, {s, t}) : 1.0;
  }
  // A bound of it.
  double highest_exitance() const { return emission_ ? emission_->highest() : 1.0; }
  std::size_t surface() const { return surface_number_; }
  // Of the uncovered parts; with an emission map of the whole surface.
  double area_m2() const { return area_m2_; }
  // Radiance of a Lambertian emitter of the same exitance, W/(m² sr) or cd/m².
  double mean_radiance() const;

 private:
  // A hit of the front of a triangle: distance in lengths of the direction, and where.
  struct FrontHit {
    double length = 0.0;
    glm::dvec2 weights{0.0};
  };
  std::optional<FrontHit> front_hit(std::size_t triangle, const glm::dvec3& point, const glm::dvec3& direction) const;
  LightSample sample_at(const ReferencePoint& reference, const EmissionPlace& place) const;
  double density_at(double cosine) const;
  bool is_covered(std::size_t triangle, const glm::dvec2& weights) const;

  void leave_out_covered(const Room& room, const FacesInOnePlane& planes);

  std::shared_ptr<const Surface> uncovered_;  // the surface's uncovered parts, if something covers it
  const FacesInOnePlane* planes_ = nullptr;   // with an emission map: if something covers the surface
  const Surface* surface_;
  std::size_t surface_number_;
  double flux_;
  double area_m2_;
  LambertLaw law_;
  std::uint32_t first_facet_;
  std::optional<SurfaceEmission> emission_;  // if it is not uniform
  glm::dvec3 low_{0.0};                      // bounding box
  glm::dvec3 high_{0.0};
  // Of each triangle of surface_: a corner, the sides from it, the normal of the front.
  struct Prepared {
    glm::dvec3 corner{0.0};
    glm::dvec3 side_1{0.0};
    glm::dvec3 side_2{0.0};
    glm::dvec3 normal{0.0};
  };
  std::vector<Prepared> prepared_;
  std::vector<double> areas_up_to_;
  std::vector<std::size_t> triangles_;  // those with an area
};

}  // namespace lichtmc
