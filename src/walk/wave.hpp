// A wave: the photons of one batch, in flight together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/lanes.hpp"
#include "chance/moments.hpp"
#include "tracer/rays.hpp"

namespace lichtmc {

// The photons of a batch start together and fly in step: the number of the flight is the same for all. Those that end
// leave the wave, the others close ranks, so that every loop runs over photons that fly.
struct Wave {
  Wave()
      : rays(batch_histories),
        photon(batch_histories),
        weight(batch_histories),
        history(batch_histories),
        polar_azimuth(batch_histories),
        chance(batch_histories) {}

  Rays rays;
  std::vector<std::uint32_t> photon;         // number of the history within the batch
  std::vector<double> weight;                // for estimators that carry one
  std::vector<std::uint64_t> history;        // number that selects the random words
  std::vector<std::uint64_t> polar_azimuth;  // random words 0 and 1 of the flight, see draw_many()
  std::vector<std::uint64_t> chance;         // words 2 and 3

  // Moves photon `from` to place `to` ≤ from; what the next flight needs of it.
  void move(std::size_t from, std::size_t to) {
    photon[to] = photon[from];
    polar_azimuth[to] = polar_azimuth[from];
    rays.facet[to] = rays.facet[from];
    rays.s[to] = rays.s[from];
    rays.t[to] = rays.t[from];
    rays.behind[to] = rays.behind[from];
  }
};

// Of the photons in flight those survive whose chance (see draw_many()), counted in 2⁻⁵³, is below the survival of the
// facet that they are on. They close ranks, in their order, with what the next flight needs of them; returns how many.
// Without a branch: every photon moves to the next place, which the one after it takes if it was absorbed.
inline std::size_t close_ranks(Wave& wave, const std::uint64_t* LICHTMC_APART survival_of_facet) {
  const std::uint64_t* LICHTMC_APART chance = wave.chance.data();
  std::uint32_t* LICHTMC_APART photon = wave.photon.data();
  std::uint64_t* LICHTMC_APART words = wave.polar_azimuth.data();
  std::uint32_t* LICHTMC_APART facet = wave.rays.facet.data();
  float* LICHTMC_APART s = wave.rays.s.data();
  float* LICHTMC_APART t = wave.rays.t.data();
  std::uint32_t* LICHTMC_APART behind = wave.rays.behind.data();
  const std::size_t n = wave.rays.size;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t on = facet[i];
    photon[kept] = photon[i];
    words[kept] = words[i];
    facet[kept] = on;
    s[kept] = s[i];
    t[kept] = t[i];
    behind[kept] = behind[i];
    kept += (chance[i] >> 11) < survival_of_facet[on] ? std::size_t{1} : std::size_t{0};
  }
  return kept;
}

}  // namespace lichtmc
