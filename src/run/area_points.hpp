// From the rectangle of an area to its receivers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lichtmc/lay_areas.hpp"
#include "run/area_shape.hpp"

namespace lichtmc {

// A cell of a grid: its point, or why it has none.
struct AreaCell {
  glm::dvec3 point{0.0};  // m
  std::string left_out;   // "outside its outline"; empty: it has a point
};

inline constexpr const char* outside_its_outline = "outside its outline";

// Throws InputError naming the area if a property is out of its range, or the room has an area of this name.
void check_properties(const Room& room, const AreaProperties& properties);

// An area in a plane, without points. Throws InputError if the rectangle is empty.
Area area_in(const AreaPlane& plane, const PlaneRectangle& rectangle, const AreaProperties& properties,
             AreaQuantity quantity, double margin_m);

// Whether anything is left of a rectangle, and a message for areas without.
[[noreturn]] void refuse_empty(const AreaProperties& properties, double margin_m);

// Adds an area, and a receiver for each of its cells that has a point, to a room. Throws InputError naming the area if
// none has.
void add_area(Room& room, Area area, const std::vector<AreaCell>& cells);

// "within 0.5 m of a wall"
// Adds a note if the margin that an area has by default makes its grid smaller than its outline: no cell is left out
// then that would tell it.
void note_usual_margin(Area& area);

std::string within(double margin_m, const char* of_what);

}  // namespace lichtmc
