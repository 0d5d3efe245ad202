// Progress of a command on stderr: a bar on a terminal and a line every few seconds elsewhere; JSON for programs; or
// nothing.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "progress_json.hpp"

namespace lichtmc::app {

enum class ProgressForm { bar, json, none };

// The value of --progress. Without one: none with --quiet, else bar. Throws InputError that names the option.
ProgressForm parse_progress(const std::optional<std::string>& form, bool quiet);

class ProgressLine {
 public:
  ProgressLine(ProgressForm form, const Settings& settings);
  // Leaves the cursor at the start of a line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void update(const Progress& progress);

 private:
  std::string describe(const Progress& progress) const;
  std::string work(const Progress& progress) const;
  double seconds_left(const Progress& progress) const;
  double fraction_done(const Progress& progress) const;
  ProgressFacts facts(const Progress& progress) const;

  ProgressForm form_;
  bool terminal_;
  bool drawn_ = false;
  Settings settings_;
  std::chrono::steady_clock::time_point last_;
  std::optional<ProgressJson> json_;
};

// Names of steps that take some seconds each. On a terminal they overwrite each other; elsewhere each step that takes
// two seconds or more has a line.
class StepLine {
 public:
  explicit StepLine(ProgressForm form);
  ~StepLine();
  StepLine(const StepLine&) = delete;
  StepLine& operator=(const StepLine&) = delete;

  // A step begins, and the one before ends. Any thread may call.
  void update(std::string_view what);
  // The same, of another stage than "preparation" (for programs).
  void set_stage(std::string_view stage) { stage_ = stage; }
  // No step is under way: other lines may be printed.
  void clear();

 private:
  void watch(const std::stop_token& ended);

  ProgressForm form_;
  bool terminal_;
  bool drawn_ = false;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::string stage_ = "preparation";
  std::string step_;  // not told yet
  std::chrono::steady_clock::time_point began_;
  std::jthread watcher_;  // if steps are told by lines
  std::optional<ProgressJson> json_;
};

// "12.3M", "4.56k": a count with three digits.
std::string short_count(double count);
// "4 s", "3 min 20 s", "2 h 5 min".
std::string short_time(double seconds);

}  // namespace lichtmc::app
