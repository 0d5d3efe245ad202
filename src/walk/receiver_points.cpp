#include "walk/receiver_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>

#include "room/bounds.hpp"
#include "room/close_triangles.hpp"
#include "room/emitter_shape.hpp"
#include "room/enclosure.hpp"
#include "room/triangle_shapes.hpp"
#include "tracer/convex_room.hpp"
#include "tracer/prepared_room.hpp"
#include "tracer/touch.hpp"
#include "walk/visibility.hpp"

namespace lichtmc {

namespace {

// The closed shells that contain a point.
using Shells = std::vector<std::size_t>;

// A surface that a receiver lies on, or close to.
struct TouchedPlane {
  glm::dvec3 normal{0.0};    // length 1, to the side of the receiver; to the front if that is not decided
  double height_m = 0.0;     // of the receiver above the plane, on that side
  double clearance_m = 0.0;  // least height for rays that start there
  bool decided = true;
};

// A point where light starts; the normal of an area light, to whose side it goes.
struct LightOrigin {
  glm::dvec3 point{0.0};
  std::optional<glm::dvec3> normal;
};

class ReceiverPlacer {
 public:
  ReceiverPlacer(const Room& room, const Tracer& tracer) : room_(room), tracer_(tracer) {
    const Bounds bounds = bounds_of(room);
    const glm::dvec3 size = bounds.high - bounds.low;
    extent_m_ = std::max({size.x, size.y, size.z});
    if (!tracer.casts_shadows()) convex_.emplace(room, tracer);
  }

  // A distance at which no surface influences where rays start.
  double reach_m() const {
    double clearance = 0.0;
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
      clearance += tracer_.clearance_m(axis);
    return std::max(2.0 * clearance, NearPlane::most_rounding * extent_m_);
  }

  ReferencePoint place(const Receiver& receiver, const std::vector<CloseTriangle>& close) {
    ReferencePoint reference = reference_point_of(receiver);
    std::vector<TouchedPlane> planes = touched(reference, close);
    choose_sides(reference.point, planes);
    const glm::dvec3 moved = reference.point + way_off(planes);
    if (convex_) reference.way_out = convex_->way_out(glm::vec3(tracer_.tracer_point(moved)));
    // Along the normal of the only surface the usual step does the same.
    constexpr double parallel = 1.0 - 1e-9;
    const bool usual =
        planes.empty() || (planes.size() == 1 && glm::dot(planes[0].normal, reference.normal) > parallel);
    const bool is_planar = reference.law == ReceiverLaw::planar;
    if (!usual || !is_planar) {
      reference.point = moved;
      reference.start = tracer_.tracer_point(moved);
    }
    // Rays start at the clearance; as far again is left to the rounding of a hit.
    constexpr double closest = 4.0;
    for (const TouchedPlane& plane : planes) {
      if (!is_planar) reference.least_height_m = std::max(reference.least_height_m, closest * plane.clearance_m);
    }
    return reference;
  }

 private:
  // The planes close to a reference point, each once; of parallel ones the closest.
  std::vector<TouchedPlane> touched(const ReferencePoint& reference, std::vector<CloseTriangle> close) const {
    constexpr double same_plane = 1.0 - 1e-6;  // cosine
    constexpr double along = 1e-6;             // cosine below which a receiver looks along a plane
    std::stable_sort(close.begin(), close.end(), [](const CloseTriangle& a, const CloseTriangle& b) {
      return std::abs(a.distance_m) < std::abs(b.distance_m);
    });
    std::vector<TouchedPlane> planes;
    for (const CloseTriangle& triangle : close) {
      const double rounding = NearPlane{reference.point, triangle.corner, triangle.normal, extent_m_}.rounding();
      const double distance = triangle.distance_m;
      const double clearance = tracer_.clearance_m(triangle.normal);
      if (std::abs(distance) > std::max(2.0 * clearance, rounding)) continue;
      const bool known = std::any_of(planes.begin(), planes.end(), [&](const TouchedPlane& plane) {
        return std::abs(glm::dot(plane.normal, triangle.normal)) > same_plane;
      });
      if (known) continue;
      // A cylinder looks to all sides.
      const double cosine = reference.law == ReceiverLaw::planar ? glm::dot(reference.normal, triangle.normal) : 0.0;
      const double side = std::abs(distance) > rounding ? distance : std::abs(cosine) > along ? cosine : 0.0;
      const double sign = side < 0.0 ? -1.0 : 1.0;
      planes.push_back({sign * triangle.normal, sign * distance, clearance, side != 0.0});
    }
    return planes;
  }

  // Decides for the planes that the receiver looks along: the first combination of sides, fronts before backs, that
  // belongs to the room and sees an emitter; if none does, the first that belongs to the room.
  void choose_sides(const glm::dvec3& point, std::vector<TouchedPlane>& planes) {
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      if (!planes[k].decided) open.push_back(k);
    }
    constexpr std::size_t most = 6;  // 64 combinations; where more planes meet in a point, the fronts count
    if (open.empty() || open.size() > most) return;
    const std::vector<TouchedPlane> fronts = planes;
    bool found = false;
    for (std::size_t sides = 0; sides < std::size_t{1} << open.size(); ++sides) {
      std::vector<TouchedPlane> turned = fronts;
      for (std::size_t k = 0; k < open.size(); ++k) {
        if ((sides >> k & 1U) == 0) continue;
        turned[open[k]].normal *= -1.0;
        turned[open[k]].height_m *= -1.0;
      }
      const glm::dvec3 there = point + way_off(turned);
      if (!is_in_room(there)) continue;
      const bool is_lit = convex_ || sees_emitter(there);
      if (!found || is_lit) planes = turned;
      if (is_lit) return;
      found = true;
    }
  }

  // The way from the receiver to a point that is clear of all planes, each on its side: repeated projections onto the
  // half spaces, which converge to a point of all of them if there is one.
  static glm::dvec3 way_off(const std::vector<TouchedPlane>& planes) {
    constexpr int most_rounds = 64;  // reaches 99 % of the clearance in wedges down to some 15°
    constexpr double enough = 0.99;
    glm::dvec3 way(0.0);
    for (int round = 0; round < most_rounds; ++round) {
      bool clear = true;
      for (const TouchedPlane& plane : planes) {
        const double height = plane.height_m + glm::dot(way, plane.normal);
        if (height >= enough * plane.clearance_m) continue;
        way += (plane.clearance_m - height) * plane.normal;
        clear = false;
      }
      if (clear) break;
    }
    return way;
  }

  bool is_in_room(const glm::dvec3& point) {
    if (convex_) return !convex_->way_out(glm::vec3(tracer_.tracer_point(point)));
    if (enclosure_ == nullptr) find_lit_shells();
    const Shells shells = enclosure_->shells_around(point);
    return std::find(lit_.begin(), lit_.end(), shells) != lit_.end();
  }

  // Whether no surface lies between a point and one of some points where light starts.
  bool sees_emitter(const glm::dvec3& point) const {
    const glm::dvec3 start = tracer_.tracer_point(point);
    TraceCount not_counted;
    return std::any_of(origins_.begin(), origins_.end(), [&](const LightOrigin& origin) {
      if (origin.normal && glm::dot(point - origin.point, *origin.normal) <= 0.0) return false;
      const auto segment = shadow_segment(tracer_, start, origin.point);
      return !segment || !tracer_.is_blocked(glm::vec3(start), *segment, not_counted);
    });
  }

  // Where light starts, and the sets of closed shells around it.
  void find_lit_shells() {
    enclosure_ = tracer_.prepared() != nullptr ? &tracer_.prepared()->enclosure() : &own_enclosure_.emplace(room_);
    const auto add = [this](const glm::dvec3& point, const std::optional<glm::dvec3>& normal) {
      origins_.push_back({point, normal});
      lit_.push_back(enclosure_->shells_around(point));
    };
    for (const Emitter& emitter : room_.emitters) {
      if (emitter.power == 0.0) continue;
      visit_shape(
          emitter,
          [&](const auto& point) {
            const glm::dvec3 axis = frame_of(point).normal;
            add(point.position + 2.0 * tracer_.clearance_m(axis) * axis, std::nullopt);
          },
          [&](const auto& area_light) {
            for (const TriangleSample& triangle : sample_triangles(room_.surfaces[area_light.surface]))
              add(triangle.middle + 2.0 * tracer_.clearance_m(triangle.normal) * triangle.normal, triangle.normal);
          });
    }
  }

  const Room& room_;
  const Tracer& tracer_;
  double extent_m_ = 0.0;
  std::optional<ConvexRoom> convex_;  // only if nothing casts a shadow
  const Enclosure* enclosure_ = nullptr;
  std::optional<Enclosure> own_enclosure_;  // of a tracer that needs none itself
  std::vector<LightOrigin> origins_;
  std::vector<Shells> lit_;  // of each
};

}  // namespace

std::vector<ReferencePoint> receiver_points(const Room& room, const Tracer& tracer) {
  ReceiverPlacer placer(room, tracer);
  std::vector<glm::dvec3> positions;
  for (const Receiver& receiver : room.receivers) positions.push_back(receiver.position);
  const auto close = close_triangles(room, positions, placer.reach_m());
  std::vector<ReferencePoint> points;
  for (std::size_t k = 0; k < room.receivers.size(); ++k) points.push_back(placer.place(room.receivers[k], close[k]));
  return points;
}

}  // namespace lichtmc
