// The threads of a forward walk: they take batches in order until none is left or the run is to end.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "run/reporter.hpp"
#include "run/stop_watch.hpp"
#include "walk/scene.hpp"
#include "walk/tally.hpp"
#include "walk/walk.hpp"

namespace lichtmc {

class Crew {
 public:
  // `threads` ≥ 1. All must outlive the crew.
  Crew(const Scene& scene, const Settings& settings, const Control& control, StopWatch& watch, unsigned threads);

  // Simulates the histories from where the last call ended up to `end`, or until the watch says stop; a batch begun is
  // finished. The histories done are always the first ones, without a gap. Rethrows what a thread or the callback
  // threw.
  void simulate_up_to(std::uint64_t end);

  // What the threads have counted so far, added up. Exact integers: the same for any number of threads.
  Totals totals() const;

  // Shown by the progress callback from now on, see Reporter.
  void set_error(double rms_relative_error, double histories_to_target) {
    reporter_.set_error(rms_relative_error, histories_to_target);
  }
  void set_stage(Progress::Stage stage) { reporter_.set_stage(stage); }

 private:
  struct Worker {
    Tally tally;
    std::unique_ptr<Walk> walk;
  };

  void work(Worker& worker, std::uint64_t end);

  const Scene* scene_;
  Hits hits_;
  StopWatch* watch_;
  Reporter reporter_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::atomic<std::uint64_t> next_{0};  // first history that no thread has taken; beyond the end once all are
  std::uint64_t done_ = 0;              // histories that earlier calls have simulated
};

}  // namespace lichtmc
