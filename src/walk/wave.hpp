// A wave: the photons of one batch, in flight together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "chance/moments.hpp"
#include "tracer/rays.hpp"

namespace lichtmc {

// The photons of a batch start together and are traced in parallel: the number of the flight is the same for all.
// Photons that end are removed and the wave is compacted, so that every loop runs over active photons only.
struct Wave {
  Wave()
      : rays(batch_histories),
        photon(batch_histories),
        weight(batch_histories),
        history(batch_histories),
        polar(batch_histories),
        azimuth(batch_histories),
        chance(batch_histories),
        surface(batch_histories) {}

  Rays rays;
  std::vector<std::uint32_t> photon;   // number of the history within the batch
  std::vector<double> weight;          // for estimators that carry one
  std::vector<std::uint64_t> history;  // number that selects the random words
  std::vector<std::uint32_t> polar;    // random word 0 of the flight, see draw_many()
  std::vector<std::uint32_t> azimuth;  // word 1
  std::vector<std::uint64_t> chance;   // words 2 and 3
  std::vector<std::uint32_t> surface;  // where the flight ended, if the goal has set it

  // Moves the data of photon `from` for the next flight to position `to` ≤ from.
  void move(std::size_t from, std::size_t to) {
    photon[to] = photon[from];
    polar[to] = polar[from];
    azimuth[to] = azimuth[from];
    rays.move_landing(from, to);
  }
};

}  // namespace lichtmc
