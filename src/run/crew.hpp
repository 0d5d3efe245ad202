// The threads of a run: they take batches in order until none is left or the run is to end.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "walk/scene.hpp"
#include "walk/tally.hpp"
#include "walk/walk.hpp"

namespace lichtmc {

class Crew {
 public:
  // `threads` ≥ 1. Scene and control must outlive the crew.
  Crew(const Scene& scene, const Settings& settings, const Control& control, unsigned threads);

  // Simulates the histories from where the last call ended up to `end`, or until a stop is asked for or the time is
  // over; a batch begun is finished. The histories done are always the first ones, without a gap. Rethrows what a
  // thread or the callback threw.
  void simulate_up_to(std::uint64_t end);

  // What the threads have counted so far, added up. Exact integers: the same for any number of threads.
  Totals totals() const;

  // Why simulate_up_to() returned before its end; none where it did not.
  std::optional<StopReason> stopped() const { return stopped_; }
  double seconds() const;
  // Shown by the progress callback from now on.
  void set_error(double rms_relative_error) { rms_relative_error_ = rms_relative_error; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Worker {
    Tally tally;
    std::unique_ptr<Walk> walk;
  };

  void work(Worker& worker, std::uint64_t end);
  bool should_stop();
  // Books what a worker has done since it last told, and shows it when it is time.
  void report(const Tally& tally, std::uint64_t& told, std::uint32_t histories);

  const Settings* settings_;
  const Control* control_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::atomic<std::uint64_t> next_{0};  // first history that no thread has taken; beyond the end once all are
  std::uint64_t done_ = 0;              // histories that earlier calls have simulated
  std::atomic<bool> stop_{false};
  std::optional<StopReason> stopped_;
  std::exception_ptr failure_;
  std::mutex mutex_;  // guards stopped_, failure_, the callback and what follows
  std::uint64_t histories_done_ = 0;
  std::uint64_t impacts_done_ = 0;
  double rms_relative_error_;
  Clock::time_point began_;
  Clock::time_point reported_;
};

}  // namespace lichtmc
