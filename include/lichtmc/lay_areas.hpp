// Gives calculation areas their grids: adds a receiver to the room for each point.
//
// The grid of EN 12464-1 (2021, 4.4; CIE x005): cells of at most p = 0.2 · 5^(log10 d) metres, p ≤ 10 m, where d is the
// longer side of the area, or the shorter if the longer is at least twice as long. The number of cells along d is the
// whole number nearest to d/p, along the other side that which makes cells nearest to square; cells are between 1 : 2
// and 2 : 1. With AreaProperties::spacing_m that spacing takes the place of p, and no cell is longer.
//
// Points are left out outside the outline of an area, inside furniture and walls, where no light gets, and nearer to a
// wall than the margin.
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

// Working planes, `height_m` above the floor: one per storey and closed room, that follows the outline of the room with
// the margin [0.5 m]. properties.name is that of the plane; with several they are numbered. Throws InputError as above.
void lay_working_planes(Room& room, double height_m, const AreaProperties& properties);

// An area on a surface of the room (name or pattern as for set_reflectance()), on the side that light reaches; one for
// each surface; the margin [0] is from its edges. Throws InputError as above, and if the surface is not flat.
void lay_area_on(Room& room, const std::string& surface, const AreaProperties& properties);

// A sentence: "Area 'desk': 48 points …; left out: …".
std::string description_of(const Area& area);

}  // namespace lichtmc
