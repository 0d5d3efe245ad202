// What a user should know before trusting a result.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Point emitters outside the room's bounds: a sentence each.
struct OutsideEmitter {
  std::string what;
  std::string advice;
};
std::vector<OutsideEmitter> emitters_outside(const Room& room);

// Emitters outside the room's bounds; light that met no surface at all; light left over by a cut; photons lost;
// surfaces that reflect everything. A sentence or two each, with what to do.
std::vector<std::string> warnings_of(const Room& room, const Result& result);

}  // namespace lichtmc
