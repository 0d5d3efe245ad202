// Backward walks from many origins (receivers, or faces of tiles) with one estimator, as work for the run driver.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "run/context.hpp"
#include "run/error_measure.hpp"
#include "run/progress_reporter.hpp"
#include "run/work.hpp"
#include "walk/backward.hpp"
#include "walk/channel_sums.hpp"
#include "walk/direct_light.hpp"
#include "walk/part_sums.hpp"

namespace lichtmc {

// Direct light and reflected light of every origin.
struct OriginEstimates {
  std::shared_ptr<const std::vector<DirectIrradiance>> direct;  // per origin
  std::shared_ptr<std::vector<BackwardSums>> sums;              // per origin, of all rounds
  std::uint64_t rounds = 0;                                     // per origin
  std::shared_ptr<ChannelSums> channels;                        // of all rounds; null: no impulse responses
  std::shared_ptr<PartSums> parts;                              // of all rounds; null: no parts are kept
  std::vector<HistoryRange> ranges;                             // of all rounds
  RoundPlan plan;                                               // histories of a round
  std::uint32_t group = 1;                                      // scores of a round that are added up in a sum
  double unit = 1.0;                                            // of the sums, W/m² or lx

  std::uint64_t histories() const { return rounds * plan.histories(sums->size()); }
  // Irradiance at origin k by reflected light, and its standard error: NaN if fewer than two rounds were simulated.
  double indirect(std::size_t k) const;
  double indirect_error(std::size_t k) const;
};

// The origins that backward walks start from.
struct BackwardTask {
  Progress::Stage stage = Progress::Stage::receivers;
  std::size_t origins = 0;
  RoundPlan plan;           // histories of a round
  std::uint32_t group = 1;  // as OriginEstimates::group
  // Origins of a WalkBlock at most; then a block's first origin is a multiple of it. 0: any number.
  std::size_t block = 0;
  double unit = 1.0;                                                 // of the scale of make_walk, W/m² or lx
  std::function<DirectIrradiance(std::size_t, TraceCount&)> direct;  // direct irradiance at origin k; counts rays
  // One for each thread.
  std::function<std::unique_ptr<BackwardWalk>(const Settings&, const RoundPlan&)> make_walk;
  std::function<RunError(const OriginEstimates&)> error;  // its relative error is compared with Settings::target_error
  // Only for a choice among several candidates: the error floor by the irradiances at the origins, and the weights of
  // these in the mean of squares whose root is `error`.
  std::function<double(const std::vector<double>&)> floor;
  std::vector<double> weights;
  const ChannelAxes* channels = nullptr;  // of impulse responses, if they are measured; else null
  std::uint32_t parts = 0;                // groups of emitters whose parts are kept; 0: no sums of parts
  std::string name;                       // of the origins
  std::vector<Estimator> candidates;      // for an estimator
  std::string reason;                     // for the plan and the estimator, if they were chosen
  // Chooses plan, candidates and reason when direct light is known; not called for walks that continue. Null: they are
  // given.
  std::function<void(BackwardTask&, const std::vector<DirectIrradiance>&)> choose;
  std::optional<BackwardState> StateData::*slot = nullptr;  // these walks in a state
};

class BackwardWork final : public Work {
 public:
  // direct: of every origin. Context, task and direct must outlive the work.
  BackwardWork(const RunContext& context, const BackwardTask& task, Estimator estimator, Progress::Stage stage,
               std::shared_ptr<const std::vector<DirectIrradiance>> direct);

  std::uint64_t done() const override { return found_.rounds; }
  std::uint64_t histories_of(std::uint64_t rounds) const override;
  CheckSchedule schedule() const override;
  void restore(StateData& data) override;
  void begin() override {}
  void simulate_towards(std::uint64_t rounds) override;
  void complete() override {}
  double error() override { return task_.error(found_).relative; }
  Pilot pilot() override;
  WorkCounts counts() override { return {found_.histories(), count_.impacts, count_.connections, count_.traced}; }
  Walked& write_to(StateData& data) override;
  void release(StateData& data) override {
    (data.*task_.slot)->sums.reset();
    if (found_.channels) data.channels.reset();
    if (found_.parts) data.parts.reset();
  }
  void show(double rms_relative_error, double histories_to_target) override {
    reporter_.set_error(rms_relative_error, histories_to_target);
  }

  const OriginEstimates& estimates() const { return found_; }
  // The rounds that the estimates contain.
  std::vector<HistoryRange> ranges() const {
    std::vector<HistoryRange> all = before_;
    all.push_back({range_.first, range_.first + found_.rounds - rounds_before_});
    return all;
  }

  // Rounds of a pilot of this many histories.
  static std::uint64_t pilot_rounds(const RunContext& context, const BackwardTask& task, Estimator estimator);

 private:
  // A division of rounds × origins into pieces of work.
  struct Pieces {
    std::uint64_t origins = 1;  // of a piece
    std::uint64_t parts = 1;    // of the rounds
    std::uint64_t count = 1;
  };
  Pieces pieces_of(std::uint64_t rounds) const;
  bool simulate_step(std::uint64_t rounds);
  // The sums of a step, of all threads.
  struct Step {
    std::vector<BackwardSums>& sums;
    ChannelSums& channels;
    PartSums& parts;
    BackwardCount& count;
  };
  void take_rounds(std::uint64_t first, std::uint64_t last, const Step& step);

  const RunContext& context_;
  const BackwardTask& task_;
  Settings settings_;                 // with the estimator of this work
  std::uint64_t together_;            // histories in a round of all origins
  ChannelSums step_channels_;         // of the step that is simulated; else 0
  PartSums step_parts_;               // likewise
  HistoryRange range_;                // of rounds, to simulate
  std::vector<HistoryRange> before_;  // ranges before the one that grows
  std::uint64_t rounds_before_ = 0;   // number of rounds in them
  ProgressReporter reporter_;
  OriginEstimates found_;
  BackwardCount count_;
  std::uint64_t step_ = 2;  // rounds of the next step
  std::atomic<std::uint64_t> next_{0};
  std::mutex mutex_;  // guards the sums and counts of a step
};

// The direct light of every origin, computed by all threads of all ranks; rays are added to `traced`. Throws
// StoppedTooSoon if the watch requests a stop before all are computed.
std::vector<DirectIrradiance> direct_light_of(std::size_t origins,
                                              const std::function<DirectIrradiance(std::size_t, TraceCount&)>& direct,
                                              const Control& control, unsigned threads, StopWatch& watch,
                                              TraceCount& traced);

// Runs backward walks by the driver; returns estimates and report. Throws StoppedTooSoon if the run is stopped before
// the first round is complete.
struct BackwardOutcome {
  OriginEstimates estimates;
  std::vector<HistoryRange> ranges;  // of rounds
  WalkReport report;                 // finished
};
BackwardOutcome walk_backward(const RunContext& context, BackwardTask task);

}  // namespace lichtmc
