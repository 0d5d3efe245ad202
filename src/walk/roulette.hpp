// Russian roulette of backward walks with weights: below which weight.
#pragma once

#include "walk/direct_light.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// The weight below which a photon of a backward walk ends before its next flight, or continues with this weight.
//
// The best weight depends on how uneven the direct light is. A walk that collects it at points where its relative
// second moment c² = A ∫ E_d² dA/(∫ E_d dA)² is high has a variance that its first impacts rule: later flights with
// little weight are not worth their time. Where direct light is even, roulette itself would be the largest part of the
// variance. c²/16, between 0.15 and 0.6, is within 15 % of the best product of variance and time in the rooms of
// docs/performance.md. c² is the mean of E_d over the first impacts of 1024 photons, relative to the mean over all
// surfaces, mean_irradiance (W/m² or lx); the photons are the same for each walk through a room.
double roulette_threshold(const Scene& scene, const DirectLight& light, double mean_irradiance);

}  // namespace lichtmc
