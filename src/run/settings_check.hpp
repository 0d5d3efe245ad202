// Whether settings are sound, and sound for a room.
#pragma once

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/tiles.hpp"

namespace lichtmc {

// Throws InputError naming the setting, its value, the legal range and what to do.
void check_settings(const Settings& settings);

// Throws InputError where the estimator cannot see the room: absorption with a surface of ρ = 1. The room must have
// passed check_room().
void check_settings_for(const Room& room, const Settings& settings);

// The first surface that has ρ = 1 and an area, or null.
const Surface* surface_that_absorbs_nothing(const Room& room);

// Throws InputError where the tallies of so many threads of one of so many processes, and what a run keeps beside them,
// need more memory than there is.
void check_memory(const Room& room, const Tiling& tiling, const Settings& settings, unsigned threads,
                  unsigned processes, bool has_reflectance_maps);

}  // namespace lichtmc
