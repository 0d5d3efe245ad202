// A run's summary as JSON.
#pragma once

#include "base/atomic_file.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// What summary.json holds, receivers one by one: there may be very many.
void write_summary(const Room& room, const Result& result, const Sink& sink);

}  // namespace lichtmc
