// The paths of the photons of a wave: how far each has come, and where it is.
#pragma once

#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "walk/facet_planes.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

// By the number of the photon. Lengths in m of the world.
class FlightPaths {
 public:
  // planes: of the tracer's facets, which must outlive this; null: paths are not kept.
  explicit FlightPaths(const FacetPlanes* planes) : planes_(planes) {
    if (planes == nullptr) return;
    length_.resize(batch_histories);
    point_.resize(batch_histories);
  }

  const FacetPlanes& planes() const { return *planes_; }
  void start(std::uint32_t photon, const glm::dvec3& point, double length_m) {
    point_[photon] = point;
    length_[photon] = length_m;
  }
  // All photons of the wave have landed.
  void land(const Wave& wave) {
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const std::uint32_t photon = wave.photon[i];
      const glm::dvec3 end = planes_->end_of(wave.rays, i);
      length_[photon] += glm::length(end - point_[photon]);
      point_[photon] = end;
    }
  }
  double length_m(std::uint32_t photon) const { return length_[photon]; }
  const glm::dvec3& point(std::uint32_t photon) const { return point_[photon]; }

 private:
  const FacetPlanes* planes_;
  std::vector<double> length_;
  std::vector<glm::dvec3> point_;
};

}  // namespace lichtmc
