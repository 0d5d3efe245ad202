// The interface between the run driver (drive.hpp) and a walk: it simulates up to a count and computes its error.
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
  std::uint64_t connections = 0;
  TraceCount traced;
};

// One walk with one estimator.
class Work {
 public:
  virtual ~Work() = default;

  virtual std::uint64_t done() const = 0;
  virtual std::uint64_t histories_of(std::uint64_t count) const = 0;
  virtual CheckSchedule schedule() const = 0;

  // Continues from a state. Throws InputError if it does not belong to this room.
  virtual void restore(StateData& data) = 0;
  // Called after pilots, before the first simulate_towards() of the run itself.
  virtual void begin() = 0;
  // Simulates until `count` is reached, the watch requests a stop, or a checkpoint is possible.
  virtual void simulate_towards(std::uint64_t count) = 0;
  // Simulates histories in the ranges of a state that its sums do not contain: the end of a batch.
  virtual void complete() = 0;

  // Relative standard error: rms over the tiles, weighted by area, or over the receivers.
  virtual double error() = 0;
  virtual Pilot pilot() = 0;
  virtual WorkCounts counts() = 0;

  // Updates the state.
  virtual Walked& write_to(StateData& data) = 0;
  // Called when the state was written: releases the data that it shares with this walk, which would otherwise be
  // copied.
  virtual void release(StateData& data) = 0;

  // Values for the progress callback.
  virtual void show(double rms_relative_error, double histories_to_target) = 0;

 protected:
  Work() = default;
  Work(const Work&) = default;
  Work& operator=(const Work&) = default;
};

// A measurement by walks: tiles by photons, tiles by backward walks, or receivers.
class Measurement {
 public:
  virtual ~Measurement() = default;

  virtual std::string name() const = 0;  // "the tiles"
  // The estimators to choose from; if there is one, the reason for it, or nothing to say.
  virtual std::vector<Estimator> candidates() const = 0;
  virtual std::string reason() const { return {}; }
  // Its data in the state, or null.
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
