// Enclosures without absorption: emitters enclosed by surfaces that absorb nothing, so that their histories never end.
#pragma once

#include <cstdint>

#include "walk/scene.hpp"

namespace lichtmc {

// Whether some of the first 1024 photons that remain in the room make 2²⁰ flights, together, without an end: they are
// in a closed enclosure of reflectance 1, or in one that absorbs and lets out less than some hundred-thousandths of the
// light at a flight. This is determined by simulation, which includes the effect of gaps in a mesh and of shells around
// a light source. Rooms without a reflectance of 1 are not simulated.
bool has_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed);

}  // namespace lichtmc
