#include "walk/receiver_walk.hpp"

#include <algorithm>
#include <cassert>
#include <optional>

namespace lichtmc {

namespace {

class RoundWalk final : public BackwardWalk {
 public:
  RoundWalk(const ReceiverWalkParts& parts, const BackwardScale& scale, const Settings& settings, const RoundPlan& plan)
      : blocks_(&parts.blocks), scale_(scale), plan_(plan), points_(parts.receivers, *parts.scene.tracer) {
    if (plan.forward > 0) forward_ = make_next_event(parts.room, parts.scene, parts.light, settings, plan, parts.reach);
    if (plan.backward == 0) return;
    if (std::any_of(parts.receivers.begin(), parts.receivers.end(), [](const auto& one) { return one.is_cell(); })) {
      cells_.emplace(parts.receivers, *parts.scene.tracer);
      backward_ = make_backward_walk(parts.scene, parts.light, *cells_, scale, settings, plan);
    } else {
      backward_ = make_backward_walk(parts.scene, parts.light, points_, scale, settings, plan);
    }
  }

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
    if (forward_) {
      assert(work.first % ReceiverBlocks::size == 0);
      const ReceiverLanes& receivers = (*blocks_)[work.first / ReceiverBlocks::size];
      assert(receivers.size() == work.last - work.first);
      forward_->simulate(receivers, work.first_sample, work.last_sample - work.first_sample, irradiance, count,
                         abandon);
    }
    if (backward_) {
      const WalkBlock walks{work.first, work.last, work.first_sample * plan_.backward,
                            work.last_sample * plan_.backward};
      backward_->collect(walks, irradiance, count, abandon);
    }
  }

 private:
  // As many as fill a wave of photons from the emitters, but no more than keep the scores in a processor's cache.
  std::uint64_t rounds_together(std::uint64_t receivers) const {
    constexpr std::uint64_t most_scores = 32 * 1024;
    const std::uint64_t in_wave = forward_ ? forward_->rounds_at_a_time() : batch_histories;
    return std::clamp<std::uint64_t>(most_scores / receivers, 1, in_wave);
  }

  void add_scores(std::vector<BackwardSums>& sums, BackwardCount& count) const {
    for (std::size_t k = 0; k < irradiance_.size(); ++k) {
      const std::uint64_t score = scale_.score(irradiance_[k]);
      if (score == BackwardScale::largest_score) ++count.capped;
      sums[k % sums.size()].add(score);
    }
  }

  const ReceiverBlocks* blocks_;
  BackwardScale scale_;
  RoundPlan plan_;
  ReceiverOrigins points_;
  std::optional<CellOrigins> cells_;  // only if a receiver is a cell
  std::unique_ptr<NextEvent> forward_;
  std::unique_ptr<BackwardWalk> backward_;
  std::vector<double> irradiance_;  // by round and receiver
};

}  // namespace

ReceiverBlocks::ReceiverBlocks(const std::vector<ReferencePoint>& receivers, const Tracer& tracer) {
  for (std::size_t first = 0; first < receivers.size(); first += size)
    lanes_.emplace_back(receivers, tracer, first, std::min(first + size, receivers.size()));
}

std::unique_ptr<BackwardWalk> make_receiver_walk(const ReceiverWalkParts& parts, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan) {
  return std::make_unique<RoundWalk>(parts, scale, settings, plan);
}

}  // namespace lichtmc
