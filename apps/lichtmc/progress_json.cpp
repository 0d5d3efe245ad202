#include "progress_json.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <nlohmann/json.hpp>

namespace lichtmc::app {

namespace {

using ProgressClock = std::chrono::steady_clock;

const ProgressClock::time_point program_start = ProgressClock::now();
constexpr std::chrono::milliseconds least_json_interval{250};
constexpr std::chrono::milliseconds greatest_json_interval{900};  // lines are at most a second apart

double seconds_between(ProgressClock::time_point from, ProgressClock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

// Seconds to the millisecond, shares to six digits: more would be noise.
nlohmann::ordered_json to_digits(const std::optional<double>& value, double per_unit) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return std::round(*value * per_unit) / per_unit;
}

void write_line(const ProgressFacts& facts, double seconds) {
  constexpr double milli = 1e3;
  constexpr double micro = 1e6;
  const nlohmann::ordered_json line{
      {"stage", facts.stage},
      {"step", facts.step.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(facts.step)},
      {"fraction", to_digits(facts.fraction, micro)},
      {"seconds", to_digits(seconds, milli)},
      {"seconds_left", to_digits(facts.seconds_left, milli)},
      {"error", to_digits(facts.error, micro)},
      {"target_error", to_digits(facts.target_error, micro)},
      {"histories", facts.histories ? nlohmann::ordered_json(*facts.histories) : nlohmann::ordered_json(nullptr)}};
  std::cerr << line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n' << std::flush;
}

}  // namespace

ProgressJson::ProgressJson() : beat_([this](const std::stop_token& ended) { beat(ended); }) {}

ProgressJson::~ProgressJson() {
  beat_.request_stop();
  changed_.notify_all();
}

void ProgressJson::write(Clock::time_point now) {
  written_ = now;
  ProgressFacts facts = facts_;
  if (facts.seconds_left) {  // as it was when it was told: time has passed
    const double left = std::max(0.0, *facts.seconds_left - seconds_between(told_, now));
    if (facts.fraction && *facts.seconds_left > 0.0)
      facts.fraction = 1.0 - (1.0 - *facts.fraction) * left / *facts.seconds_left;
    facts.seconds_left = left;
  }
  write_line(facts, seconds_between(program_start, now));
}

void ProgressJson::tell(const ProgressFacts& facts) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  const bool changes = !under_way_ || facts.stage != facts_.stage || facts.step != facts_.step;
  facts_ = facts;
  told_ = now;
  under_way_ = true;
  if (changes || now - written_ >= least_json_interval) write(now);
  changed_.notify_all();
}

void ProgressJson::pause() {
  const std::lock_guard lock(mutex_);
  under_way_ = false;
}

void ProgressJson::beat(const std::stop_token& ended) {
  std::unique_lock lock(mutex_);
  while (!ended.stop_requested()) {
    changed_.wait(lock, ended, [this] { return under_way_; });
    if (ended.stop_requested()) return;
    const Clock::time_point due = written_ + greatest_json_interval;
    changed_.wait_until(lock, ended, due, [&] { return !under_way_ || written_ + greatest_json_interval != due; });
    if (!ended.stop_requested() && under_way_ && Clock::now() >= written_ + greatest_json_interval) write(Clock::now());
  }
}

void tell_done(const std::optional<double>& error, const std::optional<double>& target_error) {
  ProgressFacts facts;
  facts.stage = "done";
  facts.fraction = 1.0;
  facts.seconds_left = 0.0;
  facts.error = error;
  facts.target_error = target_error;
  write_line(facts, seconds_between(program_start, ProgressClock::now()));
}

}  // namespace lichtmc::app
