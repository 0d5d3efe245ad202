#include "progress_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>

#include <unistd.h>

#include "console.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc::app {

namespace {

constexpr std::chrono::milliseconds line_interval{5000};
constexpr std::chrono::milliseconds bar_interval{200};
constexpr int bar_width = 24;

}  // namespace

std::string short_count(double count) {
  constexpr const char* suffixes[] = {"", "k", "M", "G", "T", "P"};
  std::size_t k = 0;
  while (count >= 999.5 && k + 1 < std::size(suffixes)) {
    count /= 1000.0;
    ++k;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g%s", count, suffixes[k]);
  return text;
}

std::string short_time(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::min(seconds, 1e15)));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

ProgressForm parse_progress(const std::optional<std::string>& form, bool quiet) {
  if (!form) return quiet ? ProgressForm::none : ProgressForm::bar;
  if (*form == "bar") return ProgressForm::bar;
  if (*form == "json") return ProgressForm::json;
  if (*form == "none") return ProgressForm::none;
  throw InputError("--progress is '" + *form + "' (allowed: bar, json, none). Choose one of them.");
}

ProgressLine::ProgressLine(ProgressForm form, const Settings& settings)
    : form_(form), terminal_(isatty(STDERR_FILENO) != 0), settings_(settings), last_(std::chrono::steady_clock::now()) {
  if (form_ == ProgressForm::json) json_.emplace();
}

ProgressLine::~ProgressLine() {
  if (drawn_ && terminal_) bar_stream() << "\r\x1b[K";  // removes the bar; results follow
}

// Time to the first stop rule, s; infinite while no estimate is known.
double ProgressLine::seconds_left(const Progress& progress) const {
  double left = std::numeric_limits<double>::infinity();
  const auto done = static_cast<double>(progress.histories);
  // Without a number of photons only the other rules end the run.
  if (done > 0.0 && progress.target < no_photon_limit)
    left = progress.seconds * (static_cast<double>(progress.target) - done) / done;
  if (progress.seconds_to_target >= 0.0) left = std::min(left, progress.seconds_to_target);
  if (settings_.max_seconds) left = std::min(left, *settings_.max_seconds - progress.seconds);
  return std::max(left, 0.0);
}

double ProgressLine::fraction_done(const Progress& progress) const {
  const double left = seconds_left(progress);
  return std::isfinite(left) ? progress.seconds / (progress.seconds + left) : 0.0;
}

// Number of histories so far, and impacts or rays per second.
std::string ProgressLine::work(const Progress& progress) const {
  const bool receivers = progress.stage == Progress::Stage::receivers;
  const bool backward = receivers || settings_.tile_walk == WalkDirection::backward;
  const bool limited = progress.target < no_photon_limit;
  return short_count(static_cast<double>(progress.histories)) +
         (limited ? " of " + short_count(static_cast<double>(progress.target)) : "") +
         (receivers  ? " histories for the receivers, "
          : backward ? " backward histories from tiles, "
                     : " photons, ") +
         short_count(static_cast<double>(progress.impacts) / progress.seconds) + (backward ? " rays/s" : " impacts/s");
}

std::string ProgressLine::describe(const Progress& progress) const {
  if (progress.stage == Progress::Stage::preparation) return std::string(progress.step);
  if (progress.stage == Progress::Stage::pilot) return "choosing the estimator";
  const double left = seconds_left(progress);
  const std::string time = std::isfinite(left) ? ", about " + short_time(left) + " left" : "";
  if (progress.stage == Progress::Stage::direct_light) {
    return "direct light of " + short_count(static_cast<double>(progress.histories)) + " of " +
           short_count(static_cast<double>(progress.target)) + time;
  }
  std::string text = work(progress);
  if (progress.rms_relative_error > 0.0) {
    char error[48];
    std::snprintf(error, sizeof error, ", error %.2g %%", 100.0 * progress.rms_relative_error);
    text += error;
  }
  text += time;
  if (progress.seconds_to_target > left) text += ", " + short_time(progress.seconds_to_target) + " to the target error";
  return text;
}

ProgressFacts ProgressLine::facts(const Progress& progress) const {
  constexpr std::array<const char*, 5> stages{"preparation", "direct_light", "pilot", "tiles", "receivers"};
  ProgressFacts facts;
  facts.stage = stages.at(static_cast<std::size_t>(progress.stage));
  facts.step = progress.step;
  facts.target_error = settings_.target_error;
  if (progress.stage == Progress::Stage::preparation || progress.stage == Progress::Stage::pilot) return facts;
  if (const double left = seconds_left(progress); std::isfinite(left)) {
    facts.seconds_left = left;
    facts.fraction = fraction_done(progress);
  }
  if (progress.stage == Progress::Stage::direct_light) return facts;
  facts.error = progress.rms_relative_error;
  facts.histories = progress.histories;
  return facts;
}

void ProgressLine::update(const Progress& progress) {
  if (form_ == ProgressForm::none) return;
  if (json_) {
    json_->tell(facts(progress));
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < (terminal_ ? bar_interval : line_interval)) return;
  last_ = now;
  drawn_ = true;
  if (!terminal_) {
    std::cerr << describe(progress) << std::endl;
    return;
  }
  const int done = static_cast<int>(std::lround(fraction_done(progress) * bar_width));
  bar_stream() << "\r[" + std::string(static_cast<std::size_t>(done), '#') +
                      std::string(static_cast<std::size_t>(bar_width - done), '.') + "] " + describe(progress) +
                      "\x1b[K";
}

StepLine::StepLine(ProgressForm form) : form_(form), terminal_(isatty(STDERR_FILENO) != 0) {
  if (form_ == ProgressForm::json) json_.emplace();
  if (form_ == ProgressForm::bar && !terminal_)
    watcher_ = std::jthread([this](const std::stop_token& ended) { watch(ended); });
}

StepLine::~StepLine() {
  clear();
}

void StepLine::watch(const std::stop_token& ended) {
  constexpr std::chrono::seconds delay{2};
  std::unique_lock lock(mutex_);
  while (!ended.stop_requested()) {
    changed_.wait(lock, ended, [this] { return !step_.empty(); });
    const auto due = began_ + delay;
    if (changed_.wait_until(lock, ended, due, [&] { return began_ + delay != due || step_.empty(); })) continue;
    if (ended.stop_requested()) return;
    std::cerr << step_ << " …" << std::endl;
    step_.clear();
  }
}

void StepLine::update(std::string_view what) {
  if (form_ == ProgressForm::none) return;
  if (json_) {
    ProgressFacts facts;
    facts.stage = stage_;
    facts.step = what;
    json_->tell(facts);
    return;
  }
  const std::lock_guard lock(mutex_);
  if (terminal_) {
    drawn_ = true;
    bar_stream() << "\r" + std::string(what) + " …\x1b[K" << std::flush;
    return;
  }
  step_ = what;
  began_ = std::chrono::steady_clock::now();
  changed_.notify_all();
}

void StepLine::clear() {
  if (json_) json_->pause();
  const std::lock_guard lock(mutex_);
  if (drawn_) bar_stream() << "\r\x1b[K" << std::flush;
  drawn_ = false;
  step_.clear();
  changed_.notify_all();
}

}  // namespace lichtmc::app
