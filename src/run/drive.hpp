// The run driver: choice of the estimator, simulation between error checks, checkpoints, stop rules. It is the same for
// all walks; Measurement and Work (work.hpp) implement the differences.
#pragma once

#include <memory>

#include "lichtmc/error.hpp"
#include "lichtmc/result.hpp"
#include "run/context.hpp"
#include "run/work.hpp"

namespace lichtmc {

// Thrown if a run is stopped before there is any result.
class StoppedTooSoon : public RuntimeError {
 public:
  using RuntimeError::RuntimeError;
};

// A walk that has ended, and its report without errors: see finish_report().
struct Driven {
  std::unique_ptr<Work> work;
  WalkReport report;
};

// Simulates until the first stop rule of the settings is met. Continues from the record's data of the measurement and
// updates them. A record that is only read is not continued: the work then contains its data.
Driven drive(const RunContext& context, Measurement& measurement);

// Sets the relative standard error at the end, the figure of merit, and the last point of the convergence.
void finish_report(WalkReport& report, double rms_relative_error);

// Runs compute(), which every session repeats. If a state is continued, its time does not count for the time limit:
// without its results the walks of the state could not be used. Returns its wall-clock time in s.
template <class Compute>
double outside_time_limit(const RunContext& context, bool continues, const Compute& compute) {
  if (continues) context.watch.suspend_limit();
  const double began = context.watch.seconds();
  compute();
  const double seconds = context.watch.seconds() - began;
  if (continues) context.watch.restart_limit();
  return seconds;
}

}  // namespace lichtmc
