// The three estimators as policies of the one kernel: what an impact scores, and whether the photon survives it.
//
// W. Wasow: On the mean duration of random walks, 1950; G. Forsythe, R. Leibler: Matrix inversion by a Monte Carlo
// method, 1950; H. Schulze, Lichtausbreitung in Räumen, 2021, variants 1 to 3.
//
// All of them walk the same chain from surface to surface; ρ is the reflectance of the surface that was hit, `chance`
// uniform in [0, 1). survive() returns whether the photon survives and adds absorbed power to `ends`, in the units of
// the score. choose() does the same for a whole wave in a scene without reflectance maps, with the same result.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "walk/scene.hpp"
#include "walk/survivors.hpp"
#include "walk/totals.hpp"
#include "walk/weights.hpp"

namespace lichtmc {

// The interpretation of the integers that a policy scores.
struct ScoreLaw {
  Hits hits = Hits::are_the_score;
  double unit = 1.0;                     // photons per unit of the score
  bool at_absorption = false;            // an absorption scores 1/(1 − ρ), an impact nothing
  bool at_most_one_per_history = false;  // the score of a history is 0 or 1: its error follows the binomial law
  bool per_absorption = false;           // a unit represents 1/(1 − ρ) impacts on its surface
};

// Variant 2: the photon survives with probability ρ; every impact scores 1.
struct CollisionPolicy {
  static constexpr bool chooses_in_lanes = true;  // has choose()
  static constexpr ScoreLaw law{.hits = Hits::are_the_score, .unit = 1.0};
  static constexpr bool scores_every_impact = true;
  static constexpr bool carries_weight = false;

  static std::uint64_t units(double /*weight*/) { return 1; }
  static bool survive(double reflectance, double chance, double& /*weight*/, Ends& ends) {
    if (chance < reflectance) return true;
    ends.absorbed += 1;
    return false;
  }
  static void choose(const Scene& scene, Wave& wave, Ends& ends, Survivors& survivors) {
    choose_survivors(wave, scene.survival_of.data(), survivors);
    ends.absorbed += static_cast<int128>(wave.rays.size - survivors.count);
  }
};

// Variant 3: as variant 2, but only the last impact scores. It represents 1/(1 − ρ) impacts. This factor is constant on
// a surface: the tally counts photons, and the factor is applied at the end.
struct AbsorptionPolicy : CollisionPolicy {
  static constexpr ScoreLaw law{.hits = Hits::are_the_score,
                                .unit = 1.0,
                                .at_absorption = true,
                                .at_most_one_per_history = true,
                                .per_absorption = true};
  static constexpr bool scores_every_impact = false;
};

// Variant 3 if ρ varies over a surface: the factor depends on the point, so it is part of the score. The absorbed power
// remains that of a photon.
struct MappedAbsorptionPolicy {
  static constexpr bool chooses_in_lanes = false;
  static constexpr ScoreLaw law{.hits = Hits::apart, .unit = 1.0 / weight_units, .at_absorption = true};
  static constexpr bool scores_every_impact = false;
  static constexpr bool carries_weight = true;

  static std::uint64_t units(double weight) { return static_cast<std::uint64_t>(weight * weight_units + 0.5); }
  static bool survive(double reflectance, double chance, double& weight, Ends& ends) {
    if (chance < reflectance) return true;
    ends.absorbed += static_cast<int128>(units(1.0));
    weight = 1.0 / (1.0 - reflectance);
    return false;
  }
};

// Variant 1: the photon is never absorbed, its weight is multiplied by ρ at every impact. The difference is absorbed.
// The weight is rounded to units, not the difference: so the balance is exact.
struct WeightPolicy {
  static constexpr bool chooses_in_lanes = true;
  static constexpr ScoreLaw law{.hits = Hits::apart, .unit = 1.0 / weight_units};
  static constexpr bool scores_every_impact = true;
  static constexpr bool carries_weight = true;

  static std::uint64_t units(double weight) { return static_cast<std::uint64_t>(weight * weight_units + 0.5); }
  static int128 signed_units(double weight) { return static_cast<int128>(units(weight)); }

  static void absorb(double reflectance, double& weight, Ends& ends) {
    const double reflected = weight * reflectance;
    ends.absorbed += signed_units(weight) - signed_units(reflected);
    weight = reflected;
  }
  // The same for a wave; all photons survive this step.
  static WeightLoss reflect_all(const Scene& scene, Wave& wave, Ends& ends, Survivors& survivors) {
    const WeightLoss loss =
        reflect_weights(wave.rays.size, wave.surface.data(), scene.reflectance_of.data(), wave.weight.data());
    ends.absorbed += loss.absorbed;
    survivors.count = wave.rays.size;
    return loss;
  }
};

// Variant 1 ended by Russian roulette: below 1/8 the photon continues with weight 1/4 or ends, with the same
// expectation. The two numbers are a compromise between the length of the walk and variance: with weights between 1/8
// and 1/4 the roulette adds little variance to a score whose variance is mainly that of hitting the tile or not.
struct RouletteWeightPolicy : WeightPolicy {
  static constexpr double threshold = 0.125;
  static constexpr double restored = 0.25;

  static bool survive(double reflectance, double chance, double& weight, Ends& ends) {
    absorb(reflectance, weight, ends);
    if (weight >= threshold) return true;
    ends.residual += signed_units(weight);
    if (chance * restored >= weight) return false;
    ends.residual -= signed_units(restored);
    weight = restored;
    return true;
  }
  static void choose(const Scene& scene, Wave& wave, Ends& ends, Survivors& survivors) {
    if (reflect_all(scene, wave, ends, survivors).lightest >= threshold) return;
    std::array<std::uint8_t, batch_histories> marks;
    ends.residual +=
        play_roulette(wave.rays.size, wave.chance.data(), threshold, restored, wave.weight.data(), marks.data());
    choose_marked(marks.data(), wave.rays.size, survivors);
  }
};

// Variant 1 for walks that collect light at the surface that they leave: their goal plays the roulette before a flight
// (see goal.hpp). A photon that ends there saves a flight, and the light of every surface that was hit is collected.
struct RouletteBeforeFlightPolicy : WeightPolicy {
  // A photon without weight ends on its surface.
  static bool survive(double reflectance, double /*chance*/, double& weight, Ends& ends) {
    absorb(reflectance, weight, ends);
    return weight > 0.0;
  }
  static void choose(const Scene& scene, Wave& wave, Ends& ends, Survivors& survivors) {
    if (reflect_all(scene, wave, ends, survivors).lightest > 0.0) return;
    std::array<std::uint8_t, batch_histories> marks;
    for (std::size_t i = 0; i < wave.rays.size; ++i) marks[i] = wave.weight[i] > 0.0 ? 1 : 0;
    choose_marked(marks.data(), wave.rays.size, survivors);
  }
};

// Variant 1 cut off after a fixed number of flights by the kernel: the remaining weight is the residual.
struct TruncatedWeightPolicy : WeightPolicy {
  static bool survive(double reflectance, double /*chance*/, double& weight, Ends& ends) {
    absorb(reflectance, weight, ends);
    if (units(weight) > 0) return true;
    return false;
  }
  static void choose(const Scene& scene, Wave& wave, Ends& ends, Survivors& survivors) {
    if (units(reflect_all(scene, wave, ends, survivors).lightest) > 0) return;
    std::array<std::uint8_t, batch_histories> marks;
    for (std::size_t i = 0; i < wave.rays.size; ++i) marks[i] = units(wave.weight[i]) > 0 ? 1 : 0;
    choose_marked(marks.data(), wave.rays.size, survivors);
  }
};

}  // namespace lichtmc
