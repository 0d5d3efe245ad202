// Warnings about a result.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Emitters or receivers in a wrong place: a sentence, and what to do.
struct Misplaced {
  std::string what;
  std::string advice;
};
// Point emitters outside the room's bounds, and emitters outside the walls of a closed room. Up to three are named one
// by one, more together.
std::vector<Misplaced> emitters_outside(const Room& room);
// Receivers outside the walls of a closed room, together; empty if there are none.
std::vector<Misplaced> receivers_outside(const Room& room);

// Emitters outside the room; receivers outside, if they are measured; no impacts at all; residual power of truncated
// walks; lost photons; surfaces of reflectance 1. One or two sentences each, with what to do.
std::vector<std::string> warnings_of(const Room& room, const Result& result);

}  // namespace lichtmc
