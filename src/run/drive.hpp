// The run driver: choice of the estimator, simulation between error checks, checkpoints, stop rules. It is the same for
// all walks; Measurement and Work (work.hpp) implement the differences.
#pragma once

#include <memory>

#include "lichtmc/error.hpp"
#include "lichtmc/result.hpp"
#include "run/context.hpp"
#include "run/error_measure.hpp"
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

// Sets the relative standard errors at the end, the figure of merit, and the last point of the convergence.
void finish_report(WalkReport& report, const RunError& error);

// Rays and time of the direct light that is computed before a walk.
struct DirectCost {
  TraceCount traced;
  double seconds = 0.0;

  void add_to(WalkReport& report) const {
    report.rays += traced.rays;
    report.shadow_rays += traced.shadow_rays;
    report.undecided += traced.undecided;
    report.direct_seconds = seconds;
  }
};

// Runs compute(rays), which computes the direct light; a resumed session repeats it. The time limit does not include
// the repetition: without direct light the walks of the state would be lost.
template <class Compute>
DirectCost compute_direct(const RunContext& context, bool resumed, const Compute& compute) {
  DirectCost cost;
  if (resumed) context.watch.suspend_limit();
  const double began = context.watch.seconds();
  compute(cost.traced);
  cost.seconds = context.watch.seconds() - began;
  if (resumed) context.watch.restart_limit();
  return cost;
}

}  // namespace lichtmc
