// Areas on surfaces of the room.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/lay_areas.hpp"
#include "room/emitter_shape.hpp"
#include "room/surface_choice.hpp"
#include "run/area_places.hpp"
#include "run/area_points.hpp"

namespace lichtmc {

namespace {

SpaceTriangle corners_of(const Surface& surface, const glm::uvec3& t) {
  return {surface.positions[t.x], surface.positions[t.y], surface.positions[t.z]};
}

// Triangles of a surface in one plane, seen from a side that light reaches.
struct LitSide {
  AreaPlane plane;
  std::vector<SpaceTriangle> triangles;
  double area_m2 = 0.0;
  double lit_m2 = 0.0;
};

class SurfaceAreas {
 public:
  explicit SurfaceAreas(const Room& room) : space_(room), places_(space_) {}

  void lay(const Room& of, std::size_t number, AreaProperties properties, Room& room) {
    const Surface& surface = of.surfaces[number];
    const LitSide side = lit_side(surface);
    const double margin = properties.margin_m.value_or(0.0);
    const AreaShape shape(side.plane, side.triangles, 4.0 * space_.tracer.rounding());
    const PlaneRectangle rectangle = shrunk(rectangle_around(shape.corners()), margin);
    const AreaQuantity quantity = properties.quantity.value_or(AreaQuantity::normal);
    Area area = area_in(side.plane, rectangle, properties, quantity, margin);
    for (const PlanLine& line : shape.outline)
      area.outline.push_back({side.plane.in_space(line[0]), side.plane.in_space(line[1])});
    area.notes.push_back("It lies on the surface " + in_quotes(surface.name) + ".");
    const std::vector<AreaCell> cells = cells_of(area, shape);
    add_area(room, std::move(area), cells);
  }

 private:
  std::vector<AreaCell> cells_of(const Area& area, const AreaShape& shape) const {
    std::vector<glm::dvec3> points;
    for (std::uint32_t k = 0; k < area.columns * area.rows; ++k) points.push_back(area.centre(k));
    const std::vector<AreaPlace> places = places_.of(points, area.normal);
    const bool planar = area.quantity == AreaQuantity::normal;
    std::vector<AreaCell> cells(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const glm::dvec2 p = shape.plane.on_plane(points[k]);
      cells[k].point = planar ? points[k] : places[k].beside;
      if (!shape.contains(p)) {
        cells[k].left_out = outside_its_outline;
      } else if (distance_to(shape.outline, p) < area.margin_m - 4.0 * space_.tracer.rounding()) {
        cells[k].left_out = within(area.margin_m, "its edges");
      } else if (!places[k].is_lit()) {
        cells[k].left_out = "covered, or where no light gets";
      }
    }
    return cells;
  }

  // The flat part of a surface that most light reaches: it must have more than half of what light reaches of it.
  LitSide lit_side(const Surface& surface) const {
    std::vector<LitSide> sides = sides_of(surface);
    std::erase_if(sides, [](const LitSide& side) { return side.lit_m2 <= 0.0; });
    if (sides.empty())
      throw InputError("No light reaches the surface " + in_quotes(surface.name) +
                       ", on which a calculation area is asked for (allowed: surfaces in a lit space). Choose another "
                       "surface.");
    const LitSide best = most_lit(sides);
    double whole = 0.0;
    double rest = 0.0;
    for (const LitSide& side : sides) {
      whole += side.lit_m2;
      const bool same = side.plane.normal == best.plane.normal && side.triangles == best.triangles;
      if (!same && !is_lower_side(side, best)) rest += side.lit_m2;
    }
    if (rest < best.lit_m2) return best;
    throw InputError("The surface " + in_quotes(surface.name) + " is not flat: light reaches " +
                     to_text(sides.size(), "flat part") + " of it, the largest has " + rounded(best.lit_m2, 3) +
                     " of " + rounded(whole, 3) +
                     " m² (allowed for a calculation area: more than half). Make its parts surfaces of their own, or "
                     "draw the area with --area.");
  }

  // Of equal ones, that which looks up, as a table top; else the first, the front of a sheet.
  static LitSide most_lit(const std::vector<LitSide>& sides) {
    constexpr double equal = 0.01;
    const LitSide* best = &sides.front();
    for (const LitSide& side : sides) {
      const bool more = side.lit_m2 > (1.0 + equal) * best->lit_m2;
      const bool upper = side.lit_m2 > (1.0 - equal) * best->lit_m2 && side.plane.normal.y > best->plane.normal.y + 0.1;
      if (more || upper) best = &side;
    }
    return *best;
  }

  // The back of a sheet, or the underside of a board whose upper side is meant.
  static bool is_lower_side(const LitSide& side, const LitSide& best) {
    constexpr double opposite = -1.0 + 1e-6;
    if (glm::dot(side.plane.normal, best.plane.normal) > opposite) return false;
    return best.plane.normal.y == 1.0 || side.triangles == best.triangles;
  }

  // Planes of the triangles, front and back.
  std::vector<LitSide> sides_of(const Surface& surface) const {
    std::vector<LitSide> sides;
    const double off = 4.0 * space_.tracer.rounding();
    constexpr double same_direction = 1.0 - 1e-6;
    for (const glm::uvec3& t : surface.triangles) {
      const SpaceTriangle corners = corners_of(surface, t);
      const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
      const double twice = glm::length(normal);
      if (!(twice > 0.0)) continue;
      for (const double sign : {1.0, -1.0}) {
        const AreaPlane plane(corners[0], sign * normal / twice);
        auto found = std::find_if(sides.begin(), sides.end(), [&](const LitSide& side) {
          return glm::dot(side.plane.normal, plane.normal) > same_direction &&
                 std::abs(glm::dot(corners[0] - side.plane.origin, side.plane.normal)) <= off;
        });
        if (found == sides.end()) found = sides.insert(sides.end(), LitSide{plane, {}, 0.0, 0.0});
        found->triangles.push_back(corners);
        found->area_m2 += 0.5 * twice;
        if (sides.size() > most_sides) return measured(std::move(sides));
      }
    }
    return measured(std::move(sides));
  }

  // How much of each light reaches, from 64 places on each triangle or, of many triangles, one.
  std::vector<LitSide> measured(std::vector<LitSide> sides) const {
    for (LitSide& side : sides) {
      const int n = side.triangles.size() > 64 ? 1 : 8;
      std::vector<glm::dvec3> points;
      std::vector<double> weights;
      for (const SpaceTriangle& t : side.triangles) {
        const double area = 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
        for (int k = 0; k < n * n; ++k) {
          const double r = std::sqrt((k / n + 0.5) / n);  // uniform over the triangle
          const double s = (k % n + 0.5) / n;
          points.push_back((1.0 - r) * t[0] + r * (1.0 - s) * t[1] + r * s * t[2]);
          weights.push_back(area / (n * n));
        }
      }
      const std::vector<AreaPlace> places = places_.of(points, side.plane.normal);
      for (std::size_t k = 0; k < places.size(); ++k) side.lit_m2 += places[k].is_lit() ? weights[k] : 0.0;
    }
    return sides;
  }

  static constexpr std::size_t most_sides = 1000;  // of a curved surface no part has more than half

  LitSpace space_;
  AreaPlaces places_;
};

}  // namespace

void lay_area_on(Room& room, const std::string& surface, const AreaProperties& properties) {
  const std::vector<std::size_t> chosen = chosen_surfaces(room, surface);
  AreaProperties named = properties;
  if (named.name.empty()) named.name = chosen.size() == 1 ? room.surfaces[chosen.front()].name : "surface";
  SurfaceAreas areas(room);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    AreaProperties own = named;
    if (chosen.size() > 1)
      own.name = properties.name.empty() ? room.surfaces[chosen[k]].name : named.name + "_" + std::to_string(k + 1);
    check_properties(room, own);
    for (const Emitter& emitter : room.emitters) {
      if (emitting_surface(emitter) != chosen[k]) continue;
      throw InputError("The calculation area " + in_quotes(own.name) + " lies on the surface " +
                       in_quotes(room.surfaces[chosen[k]].name) +
                       ", which is an emitter (allowed: surfaces that only reflect). Choose another surface.");
    }
    areas.lay(room, chosen[k], std::move(own), room);
  }
}

}  // namespace lichtmc
