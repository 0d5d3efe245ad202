// States in memory, for programs that keep or send them by other means than files.
#pragma once

#include <string>
#include <string_view>

#include "lichtmc/state.hpp"

namespace lichtmc {

// The bytes of the file that write_state() would write. Throws RuntimeError if there is not enough memory.
std::string state_bytes(const State& state, std::string_view note = {});

// The state of these bytes. source: what messages call them. Throws InputError as read_state().
State parse_state(std::string_view bytes, const std::string& source);

}  // namespace lichtmc
