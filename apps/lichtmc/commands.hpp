// The commands of the program: one file each, which adds the command and its options to the command line.
#pragma once

#include <CLI/CLI.hpp>

namespace lichtmc::app {

void add_run_command(CLI::App& program);
void add_cuboid_command(CLI::App& program);

}  // namespace lichtmc::app
