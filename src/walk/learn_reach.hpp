// Learns which receivers the light from which part of a room's surfaces reaches, for ReceiverReach.
//
// Photons mark points of the surfaces, which are divided into cells; from points of each cell test rays lead to
// receivers of every cluster. If one gets through, the cell reaches the cluster. The effort is limited, some hundredths
// of a second, whatever the room and the number of receivers: where there are more receivers, clusters are larger and
// cells fewer. The random numbers depend on the room alone, not on the seed of a run: all parts and ranks of a run
// choose by the same table.
#pragma once

#include <optional>
#include <vector>

#include "walk/receiver_reach.hpp"
#include "walk/receiver_walk.hpp"
#include "walk/reference_point.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

struct LearnedReach {
  ReceiverReach reach;
  double served_share = 1.0;  // of the pairs of impact and receiver that face each other, on average
};

// None where it does not pay: with few receivers, where nothing casts a shadow, or where most pairs of cell and
// cluster that face each other see each other. blocks: of the receivers.
std::optional<LearnedReach> learn_reach(const Scene& scene, const std::vector<ReferencePoint>& receivers,
                                        const ReceiverBlocks& blocks);

}  // namespace lichtmc
