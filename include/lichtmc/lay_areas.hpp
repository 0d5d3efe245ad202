// Gives calculation areas their grids: adds a receiver to the room for each point.
//
// The grid of EN 12464-1 (2011, 4.4 and A.1): cells of about p = 0.2 · 5^(log10 d) metres, p ≤ 10 m, where d is the
// longer side of the area, or the shorter if the longer is at least twice as long. The number of cells along d is the
// whole number nearest to d/p, along the other side that nearest to its length over the length of these cells; cells
// are between 1 : 2 and 2 : 1. The table of the standard (Table A.1) rounds p: for d = 0.4, 0.6, 25 and 50 m it has one
// point less or more than its formula, which is followed here. With AreaProperties::spacing_m that spacing takes the
// place of p, and no cell is longer.
//
// Points are left out outside the outline of an area, inside furniture and walls, where no light gets, and nearer to a
// wall than the margin. A wall is what reaches from the floor to the ceiling, furniture is none; doors and windows up
// to 2.5 m wide and high count as walls (docs/rooms.md).
#pragma once

#include <cstdint>
#include <string>

#include "lichtmc/area.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The number of cells along a side.
struct GridSize {
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
};
// Of an area of this width and height (m, > 0).
GridSize grid_of_en_12464(double width_m, double height_m);
GridSize grid_with_spacing(double width_m, double height_m, double spacing_m);

// Lays out Room::area_requests, in their order, and clears them. Margin: 0 for the role "task"; for others 0.5 m from
// the walls where the area is level, else 0. Throws InputError naming the area if its triangles do not lie in one
// plane, a property is out of its range, or no point is left.
void lay_areas(Room& room);

// Working planes, `height_m` above the floor: one for each part of a floor that walls enclose, that follows its outline
// with the margin [0.5 m]; its grid is centred on it. Rooms that an opening wider than a door connects are one part.
// Points on a surface, as a table top, are on its upper side. properties.name is that of the plane; with several they
// are numbered from below, then by position. Throws InputError as above.
void lay_working_planes(Room& room, double height_m, const AreaProperties& properties);

// An area on a surface of the room (name or pattern as for set_reflectance()), on the side that light reaches (of a
// table top, the upper side); one for each surface; the margin [0] is from its edges. Its name is that of the surface
// unless properties have one; with several surfaces that is numbered. Throws InputError as above, and if the surface
// emits, or has no flat part with more than half of what light reaches of it.
void lay_area_on(Room& room, const std::string& surface, const AreaProperties& properties);

// Whether an area measures less than its outline because of the margin that it has by default.
bool is_cut_by_usual_margin(const Area& area);
// Points of its grid that are left out for another reason than its outline and margin: inside furniture or walls,
// outside the rooms, where no light gets.
std::uint64_t misplaced_points(const Area& area);

// A sentence: "Area 'desk': 48 points …; left out: …".
std::string description_of(const Area& area);

}  // namespace lichtmc
