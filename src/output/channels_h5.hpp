// Impulse responses as an HDF5 file.
#pragma once

#include "base/atomic_file.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

// The content of channels.h5: every array of channel_arrays() as a data set with its unit, dimensions and description,
// the names of emitters, receivers and orders, and the settings. The result has channels. The file is made in memory.
// Throws RuntimeError if HDF5 fails.
void write_channels_h5(const Result& result, const Sink& sink);

}  // namespace lichtmc
