// Where the figures come from, as sections of the page: each a piece of HTML, empty where there is nothing to say.
#pragma once

#include <string>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Tables of the settings and the emitters; what was chosen for the user, and changed in the room.
std::string settings_section(const Room& room, const Result& result);

// What the room's file holds and the simulation has not.
std::string left_out_section(const Result& result);

// How to get the same digits again. `command`: that made them, may be empty.
std::string reproduction_section(const Result& result, const std::string& command);

}  // namespace lichtmc
