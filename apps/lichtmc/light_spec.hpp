// Light sources of the command line.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc::app {

// Help for --light: its line in the list of options, and its forms.
extern const char* const light_help;
extern const char* const light_forms;

// Adds an emitter for each description to a room:
//   point:X,Y,Z:POWER                      the same intensity in every direction
//   lambert:X,Y,Z:DX,DY,DZ:M:POWER         generalized Lambert emitter of exponent M about the direction
//   ies:FILE:X,Y,Z…                        luminaire with a photometric file, see luminaire_spec.hpp
// Positions in metres on the room's axes (Y up), POWER as luminous flux ("1000lm") or radiant flux ("1W").
// Throws InputError that names the description and what is wrong in it.
void add_lights(Room& room, const std::vector<std::string>& descriptions);

}  // namespace lichtmc::app
