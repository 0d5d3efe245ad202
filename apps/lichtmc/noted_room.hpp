// The room of a run of the command line, for the Python package: without the options of commands.
#pragma once

#include <filesystem>

#include "lichtmc/room.hpp"
#include "lichtmc/state.hpp"

namespace lichtmc::app {

// Reads the room of a state again, with the options of `lichtmc run` that the state contains. file: where the state is,
// for messages. Throws InputError if another program or version wrote the state, or if the room is not where it was.
Room noted_room(const State& state, const std::filesystem::path& file);

}  // namespace lichtmc::app
