// The run driver: choice of the estimator, simulation between error checks, checkpoints, stop rules. It is the same for
// all walks; what differs is behind Measurement and Work (work.hpp).
#pragma once

#include <memory>

#include "lichtmc/error.hpp"
#include "lichtmc/result.hpp"
#include "run/context.hpp"
#include "run/work.hpp"

namespace lichtmc {

// Thrown where a stop comes before there is any result.
class StoppedTooSoon : public RuntimeError {
 public:
  using RuntimeError::RuntimeError;
};

// A walk that has ended, and its report, in which errors are still missing: see finish_report().
struct Driven {
  std::unique_ptr<Work> work;
  WalkReport report;
};

// Simulates until the first stop rule of the settings is met. Continues from what the record holds of the measurement,
// and leaves there what was counted. A record that is only read is not continued: the work then holds what it tells.
Driven drive(const RunContext& context, Measurement& measurement);

// Fills in what follows from the relative standard error at the end: it, the figure of merit, the last point of the
// convergence.
void finish_report(WalkReport& report, double rms_relative_error);

// Runs compute(), which a later session does again. Where a state is continued its time does not count for the limit:
// without it the walks of the state would be lost. Returns the seconds that it took.
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
