// Calculation areas of the command line: --plane, --area, --area-on.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc::app {

struct AreaOptions {
  std::vector<std::string> planes, areas, surfaces;
};

// The properties that may follow an area of the command line, for the help of commands.
extern const char* const area_forms;

void add_area_options(CLI::App& command, AreaOptions& options);

// Gives the areas of the room's file and those of the options their points; a sentence about each goes to `notes`.
// Throws InputError naming the option or the area.
void lay_all_areas(const AreaOptions& options, Room& room, std::vector<std::string>& notes);

}  // namespace lichtmc::app
