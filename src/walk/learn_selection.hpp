// Learns which emitters light which part of a room, for LightSelection.
//
// Every emitter sends the same number of photons, so that weak ones are learned as well as strong ones. The points
// where they arrive divide the surfaces into cells, and are test points of their cell: there the irradiance by the
// emitters whose light reaches the region of the cell is computed, with shadow rays. The probability of an emitter is
// proportional to the root of the mean square: with it a sample of one emitter has the least variance in the cell. An
// emitter reaches a region if one of its photons has arrived there, or if one has arrived nearby and a shadow ray from
// the region arrives. In the table of a region emitters count with the flux that arrives there and nearby.
//
// The effort does not depend on the size of the room, and grows with the number of emitters only beyond some thousands.
//
// The random numbers depend on the room alone, not on the seed of a run: all parts and ranks of a run, and all runs,
// choose by the same tables.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "chance/stream.hpp"
#include "walk/light_selection.hpp"
#include "walk/light_source.hpp"
#include "walk/reference_point.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// The emitters to learn about, numbered 0 … size − 1.
struct LearnedEmitters {
  std::vector<double> fluxes;        // above 0, W or lm
  std::vector<std::size_t> in_room;  // their indices into Room::emitters
  // A sample of the light of emitter k by random words, without shadow; area lights with the weight that it has in a
  // walk.
  std::function<LightSample(std::size_t k, const ReferencePoint&, const Words&)> sample;
};

LightSelection learn_selection(const Scene& scene, const LearnedEmitters& emitters);

}  // namespace lichtmc
