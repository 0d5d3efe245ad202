#include "walk/reference_point.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "chance/cylinder_directions.hpp"
#include "chance/places.hpp"

namespace lichtmc {

namespace {

// Scaled by its largest component first: the square of a very long or short vector would overflow or underflow.
glm::dvec3 direction_of(const glm::dvec3& vector) {
  return glm::normalize(vector / std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)}));
}

}  // namespace

ReferencePoint reference_point_of(const Receiver& receiver) {
  ReferencePoint reference{receiver.position, direction_of(receiver.normal), 0.0};
  if (receiver.half_angle_deg < 90.0)
    reference.least_cosine = std::cos(receiver.half_angle_deg * std::numbers::pi / 180.0);
  reference.cell_u = receiver.cell_u;
  reference.cell_v = receiver.cell_v;
  reference.law = receiver.law;
  if (receiver.law == ReceiverLaw::semicylindrical) {
    const glm::dvec3 facing = direction_of(receiver.facing);
    reference.facing = glm::normalize(facing - glm::dot(facing, reference.normal) * reference.normal);
  }
  return reference;
}

// sin ε/π and sin ε (1 + cos α)/π: the component towards the direction faced is sin ε cos α.
double ReferencePoint::weight_around(const glm::dvec3& towards) const {
  const double sine = glm::length(glm::cross(towards, normal));
  return std::max(0.0, sine + glm::dot(towards, facing)) / std::numbers::pi;
}

FirstFlight first_flight(const ReferencePoint& reference, double u, double v) {
  if (reference.law != ReceiverLaw::planar) return first_flight_around(reference.normal, reference.facing, u, v);
  const ConeDirection flight = sample_cosine_cone(frame_about(reference.normal), reference.squared_sine(), u, v);
  return {flight.direction, flight.cosine};
}

FirstFlight first_flight_around(const glm::dvec3& axis, const glm::dvec3& facing, double u, double v) {
  const bool is_half = facing != glm::dvec3(0.0);
  const CylinderDirection local = is_half ? half_cylinder_direction(u, v) : cylinder_direction(u, v);
  const Frame frame = is_half ? Frame{facing, glm::cross(axis, facing), axis} : frame_about(axis);
  const glm::dvec3& d = local.direction;
  return {d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.normal, local.weight};
}

glm::dvec3 start_of(const ReferencePoint& reference, const Tracer& tracer) {
  if (reference.start) return *reference.start;
  return tracer.tracer_point(reference.point) +
         double{tracer.step()} * glm::normalize(tracer.directions() * reference.normal);
}

}  // namespace lichtmc
