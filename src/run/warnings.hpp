// Warnings about a result.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "room/enclosure.hpp"

namespace lichtmc {

// Something wrong, and what to do: a sentence or two each.
struct Advised {
  std::string what;
  std::string advice;
};
// Point emitters outside the room's bounds, and emitters outside the walls of a closed room. Up to three are named one
// by one, more together. enclosure, here and below: of the room, if it is known.
std::vector<Advised> emitters_outside(const Room& room, const Enclosure* enclosure = nullptr);
// Receivers that closed walls separate from all emitters: those outside together, those inside walls or bodies
// together; and of the others those outside the room's bounds. results: of the receivers, if they are known; then only
// those count as outside the bounds that get no light, because beside a single wall a receiver has its place.
std::vector<Advised> receivers_outside(const Room& room, const Enclosure* enclosure = nullptr,
                                       const std::vector<ReceiverResult>* results = nullptr);

// Materials that reflect more than 95 %, if there are any.
std::optional<Advised> high_reflectances(const Room& room);

// Emitters outside the room; receivers outside, if they are measured; areas that are not measured; no impacts at all;
// residual power of truncated walks; lost photons; covered area lights; surfaces between which no rule decides;
// materials of reflectance 1. One or two sentences each, with what to do.
std::vector<std::string> warnings_of(const Room& room, const Result& result, const Enclosure* enclosure = nullptr);

}  // namespace lichtmc
