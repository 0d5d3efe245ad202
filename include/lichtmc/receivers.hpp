// A grid of receivers above the floors of a room.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

struct ReceiverGrid {
  std::vector<Receiver> receivers;
  std::vector<double> floors_m;      // heights of the floors under them, different by more than 1 mm, ascending
  std::size_t rooms = 0;             // with receivers
  std::size_t on_surfaces = 0;       // receivers that lie on a surface above the floor, as a table top
  std::size_t inside_furniture = 0;  // points left out: inside a body that stands on the floor
  std::size_t inside_walls = 0;      // points left out: inside walls or in spaces that no light reaches
  std::size_t without_floor = 0;     // points left out: no floor of the room is under them
};

// Receivers with normals upwards, `height_m` metres above the floor under them, `spacing_m` (> 0) metres apart along x
// and z and at least half of that from the bounds of their room.
//
// Every room that the light of the emitters reaches has a grid of its own, which is centred on it; rooms that are
// connected by open doors are one room. Every floor of a room counts: storeys, galleries, podiums, ramps. The tops of
// furniture are not floors, see run/lit_rooms.hpp. A point that lies exactly on a surface, as a table top, is on its
// upper side. Points inside furniture and walls and points with no floor under them (outside an L-shaped room) are left
// out. If the room has no emitter, that of `lichtmc check` is used, at a point inside it.
//
// Names are "grid_COLUMN_ROW"; with several rooms "gridR_COLUMN_ROW", with several floors in a room
// "gridRfF_COLUMN_ROW", numbered from 1, R by position and F from below. Area 1 m²; the field of view is the whole
// hemisphere.
//
// Throws InputError if height or spacing is not a finite number, the spacing is not above 0, the room is not valid, or
// no point is left.
ReceiverGrid lay_receiver_grid(const Room& room, double height_m, double spacing_m);

// The receivers of lay_receiver_grid().
std::vector<Receiver> receiver_grid(const Room& room, double height_m, double spacing_m);

// A sentence about heights and points left out: "320 receivers 0.75 m above the floor at y = 0.1255 m; …".
std::string description_of(const ReceiverGrid& grid, double height_m);

}  // namespace lichtmc
