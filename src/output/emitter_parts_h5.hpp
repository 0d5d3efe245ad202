// Writes the parts of emitters as HDF5.
#pragma once

#include "base/atomic_file.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

inline constexpr const char* emitter_parts_file = "emitter_parts.h5";

// The content of emitter_parts.h5; result.parts must be set. Throws RuntimeError if memory is exhausted.
void write_emitter_parts(const Room& room, const Result& result, const Sink& sink);

}  // namespace lichtmc
