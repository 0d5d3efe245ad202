#include "tracer/convex_room.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "room/emitter_shape.hpp"

namespace lichtmc {

// The mean of the corners of a convex body that is not flat lies inside.
ConvexRoom::ConvexRoom(const Room& room, const Tracer& tracer) : room_(&room), tracer_(&tracer) {
  glm::dvec3 sum(0.0);
  double corners = 0.0;
  for (const Surface& surface : room.surfaces) {
    for (const glm::uvec3& triangle : surface.triangles) {
      for (int k = 0; k < 3; ++k) sum += surface.positions[triangle[k]];
      corners += 3.0;
    }
  }
  middle_m_ = sum / corners;
}

// If the ray away from the middle met the room in a point q, the start would lie between the middle and q, both of
// which belong to the convex body.
std::optional<glm::dvec3> ConvexRoom::way_out(const glm::vec3& point) const {
  const glm::dvec3 away = glm::dvec3(point) - tracer_->tracer_point(middle_m_);
  if (!(glm::length(away) > 0.0)) return std::nullopt;
  Rays rays(1);
  rays.size = 1;
  rays.facet[0] = no_facet;
  rays.set_start(0, point);
  rays.set_direction(0, glm::vec3(glm::normalize(away)));
  TraceCount not_counted;
  tracer_->trace(rays, Misses::escape, not_counted);
  if (rays.facet[0] != no_facet) return std::nullopt;
  return glm::normalize(away);
}

bool ConvexRoom::emits_inwards(const Surface& surface) const {
  return std::all_of(surface.triangles.begin(), surface.triangles.end(), [&](const glm::uvec3& t) {
    const glm::dvec3 a = surface.positions[t.x];
    return glm::dot(glm::cross(surface.positions[t.y] - a, surface.positions[t.z] - a), middle_m_ - a) >= 0.0;
  });
}

bool ConvexRoom::holds_all_emitters() const {
  return std::all_of(room_->emitters.begin(), room_->emitters.end(), [this](const Emitter& emitter) {
    if (emitter.power == 0.0) return true;
    return visit_shape(
        emitter,
        [this](const auto& point) {
          constexpr bool has_axis = requires {
            point.axis;
          };
          const glm::dvec3 axis = has_axis ? frame_of(point).normal : glm::dvec3(0.0);
          const std::vector<glm::dvec3> starts = outermost_points(point);
          return std::all_of(starts.begin(), starts.end(), [&](const glm::dvec3& place) {
            const Start start = tracer_->start(place, axis);
            return start.on_surface || !way_out(start.point);
          });
        },
        [this](const auto& area_light) { return emits_inwards(room_->surfaces[area_light.surface]); });
  });
}

}  // namespace lichtmc
