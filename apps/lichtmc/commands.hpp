// The commands of the program: one file each, with a function that adds the command and its options to the command
// line. A new command is a function here and an entry in the list.
#pragma once

#include <array>
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
  int* status = nullptr;                 // exit status, for commands with more outcomes than done or failed
};

void add_run_command(CLI::App& program, const Invocation& invocation);
void add_resume_command(CLI::App& program, const Invocation& invocation);
void add_merge_command(CLI::App& program, const Invocation& invocation);
void add_paths_command(CLI::App& program, const Invocation& invocation);
void add_study_command(CLI::App& program, const Invocation& invocation);
void add_cuboid_command(CLI::App& program, const Invocation& invocation);
void add_check_command(CLI::App& program, const Invocation& invocation);
void add_compare_command(CLI::App& program, const Invocation& invocation);
void add_luminaire_command(CLI::App& program, const Invocation& invocation);
void add_scene_command(CLI::App& program, const Invocation& invocation);

// In the order of --help.
inline constexpr std::array all_commands{
    add_run_command,    add_resume_command, add_merge_command,     add_paths_command,   add_study_command,
    add_cuboid_command, add_check_command,  add_luminaire_command, add_compare_command, add_scene_command};

}  // namespace lichtmc::app
