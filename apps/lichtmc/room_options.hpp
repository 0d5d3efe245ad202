// Options of the room, the same for every command that reads one: how its file is read, and input overrides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc::app {

struct RoomOptions {
  std::string file;
  std::optional<std::string> scale, unit, max_reflectance, maintenance_factor;
  std::string up = "y";
  std::vector<std::string> lights;
  std::vector<std::string> reflectances;
  std::vector<std::string> without;
  bool follow_links = false;
  std::string scene;
  std::optional<int> uv_set;
};

// ROOM, the first argument of the command.
void add_room_argument(CLI::App& command, RoomOptions& options);

// All other options, as a group of the command's help.
void add_room_options(CLI::App& command, RoomOptions& options);

// The room of the file with the overrides of the options. Throws InputError that names the file or the option.
Room read_room(const RoomOptions& options);

}  // namespace lichtmc::app
