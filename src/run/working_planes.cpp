// Working planes: areas at a height above the floors of a room.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/lay_areas.hpp"
#include "run/area_places.hpp"
#include "run/area_points.hpp"
#include "run/floor_outline.hpp"
#include "run/floor_points.hpp"
#include "run/lit_space.hpp"

namespace lichtmc {

namespace {

struct WorkingPlane {
  Area area;
  std::vector<AreaCell> cells;
  std::size_t points = 0;
};

class PlaneLayer {
 public:
  PlaneLayer(LitSpace& space, double height_m, const AreaProperties& properties, double margin_m)
      : space_(space), points_(space), height_(height_m), properties_(properties), margin_(margin_m) {}

  // From below, then by position; those without points are counted.
  std::vector<WorkingPlane> planes() {
    std::vector<WorkingPlane> planes;
    for (const std::size_t room : points_.order()) {
      for (const std::size_t floor : points_.floors_of(room)) {
        for (const FloorPart& part : parts_of_floor(space_, floor)) {
          if (is_niche(part)) continue;
          WorkingPlane plane;
          if (lay(part, room, floor, plane)) {
            planes.push_back(std::move(plane));
          } else {
            ++without_points_;
          }
        }
      }
    }
    return planes;
  }

  std::size_t without_points() const { return without_points_; }

 private:
  // Less than 1 m² (in small models, in proportion) between walls is no room: the depth of a door or window.
  bool is_niche(const FloorPart& part) const {
    constexpr double least_square_steps = 16.0;
    return part.area_m2 < least_square_steps * space_.rooms.step() * space_.rooms.step();
  }

  bool lay(const FloorPart& part, std::size_t room, std::size_t floor, WorkingPlane& plane) {
    std::vector<glm::dvec2> corners;
    for (const PlanLine& line : part.outline) corners.push_back(line[0]);
    if (corners.size() < 3) return false;
    const PlaneRectangle rectangle = shrunk(rectangle_around(corners), margin_);
    if (rectangle.empty()) return false;
    const double y = part.floor_m + height_;
    const AreaPlane level({0.0, y, 0.0}, {0.0, 1.0, 0.0});
    plane.area =
        area_in(level, rectangle, properties_, properties_.quantity.value_or(AreaQuantity::horizontal), margin_);
    plane.area.above_floor_m = height_;
    for (const PlanLine& line : part.outline)
      plane.area.outline.push_back({level.in_space(line[0]), level.in_space(line[1])});
    place_points(part, room, floor, plane);
    return plane.points > 0;
  }

  void place_points(const FloorPart& part, std::size_t room, std::size_t floor, WorkingPlane& plane) {
    const Area& area = plane.area;
    std::vector<glm::dvec2> places;
    for (std::uint32_t k = 0; k < area.columns * area.rows; ++k) {
      const glm::dvec3 centre = area.centre(k);
      places.emplace_back(centre.x, centre.z);
    }
    const std::vector<Column> lines = space_.tracer.columns(places);
    std::size_t on_surfaces = 0;
    for (const Column& line : lines) {
      AreaCell cell;
      const FloorPoint point = points_.at(line, room, floor, height_);
      if (!is_within(part.outline, line.at)) {
        cell.left_out = outside_its_outline;
      } else if (distance_to(part.walls, line.at) < margin_ - 4.0 * space_.tracer.rounding()) {
        cell.left_out = within(margin_, "a wall");
      } else {
        cell.left_out =
            point.place == PointPlace::no_floor ? "with no floor of this storey below" : why_left_out(point.place);
        cell.point = {line.at.x, point.y, line.at.y};
        on_surfaces += point.place == PointPlace::on_surface ? 1U : 0U;
        plane.points += cell.left_out.empty() ? 1U : 0U;
      }
      plane.cells.push_back(std::move(cell));
    }
    describe(part, on_surfaces, plane.area);
  }

  void describe(const FloorPart& part, std::size_t on_surfaces, Area& area) const {
    constexpr double noticeable_m = 1e-3;
    constexpr int millimetres = 3;
    if (on_surfaces > 0)
      area.notes.push_back(std::to_string(on_surfaces) +
                           (on_surfaces == 1 ? " of its points lies" : " of its points lie") +
                           " on table tops or the like.");
    if (part.highest_m - part.lowest_m > noticeable_m) {
      area.notes.push_back("Its floor lies between y = " + decimal(part.lowest_m, millimetres) + " m and " +
                           decimal(part.highest_m, millimetres) +
                           " m; each point is at this height above the floor "
                           "under it.");
    }
  }

  LitSpace& space_;
  FloorPoints points_;
  double height_;
  const AreaProperties& properties_;
  double margin_;
  std::size_t without_points_ = 0;
};

// "A room of about 20 m² around x = 7.2, y = 0, z = −2.5 m has no light and no working plane." The largest three.
std::string without_light(std::vector<DarkRoom> rooms) {
  constexpr std::size_t most = 3;
  std::sort(rooms.begin(), rooms.end(), [](const DarkRoom& a, const DarkRoom& b) { return a.area_m2 > b.area_m2; });
  std::string list;
  for (std::size_t k = 0; k < std::min(most, rooms.size()); ++k) {
    const DarkRoom& room = rooms[k];
    list += (k > 0 ? "; " : "") + rounded(room.area_m2, 2) + " m² around x = " + decimal(room.middle.x, 1) +
            ", y = " + decimal(room.floor_m, 1) + ", z = " + decimal(room.middle.y, 1) + " m";
  }
  if (rooms.size() == 1) return "A room of about " + list + " has no light and no working plane.";
  return to_text(rooms.size(), "room") + " have no light and no working plane: " + list +
         (rooms.size() > most ? "; …." : ".");
}

}  // namespace

void lay_working_planes(Room& room, double height_m, const AreaProperties& properties) {
  constexpr double usual_margin_m = 0.5;
  AreaProperties named = properties;
  if (!std::isfinite(height_m))
    throw InputError("The height of the working plane " + in_quotes(properties.name) + " is " + to_text(height_m) +
                     " m (allowed: a finite number). Give the height above the floor in metres, for example 0.75.");
  check_properties(room, properties);
  const double margin_m = properties.margin_m.value_or(usual_margin_m);
  LitSpace space(room);
  space.rooms.find_dark_rooms();
  PlaneLayer layer(space, height_m, properties, margin_m);
  std::vector<WorkingPlane> planes = layer.planes();
  if (planes.empty()) {
    throw InputError("No point of the working plane " + in_quotes(properties.name) + ", " + to_text(height_m) +
                     " m above the floors of " + room.source + " with a margin of " + to_text(margin_m) +
                     " m, lies in a space that light reaches. Give it another height, or a smaller margin or spacing.");
  }
  if (layer.without_points() > 0) {
    planes.front().area.notes.push_back(to_text(layer.without_points(), "part") +
                                        " of the floors, too narrow for this margin and spacing, " +
                                        (layer.without_points() == 1 ? "has" : "have") + " no points.");
  }
  if (!room.emitters.empty() && !space.rooms.dark_rooms().empty())
    planes.front().area.notes.push_back(without_light(space.rooms.dark_rooms()));
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (planes.size() > 1) {
      named.name = properties.name + "_" + std::to_string(k + 1);
      check_properties(room, named);
      planes[k].area.properties.name = named.name;
    }
    add_area(room, std::move(planes[k].area), planes[k].cells);
  }
}

}  // namespace lichtmc
