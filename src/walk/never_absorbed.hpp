// A policy for walks that only determine where light can arrive: photons are never absorbed.
#pragma once

#include "walk/scene.hpp"
#include "walk/survivors.hpp"
#include "walk/totals.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

struct NeverAbsorbedPolicy {
  static constexpr bool carries_weight = false;

  static bool survive(double /*reflectance*/, double /*chance*/, double& /*weight*/, Ends& /*ends*/) { return true; }
  static void choose(const Scene& /*scene*/, const Wave& wave, Ends& /*ends*/, Survivors& survivors) {
    survivors.count = wave.rays.size;
  }
};

}  // namespace lichtmc
