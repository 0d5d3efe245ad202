// When a part of a run is to end early, and the threads that ask.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>

#include "lichtmc/communicator.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

class StopWatch {
 public:
  // Time runs from now. before: seconds that earlier sessions of the run took; they count in seconds() only.
  // max_seconds may be 0: the time is over. In a team (or null) all members stop together, where they agree().
  StopWatch(std::optional<double> max_seconds, std::stop_token stop, double before = 0.0,
            Communicator* communicator = nullptr)
      : max_seconds_(max_seconds),
        stop_token_(std::move(stop)),
        before_(before),
        communicator_(communicator),
        began_(Clock::now()) {
    limit_began_ = began_;
  }

  // Whether a stop was asked for, the time is over or a thread has failed; in a team, only what was agreed. Once true
  // it stays so. Any thread may ask.
  bool should_stop();

  // Whether this member would stop, though the team has not agreed yet: what it is at need not be completed, if all
  // agree() behind it and throw it away where the answer is to stop. Alone the same as should_stop().
  bool would_stop();

  // Why should_stop() has said true; none where it has not, or where a thread failed.
  std::optional<StopReason> reason() const;

  // Of a team's members all call it, at the same place of the run: where one would stop, all do.
  void agree();

  // The time limit does not count until it is restarted: for work that an earlier session has done as well. Not while
  // threads ask.
  void suspend_limit() { limit_began_.reset(); }
  void restart_limit() { limit_began_ = Clock::now(); }

  double seconds() const { return before_ + elapsed(); }

  // Calls work(0) … work(threads − 1), each on a thread of its own, the first on the calling one. Rethrows what the
  // first of them to fail threw; the others are told to stop.
  void run_on_threads(unsigned threads, const std::function<void(unsigned)>& work);

 private:
  using Clock = std::chrono::steady_clock;

  static double since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }
  double elapsed() const { return since(began_); }
  std::optional<StopReason> own_reason() const;
  void stop_for(StopReason reason);

  std::optional<double> max_seconds_;
  std::stop_token stop_token_;
  double before_;  // s
  Communicator* communicator_;
  Clock::time_point began_;
  std::optional<Clock::time_point> limit_began_;  // when the time limit began to count; none while it does not
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;  // guards what follows
  std::optional<StopReason> reason_;
  std::exception_ptr failure_;
};

}  // namespace lichtmc
