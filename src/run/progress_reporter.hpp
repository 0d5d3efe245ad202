// Reports the progress of a run to its caller some times a second.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>

#include "lichtmc/simulate.hpp"
#include "run/stop_watch.hpp"

namespace lichtmc {

class ProgressReporter {
 public:
  // target: histories to simulate. Control and watch must outlive the reporter.
  ProgressReporter(const Control& control, const StopWatch& watch, Progress::Stage stage, std::uint64_t target)
      : control_(&control), watch_(&watch), began_(watch.seconds()), last_(Clock::now()) {
    progress_.stage = stage;
    progress_.target = target;
  }

  // Histories that an earlier session has simulated. Before threads add.
  void set_before(std::uint64_t histories) { progress_.histories = before_ = histories; }

  // The stage of all later reports. Not while threads add.
  void set_stage(Progress::Stage stage) { progress_.stage = stage; }

  // Adds the work of a thread since its last report; calls back if a report is due. Any thread may call.
  void add(std::uint64_t histories, std::uint64_t impacts) {
    const std::lock_guard lock(mutex_);
    progress_.histories += histories;
    progress_.impacts += impacts;
    const Clock::time_point now = Clock::now();
    if (!control_->progress || now - last_ < interval) return;
    last_ = now;
    progress_.seconds = watch_->seconds();
    const double rate = static_cast<double>(progress_.histories - before_) / (progress_.seconds - began_);
    const double left = (histories_to_target_ - static_cast<double>(progress_.histories)) / rate;
    progress_.seconds_to_target = std::isnan(left) ? left : std::max(left, 0.0);
    control_->progress(progress_);
  }
  // The error at the last check, and the forecast of the histories that the target error requires; NaN without a
  // target. Not while threads add.
  void set_error(double rms_relative_error, double histories_to_target) {
    progress_.rms_relative_error = rms_relative_error;
    histories_to_target_ = histories_to_target;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds interval{100};

  const Control* control_;
  const StopWatch* watch_;
  std::mutex mutex_;
  Progress progress_;
  double histories_to_target_ = std::numeric_limits<double>::quiet_NaN();
  double began_;              // start of the histories, s
  std::uint64_t before_ = 0;  // histories of earlier sessions
  Clock::time_point last_;
};

}  // namespace lichtmc
