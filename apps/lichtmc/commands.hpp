// The commands of the program: one file each, which adds the command and its options to the command line. A command
// whose outcome is more than done or failed sets the exit status.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace lichtmc::app {

void add_run_command(CLI::App& program, const std::string& command_line);
void add_cuboid_command(CLI::App& program);
void add_paths_command(CLI::App& program);
void add_study_command(CLI::App& program);
void add_check_command(CLI::App& program, int& status);
void add_compare_command(CLI::App& program, int& status);

}  // namespace lichtmc::app
