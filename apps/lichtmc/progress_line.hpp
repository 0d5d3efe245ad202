// Progress of a run on stderr: a bar on a terminal, a line every few seconds elsewhere, or nothing.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"

namespace lichtmc::app {

class ProgressLine {
 public:
  enum class Show { yes, no };

  ProgressLine(Show show, const Settings& settings);
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

  Show show_;
  bool terminal_;
  bool drawn_ = false;
  Settings settings_;
  std::chrono::steady_clock::time_point last_;
};

// Names of steps that take some seconds each. On a terminal they overwrite each other; elsewhere each step that begins
// two seconds or more after the first has a line.
class StepLine {
 public:
  explicit StepLine(ProgressLine::Show show);
  ~StepLine();
  StepLine(const StepLine&) = delete;
  StepLine& operator=(const StepLine&) = delete;

  void update(std::string_view what);

 private:
  ProgressLine::Show show_;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point began_;
};

// "12.3M", "4.56k": a count with three digits.
std::string short_count(double count);
// "4 s", "3 min 20 s", "2 h 5 min".
std::string short_time(double seconds);

}  // namespace lichtmc::app
