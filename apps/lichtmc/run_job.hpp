// What run, resume and merge have in common: a simulation with progress, Ctrl-C and checkpoints, then files and a
// summary.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

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
  Team* team = nullptr;
};

// Calls simulate with a control and writes what it returns: state.h5 first, for the work must not be lost. In a team
// the first member writes and speaks, the others only simulate.
void carry_out(RunJob& job, const std::function<Result(const Control&)>& simulate);

// The words behind `lichtmc run`, and the folder that they were said in: what a state notes down of its run.
std::string note_of(const std::vector<std::string>& arguments);

// The options of the run that a state is of; the files that they name are where they were. Throws InputError where the
// program has not written the state.
RunOptions options_of(const State& state, const std::filesystem::path& file);

// A state file; of a folder, the state.h5 in it.
std::filesystem::path state_file(const std::string& name);

}  // namespace lichtmc::app
