// The conditions for an early end of a part of a run, and the threads that check them.
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
  // max_seconds may be 0: the time is over. With a communicator (or null) all ranks stop together, in agree().
  StopWatch(std::optional<double> max_seconds, std::stop_token stop, double before = 0.0,
            Communicator* communicator = nullptr)
      : max_seconds_(max_seconds),
        stop_token_(std::move(stop)),
        before_(before),
        communicator_(communicator),
        began_(Clock::now()) {
    limit_began_ = began_;
  }

  // Whether a stop was requested, the time is over or a thread has failed; with several ranks, only after agree(). Once
  // true it remains true. Any thread may call this.
  bool should_stop();

  // Whether this rank would stop, before all ranks agree(): the current work may be left incomplete if all ranks call
  // agree() after it and discard it when the result is to stop. In a single process the same as should_stop().
  bool would_stop();

  // The reason why should_stop() is true; none if it is false or a thread has failed.
  std::optional<StopReason> reason() const;

  // Collective: all ranks call it at the same point of the run. If one would stop, all stop.
  void agree();

  // Suspends the time limit until it is restarted: for work that an earlier session has already done. Not while threads
  // call should_stop().
  void suspend_limit() { limit_began_.reset(); }
  void restart_limit() { limit_began_ = Clock::now(); }

  double seconds() const { return before_ + elapsed(); }

  // Calls work(0) … work(threads − 1), each on a thread of its own, the first on the calling one. Rethrows the
  // first exception of a thread; should_stop() then returns true for the others.
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
  std::optional<Clock::time_point> limit_began_;  // start of the time limit; none while it is suspended
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;  // guards the members below
  std::optional<StopReason> reason_;
  std::exception_ptr failure_;
};

}  // namespace lichtmc
