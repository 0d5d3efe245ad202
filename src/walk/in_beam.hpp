// The position of triangles in the beam of a point emitter: where its irradiance is zero, or changes too fast for a
// quadrature rule.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "walk/light_source.hpp"
#include "walk/triangle_integral.hpp"

namespace lichtmc {

// The position of a triangle in the beam of a point emitter.
struct InBeam {
  const PointLight& source;

  // The angle between the axis and the centre of the triangle; half_size: half the angle that the triangle subtends.
  double angle_to_centre(const Triangle& t, double& half_size) const {
    const glm::dvec3 segment = centroid_of(t) - source.position();
    const double distance = glm::length(segment);
    const double radius = radius_of(t);
    if (!(distance > radius)) {
      half_size = std::numbers::pi;
      return 0.0;
    }
    half_size = std::asin(radius / distance);
    const glm::dvec3 towards = segment / distance;
    return std::atan2(glm::length(glm::cross(towards, source.axis())), glm::dot(towards, source.axis()));
  }

  // The angle between the axis and the nearest direction to the triangle.
  double angle_off(const Triangle& t, double& half_size) const {
    return std::max(0.0, angle_to_centre(t, half_size) - half_size);
  }

  bool is_outside(const Triangle& t) const {
    double half_size = 0.0;
    return angle_off(t, half_size) > source.extent().half_angle;
  }

  // The irradiance changes over the distance from the emitter and over the width of its beam. In triangles smaller than
  // half of either, the difference of the two rules is a reliable error estimate.
  // Where the edge of a sharp beam crosses a triangle, all points of both rules may lie on one side of it. Of a
  // triangle up to some 1/25 is then counted wrongly (a corner beyond the point nearest to it). After n divisions the
  // edge crosses some 2 · 2ⁿ parts of 4⁻ⁿ of the area: 6 divisions leave at most 10⁻³ of the first triangle, with
  // either sign.
  bool coarse(const Triangle& t, int depth) const {
    double half_size = 0.0;
    const double angle = angle_to_centre(t, half_size);
    constexpr double half = 0.5;
    constexpr int divisions_at_edge = 6;
    // A table is bilinear between its angles, and may end where it is not dark.
    if (const CandelaTable* table = source.table()) {
      const glm::dvec3 segment = centroid_of(t) - source.position();
      const glm::dvec3 away = source.in_frame(segment / std::max(glm::length(segment), 1e-300));
      if (depth < divisions_at_edge && table->ends_near(away, half_size)) return true;
      return half_size > half || half_size > half * table->step_near(away, half_size);
    }
    const EmitterExtent& extent = source.extent();
    if (extent.sharp && depth < divisions_at_edge && std::abs(angle - extent.half_angle) < half_size) return true;
    return half_size > half || half_size > half * extent.width;
  }
};

}  // namespace lichtmc
