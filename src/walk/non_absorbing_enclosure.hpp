// Enclosures without absorption: emitters enclosed by surfaces that absorb nothing, so that their histories never end.
#pragma once

#include <cstdint>

#include "walk/scene.hpp"

namespace lichtmc {

// Whether one of the first 1000 photons hits only surfaces of reflectance 1 in 10⁶ flights: it is in a closed
// enclosure, or in one whose openings are less than some millionths of its walls. This is determined by simulation,
// which includes the effect of gaps in a mesh and of shells around a light source. Rooms without a reflectance of 1 are
// not simulated. Takes some seconds only if the result is true.
bool has_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed);

}  // namespace lichtmc
