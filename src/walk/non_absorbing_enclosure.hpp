// Light that can go nowhere: emitters shut in by surfaces that absorb nothing.
#pragma once

#include <cstdint>

#include "walk/scene.hpp"

namespace lichtmc {

// Whether some photon of the first thousand meets nothing but reflectance 1 in a million flights: it flies in a closed
// hollow, or in one with an opening of less than some millionths of its walls. Found by trying, so that no gap in a
// mesh and no shell around a lamp is misjudged. Rooms without a reflectance of 1 are not tried. Takes some seconds only
// where the answer is yes.
bool has_non_absorbing_enclosure(const Scene& scene, std::uint64_t seed);

}  // namespace lichtmc
