// What is where in state.h5 (docs/state.md): said once, for writing and for reading.
#pragma once

#include "run/state_data.hpp"
#include "store/hdf5_file.hpp"

namespace lichtmc {

// The first line of the file. Another number wherever anything below changes.
inline constexpr const char* state_title = "lichtmc state, layout 1";

// Puts what the data holds into the file, or fills it in from there. Throw Hdf5Error.
void write_layout(Hdf5File& file, const StateData& data);
StateData read_layout(Hdf5File& file);

}  // namespace lichtmc
