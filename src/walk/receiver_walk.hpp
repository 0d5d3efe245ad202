// The walk for receivers: in each round, photons from the emitters whose impacts contribute to every receiver
// (next_event.hpp), walks from every receiver (backward.hpp), or both, combined by multiple importance sampling.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "walk/backward.hpp"
#include "walk/channel_scores.hpp"
#include "walk/emitter_groups.hpp"
#include "walk/facet_planes.hpp"
#include "walk/next_event.hpp"
#include "walk/part_sums.hpp"
#include "walk/round_plan.hpp"

namespace lichtmc {

// The receivers of a room: in blocks whose scores fit into the caches of a processor, and as origins of walks; the same
// for all threads.
class ReceiverBlocks {
 public:
  static constexpr std::size_t size = 2048;

  // block: receivers of a block, a multiple of most_lanes.
  ReceiverBlocks(const std::vector<ReferencePoint>& receivers, const Tracer& tracer, std::size_t block = size);

  // The block that begins with this receiver.
  const ReceiverLanes& at(std::size_t receiver) const { return lanes_[receiver / block_]; }
  std::size_t block() const { return block_; }
  const ReceiverOrigins& points() const { return points_; }
  // Only if a receiver is a cell: then walks start from these.
  const std::optional<CellOrigins>& cells() const { return cells_; }

 private:
  std::size_t block_;
  std::vector<ReceiverLanes> lanes_;
  ReceiverOrigins points_;
  std::optional<CellOrigins> cells_;
};

// What impulse responses need, the same for all threads.
struct ChannelParts {
  ChannelAxes axes;
  ChannelScale scale;
  FacetPlanes planes;
  const std::vector<ReferencePoint>& receivers;
};

// What the walks of all threads share; all must outlive them.
struct ReceiverWalkParts {
  const Room& room;
  const Scene& scene;
  const DirectLight& light;
  const ReceiverBlocks& blocks;
  const ReceiverReach* reach;              // null: impacts serve all receivers
  const ChannelParts* channels = nullptr;  // null: no impulse responses
  const EmitterGroups* groups = nullptr;   // whose parts are kept; null: no parts. Not both.

  std::uint32_t parts() const { return groups != nullptr ? groups->size() : 1; }
};

// The photons and the walks of rounds, for one thread.
class ReceiverRounds {
 public:
  ReceiverRounds(const ReceiverWalkParts& parts, const BackwardScale& scale, const Settings& settings,
                 const RoundPlan& plan);

  // As BackwardWalk::collect(); the block as for make_receiver_walk(). Photons and walks are counted apart; both counts
  // may be the same. scores: of these rounds, if there are impulse responses; else null.
  void collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& photons, BackwardCount& walks,
               const Abandon& abandon, ChannelScores* scores = nullptr);

  // Rounds that fill a wave; at least 1.
  std::uint64_t in_wave() const { return forward_ ? forward_->rounds_at_a_time() : batch_histories; }

 private:
  const ReceiverBlocks* blocks_;
  RoundPlan plan_;
  std::unique_ptr<NextEvent> forward_;
  std::unique_ptr<BackwardWalk> backward_;
};

// For one thread. In WalkBlock, origins are receivers, whose first is a multiple of ReceiverBlocks::block(), within one
// block; samples are rounds. The score of a round is its mean irradiance, in units of `scale`, or the sum of the scores
// of its parts.
std::unique_ptr<BackwardWalk> make_receiver_walk(const ReceiverWalkParts& parts, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan);

}  // namespace lichtmc
