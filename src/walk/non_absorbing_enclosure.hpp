// Enclosures without absorption: emitters enclosed by surfaces that absorb nothing, so that their light never ends.
#pragma once

#include <cstdint>

#include "walk/scene.hpp"

namespace lichtmc {

// Whether some photon of the first thousand meets nothing but reflectance 1 in a million flights: it flies in a closed
// enclosure, or in one whose openings are less than some millionths of its walls. Determined by simulation, so that
// gaps in a mesh and shells around a light source are judged by their effect. Rooms without a reflectance of 1 are not
// simulated. Takes some seconds only where the answer is yes.
bool has_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed);

}  // namespace lichtmc
