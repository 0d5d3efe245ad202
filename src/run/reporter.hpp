// Tells a run's caller some times a second how far it has come.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <mutex>

#include "lichtmc/simulate.hpp"
#include "run/stop_watch.hpp"

namespace lichtmc {

class Reporter {
 public:
  // target: histories that there are to do. Control and watch must outlive the reporter.
  Reporter(const Control& control, const StopWatch& watch, Progress::Stage stage, std::uint64_t target)
      : control_(&control), watch_(&watch), last_(Clock::now()) {
    progress_.stage = stage;
    progress_.target = target;
    progress_.rms_relative_error = std::numeric_limits<double>::quiet_NaN();
  }

  // Books what a thread has done since it last told; calls back when it is time. Any thread may call.
  void add(std::uint64_t histories, std::uint64_t impacts) {
    const std::lock_guard lock(mutex_);
    progress_.histories += histories;
    progress_.impacts += impacts;
    const Clock::time_point now = Clock::now();
    if (!control_->progress || now - last_ < interval) return;
    last_ = now;
    progress_.seconds = watch_->seconds();
    control_->progress(progress_);
  }
  void set_error(double rms_relative_error) { progress_.rms_relative_error = rms_relative_error; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds interval{100};

  const Control* control_;
  const StopWatch* watch_;
  std::mutex mutex_;
  Progress progress_;
  Clock::time_point last_;
};

}  // namespace lichtmc
