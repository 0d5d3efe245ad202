// The threads of a forward walk: they take batches in order until none is left or the run is to end.
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
  // `threads` ≥ 1. All must outlive the crew. Where Control::team is not null, the crews of all its members work
  // together: every call is then one of the whole team.
  WorkerThreads(const Scene& scene, const Settings& settings, const Control& control, StopWatch& watch,
                unsigned threads);

  // Goes on from what an earlier session has counted. Before anything is simulated.
  void restore(std::vector<HistoryRange> ranges, std::shared_ptr<const Totals> totals);

  // Shows the state there when it is time; none until then. It must outlive the crew.
  void begin(RunRecord& record);

  // Simulates the histories from where the last call ended up to the `count`th, or until the watch says stop; a batch
  // begun is finished. The histories done are always the first ones, without a gap. A count that is not one of whole
  // batches ends the work. Rethrows what a thread or the callback threw.
  void simulate_towards(std::uint64_t count);

  // Of what an earlier session has counted, the ends of ranges within a batch, which states do not hold. Ends the work.
  void simulate_ends();

  // What was counted so far. Exact integers: the same for any number of threads, members and sessions.
  const Totals& totals();

  // What of that a later session can go on from: whole batches.
  Counted state();

  // Histories that were simulated so far.
  std::uint64_t histories() const;

  // Shown by the progress callback from now on, see Reporter.
  void set_error(double rms_relative_error, double histories_to_target) {
    reporter_.set_error(rms_relative_error, histories_to_target);
  }
  void set_stage(Progress::Stage stage) { reporter_.set_stage(stage); }
  // New tallies, which the next call makes, are a part of what a checkpoint costs.
  void after_checkpoint() { after_checkpoint_ = true; }

 private:
  struct Worker {
    std::unique_ptr<Walk> walk;
    std::optional<Tally> tally;  // of what was not collected yet; its memory is taken when there is something
    double tally_seconds = 0.0;  // seconds that it took to make the tally
    bool abandoned = false;      // a batch of it, because of a stop: it counts for the result, not for the state
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
  Communicator* communicator_;
  StopWatch* watch_;
  RunRecord* record_ = nullptr;
  ProgressReporter reporter_;
  std::vector<Worker> workers_;
  std::vector<HistoryRange> before_;    // earlier ranges than the one that grows
  HistoryRange range_;                  // that grows, by whole batches
  std::atomic<std::uint64_t> next_{0};  // first history that no thread of this process has taken
  bool after_checkpoint_ = false;
  std::uint64_t round_ = 0;                      // batches in a round of the team
  std::atomic<std::uint64_t> round_impacts_{0};  // of this member
  std::shared_ptr<Totals> whole_;                // whole batches that were collected
  std::uint64_t ends_ = 0;       // histories of batches that are not whole; they are in the first worker's tally
  std::unique_ptr<Totals> sum_;  // of all, once the work has ended with more than whole batches
};

}  // namespace lichtmc
