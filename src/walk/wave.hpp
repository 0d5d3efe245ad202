// A wave: the photons of one batch, in flight together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "chance/moments.hpp"
#include "chance/philox.hpp"
#include "tracer/rays.hpp"

namespace lichtmc {

// The photons of a batch start together and fly in step: the number of the flight is the same for all. Those that end
// leave the wave, the others close ranks, so that every loop runs over photons that fly.
struct Wave {
  Wave() : rays(batch_histories), photon(batch_histories), weight(batch_histories), words(batch_histories) {}

  Rays rays;
  std::vector<std::uint32_t> photon;  // number of the history within the batch
  std::vector<double> weight;         // for estimators that carry one
  std::vector<Words> words;           // random words of the flight

  // Moves photon `from` to place `to` ≤ from; what the next flight needs of it.
  void move(std::size_t from, std::size_t to) {
    photon[to] = photon[from];
    weight[to] = weight[from];
    words[to] = words[from];
    rays.facet[to] = rays.facet[from];
    rays.s[to] = rays.s[from];
    rays.t[to] = rays.t[from];
    rays.behind[to] = rays.behind[from];
  }
};

}  // namespace lichtmc
