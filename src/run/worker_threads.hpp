// The threads of a forward walk: they simulate batches in order until none is left or the run ends.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "run/progress_reporter.hpp"
#include "run/run_record.hpp"
#include "run/state_data.hpp"
#include "run/stop_watch.hpp"
#include "walk/scene.hpp"
#include "walk/tally.hpp"
#include "walk/walk.hpp"

namespace lichtmc {

class WorkerThreads {
 public:
  // `threads` ≥ 1. All references must outlive this. If Control::communicator is not null, the worker threads of all
  // ranks work together: every call is then collective.
  WorkerThreads(const Scene& scene, const Settings& settings, const Control& control, StopWatch& watch,
                unsigned threads);

  // Continues from an earlier session. Call it before histories are simulated.
  void restore(std::vector<HistoryRange> ranges, std::shared_ptr<const Totals> totals);

  // Sets the record for checkpoints; without it there are none. It must outlive this.
  void begin(RunRecord& record);

  // Simulates the histories from where the last call ended up to the `count`th, or until the watch requests a stop;
  // batches that have begun are completed. The simulated histories are always the first ones, without gaps. A count
  // that is not a multiple of a batch ends the work. Rethrows exceptions of threads and of the callback.
  void simulate_towards(std::uint64_t count);

  // Simulates the incomplete last batch of an earlier session, which states do not contain. Ends the work.
  void simulate_ends();

  // The sums so far. Exact integers: the same for any number of threads, ranks and sessions.
  const Totals& totals();

  // The part from which a later session can continue: whole batches.
  Counted state();

  // Histories that were simulated so far.
  std::uint64_t histories() const;

  // Values for the progress callback, see ProgressReporter.
  void set_error(double rms_relative_error, double histories_to_target) {
    reporter_.set_error(rms_relative_error, histories_to_target);
  }
  void set_stage(Progress::Stage stage) { reporter_.set_stage(stage); }
  // The next call makes new tallies: their time is added to the cost of the checkpoint.
  void after_checkpoint() { after_checkpoint_ = true; }

 private:
  struct Worker {
    std::unique_ptr<Walk> walk;
    std::optional<Tally> tally;  // scores not yet collected; allocated on demand
    double tally_seconds = 0.0;  // s, time to make the tally
    bool abandoned = false;  // a stop abandoned one of its batches, which is part of the result but not of the state
  };

  void simulate_alone(std::uint64_t end);
  void simulate_in_ranks(std::uint64_t end);
  void work(Worker& worker, std::uint64_t end, bool may_pause);
  void make_tally(Worker& worker) const;
  void count_tally_time();
  void simulate_part(HistoryRange range);
  bool abandoned() const;
  void collect();

  const Scene* scene_;
  Hits hits_;
  Absorption absorption_;
  Communicator* communicator_;
  StopWatch* watch_;
  RunRecord* record_ = nullptr;
  ProgressReporter reporter_;
  std::vector<Worker> workers_;
  std::vector<HistoryRange> before_;    // ranges before the one that grows
  HistoryRange range_;                  // the one that grows, by whole batches
  std::atomic<std::uint64_t> next_{0};  // first history that no thread of this process has taken
  bool after_checkpoint_ = false;
  std::uint64_t round_ = 0;                      // batches in a round of all ranks
  std::atomic<std::uint64_t> round_impacts_{0};  // of this rank
  std::shared_ptr<Totals> whole_;                // collected sums of whole batches
  std::uint64_t ends_ = 0;                       // histories of an incomplete batch; in the tally of the first worker
  std::unique_ptr<Totals> sum_;                  // of all histories, if the work has ended within a batch
};

}  // namespace lichtmc
