// Whether light gets to the points of an area that lies anywhere in a room.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "run/floor_points.hpp"
#include "run/lit_space.hpp"

namespace lichtmc {

struct AreaPlace {
  PointPlace place = PointPlace::no_floor;
  std::size_t room = no_number;  // that the point lies in
  glm::dvec3 point{0.0};         // m, moved onto a surface that it lies on
  glm::dvec3 beside{0.0};        // m, off the area by as little as can be told apart: where its place was tested

  bool is_lit() const { return place == PointPlace::free || place == PointPlace::on_surface; }
};

class AreaPlaces {
 public:
  explicit AreaPlaces(LitSpace& space) : space_(space), floors_(space) {}

  // Of points on the side of an area to which a normal (length 1) points. Points on a surface belong to its upper side
  // if the normal points up.
  std::vector<AreaPlace> of(const std::vector<glm::dvec3>& points, const glm::dvec3& normal) const;

  // The floor of a point's room below it.
  FloorPoints::FloorBelow floor_below(const AreaPlace& place) const;

  // The distance from beside an area to what lies in the direction of its normal, m; infinite if nothing does.
  double room_before(const AreaPlace& place, const glm::dvec3& normal) const {
    return space_.tracer.distance(place.beside, normal);
  }

 private:
  LitSpace& space_;
  FloorPoints floors_;
};

inline constexpr const char* no_light_gets_there = "in a room where no light gets";

// "inside furniture, walls or other bodies", …; empty for places that light reaches.
const char* why_left_out(PointPlace place);

}  // namespace lichtmc
