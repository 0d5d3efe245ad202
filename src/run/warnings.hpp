// Warnings about a result.
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

// Emitters outside the room's bounds; no impacts at all; residual power of truncated walks; lost photons; surfaces of
// reflectance 1. One or two sentences each, with what to do.
std::vector<std::string> warnings_of(const Room& room, const Result& result);

}  // namespace lichtmc
