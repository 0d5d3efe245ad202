// The walk for receivers: in each round, photons from the emitters whose impacts contribute to every receiver
// (next_event.hpp), walks from every receiver (backward.hpp), or both, combined by multiple importance sampling.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "walk/backward.hpp"
#include "walk/next_event.hpp"
#include "walk/round_plan.hpp"

namespace lichtmc {

// The receivers of a room, in blocks whose scores fit into the caches of a processor; the same for all threads.
class ReceiverBlocks {
 public:
  static constexpr std::size_t size = 2048;

  ReceiverBlocks(const std::vector<ReferencePoint>& receivers, const Tracer& tracer);

  std::size_t count() const { return lanes_.size(); }
  const ReceiverLanes& operator[](std::size_t block) const { return lanes_[block]; }

 private:
  std::vector<ReceiverLanes> lanes_;
};

// What the walks of all threads share; all must outlive them.
struct ReceiverWalkParts {
  const Room& room;
  const Scene& scene;
  const DirectLight& light;
  const std::vector<ReferencePoint>& receivers;
  const ReceiverBlocks& blocks;
  const ReceiverReach* reach;  // null: impacts serve all receivers
};

// For one thread. In WalkBlock, origins are receivers, whose first is a multiple of ReceiverBlocks::size, within one
// block; samples are rounds. The score of a round is its mean irradiance, in units of `scale`.
std::unique_ptr<BackwardWalk> make_receiver_walk(const ReceiverWalkParts& parts, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan);

}  // namespace lichtmc
