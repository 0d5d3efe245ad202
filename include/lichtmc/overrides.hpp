// Mending a room on request: what a file leaves out or says wrongly can be set right before the simulation. Each change
// is noted in Room::mended.
#pragma once

#include <string>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Sets the reflectance (0 … 1) of every surface with this material, in place of its map where it has one. Throws
// InputError where the room has no such material (the message lists those it has) or the reflectance is out of range.
void set_reflectance(Room& room, const std::string& material, double reflectance);

// Lowers every reflectance above `highest` (0 … 1) to it, in maps too. Throws InputError where it is out of range.
void limit_reflectance(Room& room, double highest);

// Adds an emitter whose power is of the given kind. A room without emitters becomes a room of that kind; otherwise the
// kinds must agree, or InputError is thrown.
void add_emitter(Room& room, Emitter emitter, Quantity quantity);

}  // namespace lichtmc
