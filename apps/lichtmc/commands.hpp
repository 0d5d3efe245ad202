// The commands of the program: one file each, which adds the command and its options to the command line. A command
// with more outcomes than done or failed sets the exit status.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "lichtmc/communicator.hpp"

namespace lichtmc::app {

// How the program was started. It outlives the commands.
struct Invocation {
  std::string command_line;              // quoted for a shell
  std::vector<std::string> arguments;    // after the name of the command
  Communicator* communicator = nullptr;  // the processes that share a run with this one
};

void add_run_command(CLI::App& program, const Invocation& invocation);
void add_resume_command(CLI::App& program, const Invocation& invocation);
void add_merge_command(CLI::App& program, const Invocation& invocation);
void add_cuboid_command(CLI::App& program);
void add_paths_command(CLI::App& program);
void add_study_command(CLI::App& program);
void add_check_command(CLI::App& program, int& status);
void add_compare_command(CLI::App& program, int& status);

}  // namespace lichtmc::app
