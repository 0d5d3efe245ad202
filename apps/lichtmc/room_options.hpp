// Options about the room, the same for every command that takes one: how its file is read, and what is set right in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc::app {

struct RoomOptions {
  std::string file;
  std::optional<std::string> scale, unit, max_reflectance;
  std::string up = "y";
  std::vector<std::string> lights;
  std::vector<std::string> reflectances;
  std::string scene;
  std::optional<int> uv_set;
};

// ROOM itself, the command's first argument.
void add_room_argument(CLI::App& command, RoomOptions& options);

// Everything else, as a group of the command's help.
void add_room_options(CLI::App& command, RoomOptions& options);

// The room as its file and the options say. Throws InputError naming the file or the option.
Room read_room(const RoomOptions& options);

}  // namespace lichtmc::app
