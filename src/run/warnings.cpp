#include "run/warnings.hpp"

#include <algorithm>
#include <numbers>
#include <variant>

#include <glm/common.hpp>

#include "base/message.hpp"
#include "room/bounds.hpp"
#include "room/emitter_place.hpp"
#include "room/emitter_shape.hpp"
#include "room/reflectance.hpp"

namespace lichtmc {

namespace {

std::string percent(double share) {
  return short_number(100.0 * share) + " %";
}

// Whether the emitter also emits in directions opposite to its axis.
bool emits_backwards(const Emitter& emitter) {
  constexpr double hemisphere = 0.5 * std::numbers::pi * (1.0 + 1e-6);  // π/2 as a float may be rounded up
  return std::visit([](const auto& law) { return law.extent().half_angle; }, law_of(emitter)) > hemisphere;
}

}  // namespace

std::vector<OutsideEmitter> emitters_outside(const Room& room) {
  std::vector<OutsideEmitter> outside;
  const Bounds bounds = bounds_of(room);
  // Files contain floats: an emitter at the ceiling may be above it by rounding.
  const glm::dvec3 farthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  const double slack = 4.0 * 0x1p-24 * std::max({farthest.x, farthest.y, farthest.z});
  for (const Emitter& emitter : room.emitters) {
    if (emitting_surface(emitter)) continue;
    const glm::dvec3 p = place_of(room, emitter);
    const std::string which = "Emitter " + in_quotes(emitter.name) + " at (" + short_number(p.x) + ", " +
                              short_number(p.y) + ", " + short_number(p.z) + ") m lies ";
    if (bounds.holds(p, slack)) {
      if (emits_backwards(emitter) && !bounds.holds(p, -slack)) {
        outside.push_back(
            {which + "on the boundary of the room: the light that it emits outwards escapes without an impact.",
             "Move it some centimetres inwards."});
      }
      continue;
    }
    std::string range;
    for (int k = 0; k < 3; ++k)
      range += (k > 0 ? ", " : "") + short_number(bounds.low[k]) + " to " + short_number(bounds.high[k]);
    outside.push_back(
        {which + "outside the room, which extends from x, y, z = " + range + " m.", "Check its position; Y is up."});
  }
  return outside;
}

std::vector<std::string> warnings_of(const Room& room, const Result& result) {
  std::vector<std::string> warnings;
  const Balance& balance = result.balance;
  for (const OutsideEmitter& outside : emitters_outside(room)) warnings.push_back(outside.what + " " + outside.advice);
  if (result.settings.measured != Measured::receivers && result.walk.impacts == 0) {
    warnings.push_back(
        "No photon hit a surface. Check the positions and directions of the emitters; a surface emits light from its "
        "front only.");
  }
  const bool roulette = result.walk.estimator == Estimator::weight && !result.settings.max_bounces;
  constexpr double noticeable = 0.001;
  if (!roulette && balance.residual > noticeable * balance.emitted) {
    warnings.push_back(percent(balance.residual / balance.emitted) +
                       " of the emitted power was cut off as residual: every figure is too low by about as much. "
                       "Allow more bounces or time, or lower "
                       "the highest reflectances (--max-reflectance 0.9).");
  }
  if (result.lost_histories > 0) {
    warnings.push_back(to_text(result.lost_histories, "photon") + " of " + std::to_string(result.walk.histories) +
                       " left a closed room by a numerical error: their power is reported as lost.");
  }
  std::size_t perfect = 0;
  const HighestReflectance highest(room);
  for (const Surface& surface : room.surfaces) perfect += std::size_t{highest.of(surface) == 1.0};
  if (perfect > 0) {
    warnings.push_back("Reflectance 1 on " + to_text(perfect, "surface") + " of " +
                       std::to_string(room.surfaces.size()) +
                       " (on all of it or in parts; the default of glTF is white). Real paint is below "
                       "0.9: set the materials' custom property 'reflectance', or use --max-reflectance 0.9.");
  }
  return warnings;
}

}  // namespace lichtmc
