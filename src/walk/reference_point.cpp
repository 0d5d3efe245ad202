#include "walk/reference_point.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace lichtmc {

ReferencePoint reference_point_of(const Receiver& receiver) {
  // Scaled by its largest component first: the square of a very long or short normal would overflow or underflow.
  const glm::dvec3 n = receiver.normal;
  const glm::dvec3 scaled = n / std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
  ReferencePoint reference{receiver.position, glm::normalize(scaled), 0.0};
  if (receiver.half_angle_deg < 90.0)
    reference.least_cosine = std::cos(receiver.half_angle_deg * std::numbers::pi / 180.0);
  reference.cell_u = receiver.cell_u;
  reference.cell_v = receiver.cell_v;
  return reference;
}

glm::dvec3 start_of(const ReferencePoint& reference, const Tracer& tracer) {
  if (reference.start) return *reference.start;
  return tracer.tracer_point(reference.point) +
         double{tracer.step()} * glm::normalize(tracer.directions() * reference.normal);
}

}  // namespace lichtmc
