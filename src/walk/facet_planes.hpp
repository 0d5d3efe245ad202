// The planes of a tracer's facets in the world, in double: where flights end, exact to its rounding.
//
// Tracers compute in float. A path whose corners are moved onto the planes is a path of light through the room, whose
// length is exact: none is shorter than the shortest possible one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "base/lanes.hpp"
#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

// Where the flights of a wave end, for loops in lanes.
struct FlightEnds {
  const float* LICHTMC_APART x;
  const float* LICHTMC_APART y;
  const float* LICHTMC_APART z;
  const float* LICHTMC_APART dx;
  const float* LICHTMC_APART dy;
  const float* LICHTMC_APART dz;
  const float* LICHTMC_APART length;
  const std::uint32_t* LICHTMC_APART facet;
  const double* LICHTMC_APART normal_x;
  const double* LICHTMC_APART normal_y;
  const double* LICHTMC_APART normal_z;
  const double* LICHTMC_APART offset;
  // A point (x, y, z) in the tracer's coordinates → the world: of x, origin_x + x_x x + x_y y + x_z z, and so on.
  // (Loops with types of GLM are not vectorised.)
  double origin_x, origin_y, origin_z;
  double x_x, x_y, x_z;
  double y_x, y_y, y_z;
  double z_x, z_y, z_z;
};

class FacetPlanes {
 public:
  // The tracer must outlive this.
  FacetPlanes(const Room& room, const Tracer& tracer);

  // The point of the facet's plane that is nearest to a point (m, world).
  glm::dvec3 nearest(std::uint32_t facet, const glm::dvec3& point) const {
    const glm::dvec3 normal(normal_x_[facet], normal_y_[facet], normal_z_[facet]);
    return point - (glm::dot(normal, point) - offset_[facet]) * normal;
  }
  // All flights have hit a surface.
  FlightEnds ends_of(const Rays& rays) const;

 private:
  const Tracer* tracer_;
  // Of each facet: the normal n of length 1, or 0 for a facet without an area, and n · p for the points p of its plane.
  std::vector<double> normal_x_, normal_y_, normal_z_, offset_;
};

}  // namespace lichtmc
