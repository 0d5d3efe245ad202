// The layout of state.h5 (docs/state.md): the fields of StateData by their names, see base/fields.hpp.
#pragma once

#include "run/state_data.hpp"
#include "store/hdf5_file.hpp"

namespace lichtmc {

// The first line of the file. Its number changes whenever the fields or their storage change.
inline constexpr const char* state_title = "lichtmc state, layout 7";

// Write the data into the file, or read them from it. Throw Hdf5Error.
void write_layout(Hdf5File& file, const StateData& data);
StateData read_layout(Hdf5File& file);

}  // namespace lichtmc
