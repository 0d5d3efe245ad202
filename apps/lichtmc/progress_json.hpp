// Progress for programs: JSON objects on stderr, one per line.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace lichtmc::app {

// What a line tells; what is empty becomes null.
struct ProgressFacts {
  std::string stage;                   // "preparation", "tiles", …
  std::string step;                    // what is done in it, words; may be empty
  std::optional<double> fraction;      // of the stage, 0 … 1
  std::optional<double> seconds_left;  // of the stage
  std::optional<double> error;         // relative standard error, rms
  std::optional<double> target_error;
  std::optional<std::uint64_t> histories;
};

// Writes a line when the stage or the step changes, and at least every second while it exists: nobody must take a long
// step for the end. Any thread may call.
class ProgressJson {
 public:
  ProgressJson();
  ~ProgressJson();
  ProgressJson(const ProgressJson&) = delete;
  ProgressJson& operator=(const ProgressJson&) = delete;

  void tell(const ProgressFacts& facts);
  // No step is under way: nothing is written until the next.
  void pause();

 private:
  using Clock = std::chrono::steady_clock;
  void beat(const std::stop_token& ended);
  void write(Clock::time_point now);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  ProgressFacts facts_;
  bool under_way_ = false;
  Clock::time_point told_;     // time of the facts
  Clock::time_point written_;  // of the last line
  std::jthread beat_;
};

// The last line of a command that has done its work: stage "done", fraction 1.
void tell_done(const std::optional<double>& error, const std::optional<double>& target_error);

}  // namespace lichtmc::app
