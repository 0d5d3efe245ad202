#include "run/stop_watch.hpp"

#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "lichtmc/error.hpp"
#include "run/team_work.hpp"

namespace lichtmc {

std::optional<StopReason> StopWatch::asked() const {
  if (max_seconds_ && elapsed() >= *max_seconds_) return StopReason::max_time;
  if (stop_token_.stop_requested()) return StopReason::interrupt;
  return std::nullopt;
}

void StopWatch::stop_for(StopReason reason) {
  const std::lock_guard lock(mutex_);
  if (!reason_) reason_ = reason;
  stop_ = true;
}

bool StopWatch::should_stop() {
  if (stop_) return true;
  if (team_ != nullptr) return false;
  const std::optional<StopReason> reason = asked();
  if (reason) stop_for(*reason);
  return reason.has_value();
}

void StopWatch::agree() {
  if (team_ == nullptr || stop_) return;
  std::optional<StopReason> reason = asked();
  share(team_, reason);
  if (reason) stop_for(*reason);
}

std::optional<StopReason> StopWatch::reason() const {
  const std::lock_guard lock(mutex_);
  return reason_;
}

void StopWatch::run_on_threads(unsigned threads, const std::function<void(unsigned)>& work) {
  const auto guarded = [&](unsigned k) {
    try {
      work(k);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
  };
  {
    std::vector<std::jthread> helpers;
    try {
      for (unsigned k = 1; k < threads; ++k) helpers.emplace_back(guarded, k);
    } catch (const std::system_error& error) {
      stop_ = true;  // those that have started end soon
      throw RuntimeError("Cannot start " + std::to_string(threads) + " threads (" + error.what() +
                         "). Give --threads a smaller number.");
    }
    guarded(0);
  }
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace lichtmc
