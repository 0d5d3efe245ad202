// A walk as the run driver sees it (drive.hpp): something that simulates up to a count and knows its error.
//
// Counts are histories for photons from the emitters, rounds for backward walks (one or some walks from every origin).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lichtmc/progress.hpp"
#include "lichtmc/settings.hpp"
#include "run/check_schedule.hpp"
#include "run/pilot.hpp"
#include "run/state_data.hpp"

namespace lichtmc {

struct WorkCounts {
  std::uint64_t histories = 0;
  std::uint64_t impacts = 0;
  TraceCount traced;
};

// One walk with one estimator.
class Work {
 public:
  virtual ~Work() = default;

  virtual std::uint64_t done() const = 0;
  virtual std::uint64_t histories_of(std::uint64_t count) const = 0;
  virtual CheckSchedule schedule() const = 0;

  // Continues from what a state holds. Throws InputError where that is not of this room.
  virtual void restore(StateData& data) = 0;
  // Before the first call of simulate_towards() that counts, that is, after pilots.
  virtual void begin() = 0;
  // Simulates until `count` is done, the watch says stop, or there is an occasion for a checkpoint.
  virtual void simulate_towards(std::uint64_t count) = 0;
  // Simulates what a state does not hold of the histories that it names: the end of a batch.
  virtual void complete() = 0;

  // Relative standard error of what was asked for: rms over tiles, by area, or over receivers.
  virtual double error() = 0;
  virtual Pilot pilot() = 0;
  virtual WorkCounts counts() = 0;

  // Brings the state up to date with what was counted.
  virtual Walked& write_to(StateData& data) = 0;
  // The state was written: what it shares with this walk is to be released, or it would be copied.
  virtual void release(StateData& data) = 0;

  // Shown by the progress callback from now on.
  virtual void show(double rms_relative_error, double histories_to_target) = 0;

 protected:
  Work() = default;
  Work(const Work&) = default;
  Work& operator=(const Work&) = default;
};

// What is measured by walks: tiles by photons, tiles by backward walks, receivers.
class Measurement {
 public:
  virtual ~Measurement() = default;

  virtual std::string name() const = 0;  // "the tiles"
  // What the state holds of it, or null.
  virtual Walked* stored(StateData& data) const = 0;
  // A walk with one estimator, for one session.
  virtual std::unique_ptr<Work> make_work(Estimator estimator, Progress::Stage stage) = 0;

  // For Estimator::automatic. The count that a pilot simulates:
  virtual std::uint64_t pilot_count(Estimator estimator) const = 0;
  // Whether the histories of the chosen pilot are the first of the run; else they are discarded.
  virtual bool keeps_pilot() const = 0;
  virtual Choice judge(std::vector<Pilot>& pilots) = 0;

 protected:
  Measurement() = default;
  Measurement(const Measurement&) = default;
  Measurement& operator=(const Measurement&) = default;
};

}  // namespace lichtmc
