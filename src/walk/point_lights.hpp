// The irradiance by point lights, without shadows, at the surface points that the photons of a wave have left: the same
// formulas as PointLight::sample_light(), many photons at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "base/lanes.hpp"
#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"
#include "walk/light_source.hpp"

namespace lichtmc {

// One sample of light for each photon of a wave. Arrays of whole_lanes() elements.
struct LightSamples {
  explicit LightSamples(std::size_t capacity) {
    const std::size_t whole = whole_lanes(capacity);
    source.resize(whole);
    probability.resize(whole, 1.0);
    irradiance.resize(whole);
    for (auto* numbers : {&dx, &dy, &dz}) numbers->resize(whole);
    within_reach.resize(whole);
    target.resize(whole);
  }

  std::vector<std::uint32_t> source;  // the emitter: index into the sources of DirectLight
  std::vector<double> probability;    // with which it was chosen
  std::vector<double> irradiance;     // W/m² or lx; 0: none
  std::vector<float> dx, dy, dz;  // the segment that must be free: from the start of the flight, tracer's coordinates
  std::vector<std::uint32_t> within_reach;  // 1: the emitter is too close for a shadow ray
  std::vector<glm::dvec3> target;           // m, world: the point of an area light; not set for point lights
};

class PointLights {
 public:
  // lights[k]: source k, or null if it is not a point light. They and the tracer must outlive this.
  PointLights(std::vector<const PointLight*> lights, const Tracer& tracer);

  // Sets irradiance and segment of each sample, by its source; the irradiance by sources that are no point lights is 0.
  // The flights start one step off the surface that the photon has left, on the side given by `behind`.
  void sample(const Rays& rays, LightSamples& samples);

  // Position in the tracer's coordinates, and a factor of the irradiance: the intensity of an isotropic emitter, or the
  // flux of any other, which its density multiplies.
  struct Source {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double factor = 0.0;
  };

 private:
  void multiply_by_density(std::size_t n, LightSamples& samples);
  void multiply_by_table(std::size_t n, LightSamples& samples);
  void find_common_table();

  const Tracer* tracer_;
  std::vector<const PointLight*> lights_;
  std::vector<Source> sources_;
  bool all_isotropic_ = true;
  // If all sources are luminaires of one table: this.
  const CandelaTable* table_ = nullptr;
  std::vector<glm::dmat3> to_frames_;             // world → frame, of each source
  std::vector<double> away_x_, away_y_, away_z_;  // directions from the emitter, unless all are isotropic
  std::vector<double> candela_;
};

}  // namespace lichtmc
