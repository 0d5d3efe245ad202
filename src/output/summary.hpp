// The summary of a run as JSON.
#pragma once

#include "base/atomic_file.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Writes the content of summary.json; receivers and channels one by one, because there may be very
// many.
void write_summary(const Room& room, const Result& result, const ResultFiles& files, const Sink& sink);

}  // namespace lichtmc
