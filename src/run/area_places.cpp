#include "run/area_places.hpp"

namespace lichtmc {

std::vector<AreaPlace> AreaPlaces::of(const std::vector<glm::dvec3>& points, const glm::dvec3& normal) const {
  // Surfaces closer than the tracer's rounding count as one; lines that close to a wall may lie on either side of it.
  constexpr double roundings = 8.0;
  const bool upwards = normal.y == 1.0;
  const glm::dvec3 off = upwards ? glm::dvec3(0.0) : roundings * space_.tracer.rounding() * normal;
  std::vector<glm::dvec2> lines;
  for (const glm::dvec3& point : points) lines.emplace_back(point.x + off.x, point.z + off.z);
  const std::vector<Column> columns = space_.tracer.columns(lines);
  std::vector<AreaPlace> places;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const FloorPoints::Level level = floors_.at_level(columns[k], points[k].y + off.y);
    AreaPlace place{level.place, level.room, points[k], points[k] + off};
    if (upwards) place.point.y = place.beside.y = level.y;
    places.push_back(place);
  }
  return places;
}

FloorPoints::FloorBelow AreaPlaces::floor_below(const AreaPlace& place) const {
  const Column line = space_.tracer.columns({{place.beside.x, place.beside.z}}).front();
  return floors_.floor_below(line, place.room, place.beside.y);
}

const char* why_left_out(PointPlace place) {
  switch (place) {
    case PointPlace::in_furniture:
    case PointPlace::in_wall:
      return "inside furniture, walls or other bodies";
    case PointPlace::no_light:
      return no_light_gets_there;
    case PointPlace::no_floor:
      return "outside the rooms";
    case PointPlace::free:
    case PointPlace::on_surface:
      break;
  }
  return "";
}

}  // namespace lichtmc
