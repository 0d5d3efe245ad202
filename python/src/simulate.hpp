// Runs for Python code: simulate(), resume() and their like, aside from the calling thread (worker.hpp).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "lichtmc/control.hpp"
#include "lichtmc/progress.hpp"
#include "run_result.hpp"
#include "worker.hpp"

namespace lichtmc::python {

// Progress that outlives the callback of the library.
struct ProgressReport {
  Progress progress;
  std::string step;
};

// The result of run(control) for a room, with the room's preparation kept for the next run. on_progress: called with
// a ProgressReport, or None. threads: as Settings::threads. interrupted: what Ctrl-C does.
RunResultPtr run_aside(const std::shared_ptr<const KeptRoom>& room, unsigned threads, nb::object on_progress,
                       const std::function<Result(const Control&)>& run,
                       Interrupted interrupted = Interrupted::returns);

}  // namespace lichtmc::python
