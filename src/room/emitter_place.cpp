#include "room/emitter_place.hpp"

#include <glm/geometric.hpp>

#include "room/emitter_shape.hpp"

namespace lichtmc {

namespace {

glm::dvec3 middle_of(const Surface& surface) {
  glm::dvec3 sum(0.0);
  double area = 0.0;
  for (const glm::uvec3& t : surface.triangles) {
    const glm::dvec3 a = surface.positions[t.x];
    const glm::dvec3 b = surface.positions[t.y];
    const glm::dvec3 c = surface.positions[t.z];
    const double own = glm::length(glm::cross(b - a, c - a));
    sum += own * (a + b + c) / 3.0;
    area += own;
  }
  return area > 0.0 ? sum / area : glm::dvec3(0.0);
}

}  // namespace

glm::dvec3 place_of(const Room& room, const Emitter& emitter) {
  return visit_shape(
      emitter, [](const auto& point) { return point.position; },
      [&](const auto& area_light) { return middle_of(room.surfaces[area_light.surface]); });
}

EmitterDirections directions_of(const Emitter& emitter) {
  return visit_shape(
      emitter,
      [](const auto& point) {
        EmitterDirections directions;
        if constexpr (requires { point.axis; }) directions.aim = frame_of(point).normal;
        if constexpr (requires { point.c0; }) directions.c0 = point.c0;
        return directions;
      },
      [](const auto& /*area_light*/) { return EmitterDirections{}; });
}

const Photometry* photometry_of(const Emitter& emitter) {
  return visit_shape(
      emitter,
      [](const auto& point) -> const Photometry* {
        if constexpr (requires { point.photometry; }) {
          return point.photometry.get();
        } else {
          return nullptr;
        }
      },
      [](const auto& /*area_light*/) -> const Photometry* { return nullptr; });
}

const LuminousOpening* opening_of(const Emitter& emitter) {
  return visit_shape(
      emitter, [](const auto& point) { return opening_of(point); },
      [](const auto& /*area_light*/) -> const LuminousOpening* { return nullptr; });
}

}  // namespace lichtmc
