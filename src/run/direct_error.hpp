// How accurately direct light is integrated: so that it adds little to the error of the walks, and takes little time.
#pragma once

#include <algorithm>

#include "lichtmc/settings.hpp"

namespace lichtmc {

// The relative error of the direct light of a tile: 3·10⁻³, or half of the target error. Most tiles surpass it by far:
// the rms over all tiles, which is what the target error limits, is about a third of the target or less, and its square
// adds a ninth to that of the walks. At least 10⁻⁴, because a higher accuracy costs too many rays.
inline double direct_error_of_tiles(const Settings& settings) {
  constexpr double without_target = 3e-3;
  constexpr double of_target = 0.5;
  constexpr double finest = 1e-4;
  if (settings.direct_error) return *settings.direct_error;
  return settings.target_error ? std::max(of_target * *settings.target_error, finest) : without_target;
}

// That of receivers: 10⁻³, or a tenth of the target error, whose square adds a hundredth to the variance; from 10⁻³ to
// 10⁻².
inline double direct_error_of_receivers(const Settings& settings) {
  constexpr double finest = 1e-3;
  constexpr double coarsest = 1e-2;
  if (settings.direct_error) return *settings.direct_error;
  return settings.target_error ? std::clamp(0.1 * *settings.target_error, finest, coarsest) : finest;
}

}  // namespace lichtmc
