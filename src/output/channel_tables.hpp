// Impulse responses and channels as tables of text (CSV).
#pragma once

#include "base/atomic_file.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

// The content of impulse_response.csv: a row for every emitter, receiver, order and bin; time_s is the middle of the
// bin. The result has channels.
void write_impulse_responses_csv(const Result& result, const Sink& sink);

// The content of channels.csv: a row for every emitter and receiver. The result has channels.
void write_channels_csv(const Result& result, const Sink& sink);

}  // namespace lichtmc
