// Enclosures without absorption: emitters enclosed by surfaces that absorb nothing, so that their histories never end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "walk/scene.hpp"

namespace lichtmc {

// An emitter whose light nothing absorbs, and one of the surfaces about it, by their numbers in the room.
struct NonAbsorbingEnclosure {
  std::size_t emitter = 0;
  std::size_t surface = 0;
};

// Whether some of the first 1024 photons that remain in the room make 2²⁰ flights, together, without an end: they are
// in a closed enclosure of reflectance 1, or in one that absorbs and lets out less than some hundred-thousandths of the
// light at a flight. This is determined by simulation, which includes the effect of gaps in a mesh and of shells around
// a light source. Rooms without a reflectance of 1 are not simulated.
std::optional<NonAbsorbingEnclosure> find_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed);
inline bool has_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed) {
  return find_non_absorbing_enclosure(scene, seed).has_value();
}

}  // namespace lichtmc
