// Common to run, resume and merge: a simulation with progress, Ctrl-C and checkpoints, then files and a summary.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/output.hpp"
#include "lichtmc/simulate.hpp"
#include "progress_line.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

struct RunJob {
  Room room;
  Settings settings;  // for the progress line
  ReportOptions report;
  bool with_report = true;
  ResultFiles files;
  double checkpoint_seconds = 60.0;
  std::string note;  // for the state
  std::filesystem::path folder;
  std::optional<FolderLock> lock;  // of the folder, if it is held already
  std::vector<std::string> notes;  // printed before the simulation
  bool quiet = false;
  ProgressForm progress = ProgressForm::bar;
  Communicator* communicator = nullptr;
};

// Whether this process writes files and messages.
bool is_rank_0(const Communicator* communicator);

// Calls simulate with a control and writes the result, state.h5 first so that the simulated histories are safe. A
// signal to stop does not interrupt the writing. With several ranks, rank 0 writes files and messages; the others only
// simulate and wait until it has written. Rank 0 holds the lock of the folder from before the simulation until all is
// written; a folder that another run holds is refused. If the run is refused, a folder created for it is removed.
void carry_out_run(RunJob& job, const std::function<Result(const Control&)>& simulate);

}  // namespace lichtmc::app
