// Input overrides: values of a room file that are replaced or added on request before the simulation. Each change is
// recorded in Room::overrides.
#pragma once

#include <string>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Sets the reflectance (0 … 1) of every surface with this material; it replaces a reflectance map. Throws InputError if
// the room has no such material (the message lists its materials) or the reflectance is out of range.
void set_reflectance(Room& room, const std::string& material, double reflectance);

// Lowers every reflectance above `highest` (0 … 1) to `highest`, in reflectance maps too. Throws InputError if it is
// out of range.
void limit_reflectance(Room& room, double highest);

// Adds an emitter whose power is the given quantity. A room without emitters takes this quantity; otherwise both must
// agree. Throws InputError if they do not.
void add_emitter(Room& room, Emitter emitter, Quantity quantity);

}  // namespace lichtmc
