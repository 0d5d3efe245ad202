// What run, resume and merge have in common: a simulation with progress, Ctrl-C and checkpoints, then files and a
// summary.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "lichtmc/output.hpp"
#include "lichtmc/simulate.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

struct RunJob {
  Room room;
  Settings settings;  // for the progress line
  ReportOptions report;
  bool with_report = true;
  double checkpoint_seconds = 60.0;
  std::string note;  // for the state
  std::filesystem::path folder;
  bool quiet = false;
  Communicator* communicator = nullptr;
};

// Calls simulate with a control and writes what it returns: state.h5 first, for the work must not be lost. A signal to
// stop does not keep it from writing. In a team the first member writes and speaks; the others only simulate, and wait
// until it has written. A folder that was made for a run that is refused is removed again.
void carry_out_run(RunJob& job, const std::function<Result(const Control&)>& simulate);

}  // namespace lichtmc::app
