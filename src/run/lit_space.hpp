// A room with all that is needed to find where in it light gets: for grids and areas of receivers.
#pragma once

#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "run/columns.hpp"
#include "run/lit_rooms.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

struct LitSpace {
  // Throws InputError if the room is not valid. Its receivers and areas are left out.
  explicit LitSpace(const Room& given);
  LitSpace(const LitSpace&) = delete;
  LitSpace& operator=(const LitSpace&) = delete;

  Tiling tiling;
  Room room;  // if it had no emitter: with one inside it, that of `lichtmc check`
  Scene scene;
  ColumnTracer tracer;
  LitRooms rooms;
};

}  // namespace lichtmc
