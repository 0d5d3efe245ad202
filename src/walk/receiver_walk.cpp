#include "walk/receiver_walk.hpp"

#include <algorithm>
#include <cassert>

namespace lichtmc {

namespace {

class RoundWalk final : public BackwardWalk {
 public:
  RoundWalk(const ReceiverWalkParts& parts, const BackwardScale& scale, const Settings& settings, const RoundPlan& plan)
      : parts_(parts), plan_(plan), scale_(scale), rounds_(parts, scale, settings, plan) {}

  void simulate(const WalkBlock& work, std::vector<BackwardSums>& sums, BackwardCount& count,
                const Abandon& abandon) override {
    if (parts_.channels != nullptr) use_scores_of(work);
    if (parts_.groups != nullptr) use_sums_of(work);
    const std::uint64_t together = rounds_together(work.last - work.first);
    for (std::uint64_t first = work.first_sample; first < work.last_sample; first += together) {
      const WalkBlock rounds{work.first, work.last, first, std::min(first + together, work.last_sample)};
      irradiance_.assign((rounds.last_sample - rounds.first_sample) * parts_.parts() * (work.last - work.first), 0.0);
      if (scores_) scores_->begin(first, rounds.last_sample - first);
      collect(rounds, irradiance_, count, abandon, scores_ ? &*scores_ : nullptr);
      if (parts_.groups != nullptr) {
        add_scores_of_parts(first, sums, count);
      } else {
        add_scores(sums, count);
      }
    }
  }

  void collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& count, const Abandon& abandon,
               ChannelScores* scores) override {
    rounds_.collect(work, irradiance, count, count, abandon, scores);
  }

  void hand_over(ChannelSums& sums, BackwardCount& count) override {
    if (scores_) scores_->hand_over(first_of_scores_, sums, count.capped);
  }

  void hand_over(PartSums& sums) override {
    if (parts_.groups != nullptr) part_sums_.move_to(sums, first_of_sums_, parts_.parts());
  }

 private:
  void use_scores_of(const WalkBlock& work) {
    if (scores_ && first_of_scores_ == work.first) return;
    first_of_scores_ = work.first;
    const ChannelParts& channels = *parts_.channels;
    scores_.emplace(channels.axes, channels.scale, channels.receivers.data() + work.first,
                    parts_.blocks.at(work.first).numbers());
  }

  void use_sums_of(const WalkBlock& work) {
    const std::size_t receivers = work.last - work.first;
    if (receivers != receivers_of_sums_) part_sums_ = PartSums(receivers, parts_.parts());
    receivers_of_sums_ = receivers;
    first_of_sums_ = work.first;
  }

  // As many as fill a wave, but no more than keep the scores in a processor's cache. The light of walks from receivers
  // is kept with its paths until photons have flown.
  std::uint64_t rounds_together(std::uint64_t receivers) const {
    constexpr std::uint64_t most_scores = 32 * 1024;
    constexpr std::uint64_t most_walks_with_paths = 16 * 1024;
    std::uint64_t most = most_scores / (receivers * parts_.parts());
    if (parts_.channels != nullptr && plan_.backward > 0)
      most = std::min(most, most_walks_with_paths / (receivers * plan_.backward));
    return std::clamp<std::uint64_t>(most, 1, rounds_.in_wave());
  }

  void add_scores(std::vector<BackwardSums>& sums, BackwardCount& count) const {
    for (std::size_t k = 0; k < irradiance_.size(); ++k) {
      const std::uint64_t score = scale_.score(irradiance_[k]);
      if (score == BackwardScale::largest_score) ++count.capped;
      sums[k % sums.size()].add(score);
    }
  }

  // The score of a round is the sum of those of its parts: so they add up to the last unit.
  void add_scores_of_parts(std::uint64_t first_round, std::vector<BackwardSums>& sums, BackwardCount& count) {
    const std::uint32_t parts = parts_.parts();
    const std::size_t n = sums.size();
    std::vector<std::uint64_t> scores(parts);
    for (std::size_t round = 0; round * parts * n < irradiance_.size(); ++round) {
      for (std::size_t k = 0; k < n; ++k) {
        std::uint64_t all = 0;
        for (std::uint32_t part = 0; part < parts; ++part) {
          scores[part] =
              std::min(scale_.score(irradiance_[(round * parts + part) * n + k]), BackwardScale::largest_score - all);
          all += scores[part];
        }
        if (all == BackwardScale::largest_score) ++count.capped;
        sums[k].add(all);
        part_sums_.add(k, first_round + round, scores.data(), parts);
      }
    }
  }

  ReceiverWalkParts parts_;
  RoundPlan plan_;
  BackwardScale scale_;
  ReceiverRounds rounds_;
  std::vector<double> irradiance_;  // by round and receiver
  std::optional<ChannelScores> scores_;
  std::size_t first_of_scores_ = 0;
  PartSums part_sums_;  // of the block of receivers that begins with first_of_sums_
  std::size_t first_of_sums_ = 0;
  std::size_t receivers_of_sums_ = 0;
};

}  // namespace

ReceiverRounds::ReceiverRounds(const ReceiverWalkParts& parts, const BackwardScale& scale, const Settings& settings,
                               const RoundPlan& plan)
    : blocks_(&parts.blocks), plan_(plan) {
  const ChannelParts* channels = parts.channels;
  // A single part is all the light: nothing is kept apart in the walks.
  const EmitterGroups* apart = parts.parts() > 1 ? parts.groups : nullptr;
  if (plan.forward > 0) {
    forward_ = channels != nullptr
                   ? make_next_event(parts.room, parts.scene, parts.light, settings, plan, parts.reach,
                                     {channels->planes, channels->axes.delay_m})
                   : make_next_event(parts.room, parts.scene, parts.light, settings, plan, parts.reach, apart);
  }
  if (plan.backward == 0) return;
  if (channels != nullptr) {
    backward_ =
        make_backward_walk(parts.scene, parts.light, blocks_->points(), scale, settings, plan, channels->planes);
    return;
  }
  backward_ = blocks_->cells()
                  ? make_backward_walk(parts.scene, parts.light, *blocks_->cells(), scale, settings, plan, apart)
                  : make_backward_walk(parts.scene, parts.light, blocks_->points(), scale, settings, plan, apart);
}

void ReceiverRounds::collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& photons,
                             BackwardCount& walks, const Abandon& abandon, ChannelScores* scores) {
  const std::uint64_t rounds = work.last_sample - work.first_sample;
  const auto fly_forward = [&] {
    const ReceiverLanes& receivers = blocks_->at(work.first);
    assert(work.first % blocks_->block() == 0 && receivers.size() == work.last - work.first);
    forward_->simulate(receivers, work.first_sample, rounds, irradiance, photons, abandon, scores);
  };
  const auto fly_backward = [&] {
    const WalkBlock own{work.first, work.last, work.first_sample * plan_.backward, work.last_sample * plan_.backward};
    backward_->collect(own, irradiance, walks, abandon, scores);
  };
  // Scores are opened with the light of walks from receivers, then photons add theirs.
  if (scores != nullptr && backward_) fly_backward();
  if (forward_) fly_forward();
  if (scores == nullptr && backward_) fly_backward();
  for (std::uint64_t r = 0; scores != nullptr && !forward_ && r < rounds; ++r) {
    scores->open(r);
    scores->close();
  }
}

ReceiverBlocks::ReceiverBlocks(const std::vector<ReferencePoint>& receivers, const Tracer& tracer, std::size_t block)
    : block_(block), points_(receivers, tracer) {
  const auto is_cell = [](const ReferencePoint& one) { return one.is_cell(); };
  if (std::any_of(receivers.begin(), receivers.end(), is_cell)) cells_.emplace(receivers, tracer);
  for (std::size_t first = 0; first < receivers.size(); first += block)
    lanes_.emplace_back(receivers, tracer, first, std::min(first + block, receivers.size()));
}

std::unique_ptr<BackwardWalk> make_receiver_walk(const ReceiverWalkParts& parts, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan) {
  return std::make_unique<RoundWalk>(parts, scale, settings, plan);
}

}  // namespace lichtmc
