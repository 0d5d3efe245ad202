// What resume and merge have in common: a state notes down how its run was called, and from that they make another job.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/state.hpp"
#include "run_job.hpp"
#include "run_options.hpp"

namespace lichtmc::app {

// The words behind `lichtmc run`, and the folder that they were said in: what a state notes down of its run.
std::string note_of(const std::vector<std::string>& arguments);

// What resume and merge may say otherwise than the run did.
struct OverrideOptions {
  std::string output;
  std::optional<std::string> room;
  std::optional<std::string> receivers;
  std::optional<int> threads;
  ReportArguments report_arguments;
  bool quiet = false;
};
void add_override_options(CLI::App& command, OverrideOptions& options, const std::string& output_help,
                          const std::string& machine_group);

// The options of the run that a state is of, with what is said otherwise; the files that they name are where they were.
// Throws InputError where another version of the program, or another program, has written the state, or where receivers
// came from stdin and are not given again.
RunOptions options_of(const State& state, const std::filesystem::path& file, const OverrideOptions& overrides);

// A job for it, without the folder; the room is read.
RunJob job_of(const State& state, const RunOptions& run, const OverrideOptions& overrides,
              const std::string& command_line);

// A state file; of a folder, the state.h5 in it.
std::filesystem::path state_file(const std::string& name);

}  // namespace lichtmc::app
