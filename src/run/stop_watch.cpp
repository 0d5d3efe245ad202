#include "run/stop_watch.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "lichtmc/error.hpp"

namespace lichtmc {

std::optional<StopReason> StopWatch::own_reason() const {
  if (max_seconds_ && limit_began_ && since(*limit_began_) >= *max_seconds_) return StopReason::max_time;
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
  if (communicator_ != nullptr) return false;
  const std::optional<StopReason> reason = own_reason();
  if (reason) stop_for(*reason);
  return reason.has_value();
}

bool StopWatch::would_stop() {
  return should_stop() || (communicator_ != nullptr && own_reason().has_value());
}

// Votes are summed: all ranks get the same result, whichever of them received the signal or whose clock is ahead.
void StopWatch::agree() {
  if (communicator_ == nullptr || stop_) return;
  const std::optional<StopReason> mine = own_reason();
  std::array<std::uint64_t, 2> votes{mine == StopReason::interrupt, mine == StopReason::max_time};
  communicator_->sum(votes);
  if (votes[0] > 0) {
    stop_for(StopReason::interrupt);
  } else if (votes[1] > 0) {
    stop_for(StopReason::max_time);
  }
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
      stop_ = true;  // the threads that have started end soon
      throw RuntimeError("Cannot start " + std::to_string(threads) + " threads (" + error.what() +
                         "). Give --threads a smaller number.");
    }
    guarded(0);
  }
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace lichtmc
