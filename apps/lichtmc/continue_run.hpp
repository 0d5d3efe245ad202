// Common to resume and merge: a state contains the arguments of its run, from which they make another job.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/state.hpp"
#include "run_job.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

// The note of a state, as JSON: the arguments of `lichtmc run` and the folder in which it was started.
std::string note_of(const std::vector<std::string>& arguments);

// Options of resume and merge that replace those of the run.
struct OverrideOptions {
  std::string output;
  std::optional<std::string> room;
  std::optional<std::string> receivers;
  std::optional<int> threads;
  ReportArguments report_arguments;
  std::optional<std::string> progress;
  bool quiet = false;
};
void add_override_options(CLI::App& command, OverrideOptions& options, const std::string& output_help,
                          const std::string& machine_group);

// The options of the run that wrote a state, with the overrides; file names are relative to the folder of that run.
// Throws InputError if another version of the program, or another program, wrote the state, or if the receivers were
// read from stdin and are not given again.
RunOptions options_of(const State& state, const std::filesystem::path& file, const OverrideOptions& overrides);

// A job with these options, without the output folder; reads the room.
RunJob job_of(const State& state, const RunOptions& run, const OverrideOptions& overrides,
              const std::string& command_line);

// The name itself, or the state.h5 in it if it is a folder.
std::filesystem::path state_file(const std::string& name);

}  // namespace lichtmc::app
