// A room with some emitters dimmed, from the parts that a run has kept.
#pragma once

#include <vector>

#include "lichtmc/area.hpp"
#include "lichtmc/emitter_parts.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The receivers and areas of a room with some emitters dimmed.
struct DimmedScene {
  std::vector<double> factors;  // of each part
  double power = 0.0;           // W or lm
  std::vector<ReceiverResult> receivers;
  std::vector<AreaResult> areas;
};

// factors: of each part, finite and ≥ 0 (above 1: brighter). Throws InputError if their number or one of them is out of
// range.
DimmedScene dim(const EmitterParts& parts, const std::vector<Receiver>& receivers, const std::vector<Area>& areas,
                const std::vector<double>& factors);

// Covariances of the irradiances by the parts, direct and reflected light together, in (W/m²)² or lx²: receiver, part,
// part, the last one fastest. √(Σ fᵢ fⱼ Cᵢⱼ) is the standard error of a receiver of dim() with the factors f: they
// include the factor by which few rounds make errors uncertain (Student's).
std::vector<double> covariances(const EmitterParts& parts);

}  // namespace lichtmc
