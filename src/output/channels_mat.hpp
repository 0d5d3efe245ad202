// Impulse responses as a MATLAB file.
#pragma once

#include <string>

#include "base/atomic_file.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

// Why channels.mat cannot be written, as a sentence; empty if it can. An array of MAT-files of level 5 has less than
// 2 GiB. The result has channels.
std::string obstacle_to_channels_mat(const Result& result);

// The content of channels.mat (MAT-file level 5): the arrays of channel_arrays() with their dimensions reversed,
// because MATLAB's first dimension is the fastest, derived figures as the fields of a struct, names as cell arrays; for
// a single channel in bins of 1 ns also averun1 (1 … bins) and averun2 (gain per bin), the names of the channel models
// of IEEE 802.11bb. The result has channels, and there is no obstacle. Throws RuntimeError if the file cannot be made.
void write_channels_mat(const Result& result, const Sink& sink);

}  // namespace lichtmc
