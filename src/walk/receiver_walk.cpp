#include "walk/receiver_walk.hpp"

#include <algorithm>
#include <cassert>

namespace lichtmc {

namespace {

class RoundWalk final : public BackwardWalk {
 public:
  RoundWalk(const ReceiverWalkParts& parts, const BackwardScale& scale, const Settings& settings, const RoundPlan& plan)
      : scale_(scale), rounds_(parts, scale, settings, plan) {}

  void simulate(const WalkBlock& work, std::vector<BackwardSums>& sums, BackwardCount& count,
                const Abandon& abandon) override {
    const std::uint64_t together = rounds_together(work.last - work.first);
    for (std::uint64_t first = work.first_sample; first < work.last_sample; first += together) {
      const WalkBlock rounds{work.first, work.last, first, std::min(first + together, work.last_sample)};
      irradiance_.assign((rounds.last_sample - rounds.first_sample) * (work.last - work.first), 0.0);
      collect(rounds, irradiance_, count, abandon);
      add_scores(sums, count);
    }
  }

  void collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& count,
               const Abandon& abandon) override {
    rounds_.collect(work, irradiance, count, count, abandon);
  }

 private:
  // As many as fill a wave, but no more than keep the scores in a processor's cache.
  std::uint64_t rounds_together(std::uint64_t receivers) const {
    constexpr std::uint64_t most_scores = 32 * 1024;
    return std::clamp<std::uint64_t>(most_scores / receivers, 1, rounds_.in_wave());
  }

  void add_scores(std::vector<BackwardSums>& sums, BackwardCount& count) const {
    for (std::size_t k = 0; k < irradiance_.size(); ++k) {
      const std::uint64_t score = scale_.score(irradiance_[k]);
      if (score == BackwardScale::largest_score) ++count.capped;
      sums[k % sums.size()].add(score);
    }
  }

  BackwardScale scale_;
  ReceiverRounds rounds_;
  std::vector<double> irradiance_;  // by round and receiver
};

}  // namespace

ReceiverRounds::ReceiverRounds(const ReceiverWalkParts& parts, const BackwardScale& scale, const Settings& settings,
                               const RoundPlan& plan)
    : blocks_(&parts.blocks), plan_(plan) {
  if (plan.forward > 0) forward_ = make_next_event(parts.room, parts.scene, parts.light, settings, plan, parts.reach);
  if (plan.backward == 0) return;
  backward_ = blocks_->cells()
                  ? make_backward_walk(parts.scene, parts.light, *blocks_->cells(), scale, settings, plan)
                  : make_backward_walk(parts.scene, parts.light, blocks_->points(), scale, settings, plan);
}

void ReceiverRounds::collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& photons,
                             BackwardCount& walks, const Abandon& abandon) {
  if (forward_) {
    assert(work.first % ReceiverBlocks::size == 0);
    const ReceiverLanes& receivers = (*blocks_)[work.first / ReceiverBlocks::size];
    assert(receivers.size() == work.last - work.first);
    forward_->simulate(receivers, work.first_sample, work.last_sample - work.first_sample, irradiance, photons, abandon);
  }
  if (!backward_) return;
  const WalkBlock own{work.first, work.last, work.first_sample * plan_.backward, work.last_sample * plan_.backward};
  backward_->collect(own, irradiance, walks, abandon);
}

ReceiverBlocks::ReceiverBlocks(const std::vector<ReferencePoint>& receivers, const Tracer& tracer)
    : points_(receivers, tracer) {
  const auto is_cell = [](const ReferencePoint& one) { return one.is_cell(); };
  if (std::any_of(receivers.begin(), receivers.end(), is_cell)) cells_.emplace(receivers, tracer);
  for (std::size_t first = 0; first < receivers.size(); first += size)
    lanes_.emplace_back(receivers, tracer, first, std::min(first + size, receivers.size()));
}

std::unique_ptr<BackwardWalk> make_receiver_walk(const ReceiverWalkParts& parts, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan) {
  return std::make_unique<RoundWalk>(parts, scale, settings, plan);
}

}  // namespace lichtmc
