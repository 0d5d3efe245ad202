// Input overrides: values of a room file that are replaced or added on request before the simulation. Each change is
// recorded in Room::overrides.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Sets the reflectance (0 … 1) of surfaces; it replaces a reflectance map. `name` is the name of a material, which
// means all its surfaces, or of a surface; "material:NAME" and "surface:NAME" mean only one of both. It may be a
// pattern with "*", "?" and "[…]". Throws InputError if there is none of this name (the message lists similar ones), if
// a name without prefix means a material and also a surface of another material, or if the reflectance is out of range.
void set_reflectance(Room& room, const std::string& name, double reflectance);

// Lowers every reflectance above `highest` (0 … 1) to `highest`, in reflectance maps too. Throws InputError if it is
// out of range.
void limit_reflectance(Room& room, double highest);

// Only the surfaces that one of the names chooses are measured; the others still reflect. Names and patterns are as for
// set_reflectance(), of materials or surfaces. Throws InputError if a name chooses no surface.
void measure_only(Room& room, const std::vector<std::string>& names);

// Sets the delay in s (≥ 0, finite) of the emitters of this name, which may be a pattern as above. Throws InputError if
// there is none of this name (the message lists similar ones), or if the delay is out of range.
void set_delay(Room& room, const std::string& name, double delay_s);

// Sets the power of the emitters of this name or pattern: the one when new, W or lm as Room::quantity (≥ 0, finite);
// the room has it times the maintenance factor. Throws InputError as above.
void set_power(Room& room, const std::string& name, double power);

// Removes the emitters of this name or pattern; their surfaces stay. Returns how many. Throws InputError if there is
// none.
std::size_t remove_emitters(Room& room, const std::string& name);

// Sets the maintenance factor (above 0, up to 1) of all emitters that have none of their own, and multiplies their
// powers accordingly: they become the maintained ones. Throws InputError if it is out of range.
void set_maintenance_factor(Room& room, double factor);

// The maintenance factor of all emitters with a power; none if they have different ones. Where it is F, the irradiances
// with new emitters are those of the room divided by F.
std::optional<double> common_maintenance_factor(const Room& room);

// "Maintained values: maintenance factor 0.8; initial values are 1.25 times as high", or "Maintained values:
// maintenance factors 0.7 to 0.9"; empty if all are 1: then nothing is known of ageing.
std::string maintained_text(const Room& room);

// Adds an emitter whose power is the given quantity. A room without emitters takes this quantity; otherwise both must
// agree. Throws InputError if they do not.
void add_emitter(Room& room, Emitter emitter, Quantity quantity);

}  // namespace lichtmc
