// The walls around a floor of a room, as polygons.
//
// A wall is where the room ends: what reaches from the floor to the ceiling. Furniture is none: the room goes on above
// it. Openings in walls up to 2.5 m wide and high, as doors and windows with what is above them, belong to the wall:
// so a door divides a floor into parts, and the depth of a window is no part of the room.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

#include "run/lit_space.hpp"

namespace lichtmc {

// A line (x, z), m.
using PlanLine = std::array<glm::dvec2, 2>;

// A part of a floor that walls separate from others.
struct FloorPart {
  std::vector<PlanLine> outline;  // closed polygons: outer walls, and bodies from floor to ceiling
  std::vector<PlanLine> walls;    // those of the outline, and thin walls that end within the part
  double floor_m = 0.0;           // m, the most frequent height of its floor
  double lowest_m = 0.0;
  double highest_m = 0.0;
  double area_m2 = 0.0;  // about
};

// The parts of a floor, by position (z, then x). Walls are found to the tracer's resolution; what is smaller than the
// raster of `space`, 0.25 m, may be overlooked.
std::vector<FloorPart> parts_of_floor(LitSpace& space, std::size_t floor);

// Whether a point lies within a closed outline.
bool is_within(const std::vector<PlanLine>& outline, const glm::dvec2& at);
// From a point to the nearest of some lines, in m; infinite if there are none.
double distance_to(const std::vector<PlanLine>& lines, const glm::dvec2& at);

}  // namespace lichtmc
