// The paths of the photons of a wave: how far each has come, and where it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "walk/facet_planes.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

// By the number of the photon. Lengths in m of the world.
class FlightPaths {
 public:
  // planes: of the tracer's facets, which must outlive this; null: paths are not kept.
  explicit FlightPaths(const FacetPlanes* planes);

  const FacetPlanes& planes() const { return *planes_; }
  void start(std::uint32_t photon, const glm::dvec3& point, double length_m) {
    x_[photon] = point.x;
    y_[photon] = point.y;
    z_[photon] = point.z;
    length_[photon] = length_m;
  }
  // All photons of the wave have landed.
  void land(const Wave& wave);

  double length_m(std::uint32_t photon) const { return length_[photon]; }
  glm::dvec3 point(std::uint32_t photon) const { return {x_[photon], y_[photon], z_[photon]}; }

 private:
  const FacetPlanes* planes_;
  std::vector<double> x_, y_, z_, length_;
  // By the position in the wave: ends and lengths of flights.
  std::vector<double> end_x_, end_y_, end_z_, flight_;
};

}  // namespace lichtmc
