// Points that closed walls separate from the light.
//
// No way leads from a point to another without crossing a surface if one of them lies in a closed shell that does not
// contain the other. So light reaches only points that lie in the same closed shells as an emitter. A cuboid counts as
// a closed shell, also where its walls meet in T-junctions.
#pragma once

#include <vector>

#include "lichtmc/room.hpp"
#include "room/enclosure.hpp"

namespace lichtmc {

enum class Separation {
  none,     // no closed shell lies between the point and every emitter, or the point lies on a surface
  outside,  // closed shells lie between it and every emitter; it is in no closed shell
  inside,   // the same, and it is in a closed shell: within a wall, or in a closed body
};

// Of each receiver of the room. enclosure: of the room, if it is known.
std::vector<Separation> separation_of_receivers(const Room& room, const Enclosure* enclosure = nullptr);

// Whether each emitter lies outside a closed room, or shines out of it. A room is closed if a closed shell extends over
// all of it and closed shells contain more than a half of its bounding box (a building of solid walls with openings is
// one shell, too, but its rooms are outside of that). An emitter is outside if no closed shell contains the start of
// its light and in a quarter of all directions nothing is hit from there: in a cave it is not. Rooms so large that this
// test would take more than about a second have no emitters outside in this sense.
std::vector<bool> emitters_beyond_walls(const Room& room, const Enclosure* enclosure = nullptr);

}  // namespace lichtmc
