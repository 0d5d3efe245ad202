// Areas that are drawn: triangles in one plane.
#include "lichtmc/lay_areas.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "room/bounds.hpp"
#include "run/area_places.hpp"
#include "run/area_points.hpp"
#include "run/floor_outline.hpp"

namespace lichtmc {

namespace {

glm::dvec3 double_area(const SpaceTriangle& t) {
  return glm::cross(t[1] - t[0], t[2] - t[0]);
}

// The plane of an area's triangles.
AreaPlane plane_of(const AreaRequest& request, double extent_m) {
  const std::string of = "calculation area " + in_quotes(request.properties.name);
  glm::dvec3 sum(0.0);
  double whole = 0.0;
  for (const SpaceTriangle& triangle : request.triangles) {
    sum += double_area(triangle);
    whole += glm::length(double_area(triangle));
  }
  if (!(whole > 0.0) || !std::isfinite(whole))
    throw InputError("The area in m² of the " + of + " is " + to_text(0.5 * whole) +
                     " (allowed: a finite number above 0). Draw a face, or give two edges in different directions.");
  constexpr double together = 0.99;
  if (glm::length(sum) < together * whole)
    throw InputError("The faces of the " + of +
                     " do not look in one direction (allowed: all of them). Recalculate its normals, or draw it as one "
                     "face.");
  glm::dvec3 middle(0.0);
  double size = 0.0;
  for (const SpaceTriangle& triangle : request.triangles) {
    middle += glm::length(double_area(triangle)) / whole * (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    for (const glm::dvec3& corner : triangle) size = std::max(size, glm::length(corner - request.triangles[0][0]));
  }
  const AreaPlane plane(middle, glm::normalize(sum));
  // A millimetre does not change an illuminance. In large areas: a slope that counts as level; floats far from the
  // origin.
  const double allowed = std::max({1e-3, 1e-3 * size, 1e-6 * extent_m});
  double off = 0.0;
  for (const SpaceTriangle& triangle : request.triangles) {
    for (const glm::dvec3& corner : triangle)
      off = std::max(off, std::abs(glm::dot(corner - plane.origin, plane.normal)));
  }
  if (off > allowed)
    throw InputError("The faces of the " + of + " do not lie in one plane: a corner is " + rounded(off, 3) +
                     " m off it (allowed: " + rounded(allowed, 3) + " m). Draw it flat.");
  return plane;
}

bool measures_from_above(const AreaProperties& properties, const AreaPlane& plane) {
  if (properties.quantity) return *properties.quantity != AreaQuantity::normal;
  return plane.is_level() && properties.role != "ceiling";
}

class AreaLayer {
 public:
  explicit AreaLayer(const Room& room) : space_(room), places_(space_) { space_.rooms.find_dark_rooms(); }

  void lay(const AreaRequest& request, Room& room) {
    check_properties(room, request.properties);
    const AreaProperties& properties = request.properties;
    const double extent = glm::length(space_.tracer.high() - space_.tracer.low());
    AreaPlane plane = plane_of(request, extent);
    const bool from_above = measures_from_above(properties, plane);
    const AreaQuantity quantity =
        properties.quantity.value_or(from_above ? AreaQuantity::horizontal : AreaQuantity::normal);
    // Whatever the winding: what is measured is the light from above.
    if (plane.is_level() && from_above) plane = AreaPlane(plane.origin, {0.0, 1.0, 0.0});
    const AreaShape shape(plane, request.triangles, 4.0 * space_.tracer.rounding());
    find_rooms(shape);
    const double margin = margin_of(properties, shape);
    Area area = area_in(plane, rectangle_of(shape, margin), properties, quantity, margin);
    for (const PlanLine& line : shape.outline)
      area.outline.push_back({plane.in_space(line[0]), plane.in_space(line[1])});
    note_usual_margin(area);
    if (plane.is_level() && floor_m_) area.above_floor_m = plane.origin.y - *floor_m_;
    const std::vector<AreaCell> cells = cells_of(area, shape);
    add_area(room, std::move(area), cells);
  }

 private:
  // Of the area's rooms and floors: the walls, and the height of the floor under most of it.
  void find_rooms(const AreaShape& shape) {
    constexpr int places = 16;
    const PlaneRectangle rectangle = rectangle_around(shape.corners());
    std::vector<glm::dvec3> points;
    for (int k = 0; k < places * places; ++k) {
      const glm::dvec2 share((k % places + 0.5) / places, (k / places + 0.5) / places);
      const glm::dvec2 p = rectangle.point(rectangle.low + share * rectangle.size());
      if (shape.contains(p)) points.push_back(shape.plane.in_space(p));
    }
    std::map<std::size_t, std::map<double, int>> heights;  // of each floor
    for (const AreaPlace& place : places_.of(points, shape.plane.normal)) {
      if (!place.is_lit()) continue;
      const FloorPoints::FloorBelow floor = places_.floor_below(place);
      if (floor.floor != no_number) ++heights[floor.floor][floor.height_m];
    }
    walls_.clear();
    floor_m_.reset();
    int most = 0;
    for (const auto& [floor, counts] : heights) {
      if (shape.plane.is_level()) add_walls(floor);
      for (const auto& [height, count] : counts) {
        if (count <= most) continue;
        most = count;
        floor_m_ = height;
      }
    }
  }

  void add_walls(std::size_t floor) {
    const auto [found, fresh] = walls_of_.try_emplace(floor);
    if (fresh) {
      for (const FloorPart& part : parts_of_floor(space_, floor))
        found->second.insert(found->second.end(), part.walls.begin(), part.walls.end());
    }
    walls_.insert(walls_.end(), found->second.begin(), found->second.end());
  }

  double margin_of(const AreaProperties& properties, const AreaShape& shape) const {
    constexpr double usual_m = 0.5;
    if (properties.margin_m) return *properties.margin_m;
    return shape.plane.is_level() && properties.role != "task" ? usual_m : 0.0;
  }

  // Of a level area from the walls, of others from their own outline.
  bool within_margin(const AreaShape& shape, double margin, const glm::dvec2& p, double slack) const {
    if (margin == 0.0) return false;
    if (!shape.plane.is_level()) return distance_to(shape.outline, p) < margin - slack;
    const glm::dvec3 place = shape.plane.in_space(p);
    return distance_to(walls_, {place.x, place.z}) < margin - slack;
  }

  PlaneRectangle rectangle_of(const AreaShape& shape, double margin) const {
    const PlaneRectangle whole = rectangle_around(shape.corners());
    if (margin == 0.0) return whole;
    if (!shape.plane.is_level()) return shrunk(whole, margin);
    return shrunk_to(
        whole, [&](const glm::dvec2& p) { return shape.contains(p) && !within_margin(shape, margin, p, 0.0); },
        space_.tracer.rounding());
  }

  std::vector<AreaCell> cells_of(Area& area, const AreaShape& shape) const {
    std::vector<glm::dvec3> points;
    for (std::uint32_t k = 0; k < area.columns * area.rows; ++k) points.push_back(area.centre(k));
    const std::vector<AreaPlace> places = places_.of(points, area.normal);
    std::vector<AreaCell> cells(points.size());
    std::vector<std::size_t> inside;
    std::size_t on_surfaces = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const glm::dvec2 p = shape.plane.on_plane(points[k]);
      if (!shape.contains(p)) {
        cells[k].left_out = outside_its_outline;
      } else if (within_margin(shape, area.margin_m, p, 4.0 * space_.tracer.rounding())) {
        cells[k].left_out = within(area.margin_m, shape.plane.is_level() ? "a wall" : "its edges");
      } else {
        inside.push_back(k);
        cells[k].left_out = why_left_out(places[k].place);
        cells[k].point = point_of(area, places[k]);
        on_surfaces += is_on_furniture(places[k]) ? 1U : 0U;
      }
    }
    if (area.quantity == AreaQuantity::normal) refuse_turned(area, points, places, inside);
    if (on_surfaces > 0)
      area.notes.push_back(std::to_string(on_surfaces) +
                           (on_surfaces == 1 ? " of its points lies" : " of its points lie") +
                           " on table tops or the like.");
    return cells;
  }

  // A cylinder on a surface stands beside it.
  static glm::dvec3 point_of(const Area& area, const AreaPlace& place) {
    const bool planar = area.quantity == AreaQuantity::normal || area.quantity == AreaQuantity::horizontal;
    return planar ? place.point : place.beside;
  }

  bool is_on_furniture(const AreaPlace& place) const {
    if (place.place != PointPlace::on_surface) return false;
    const FloorPoints::FloorBelow floor = places_.floor_below(place);
    return floor.floor == no_number || place.point.y - floor.height_m > space_.tracer.rounding();
  }

  // An area that lies on a surface with its back to the light.
  void refuse_turned(const Area& area, const std::vector<glm::dvec3>& points, const std::vector<AreaPlace>& places,
                     const std::vector<std::size_t>& inside) const {
    constexpr double close_m = 0.05;
    const std::vector<AreaPlace> backs = places_.of(points, -area.normal);
    std::size_t turned = 0;
    for (const std::size_t k : inside) {
      if (!backs[k].is_lit() || places_.room_before(backs[k], -area.normal) < close_m) continue;
      if (!places[k].is_lit() || places_.room_before(places[k], area.normal) < close_m) ++turned;
    }
    if (2 * turned <= inside.size()) return;
    throw InputError("The calculation area " + in_quotes(area.properties.name) +
                     " looks at a surface close to it, and the room is behind it: its normal is (" +
                     decimal(area.normal.x, 3) + ", " + decimal(area.normal.y, 3) + ", " + decimal(area.normal.z, 3) +
                     ") (allowed: a normal into the room). Flip its face (in Blender: Mesh > Normals > Flip), or swap "
                     "its two edges.");
  }

  LitSpace space_;
  AreaPlaces places_;
  std::map<std::size_t, std::vector<PlanLine>> walls_of_;  // of each floor
  std::vector<PlanLine> walls_;                            // near the area in hand
  std::optional<double> floor_m_;
};

}  // namespace

void lay_areas(Room& room) {
  if (room.area_requests.empty()) return;
  AreaLayer layer(room);
  for (const AreaRequest& request : room.area_requests) layer.lay(request, room);
  room.area_requests.clear();
}

}  // namespace lichtmc
