// Results by backward walks: irradiance at the receivers, and on request of the tiles.
#pragma once

#include <optional>
#include <vector>

#include "lichtmc/emitter_parts.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "run/context.hpp"
#include "run/error_measure.hpp"
#include "run/measured_tiles.hpp"
#include "run/state_data.hpp"

namespace lichtmc {

// Throws InputError if no walk from the receivers belongs to the histories of a part.
void check_receiver_rounds(const Room& room, const Settings& settings);

// Throws InputError if walks from the receivers are missing before or between those of the state.
void check_receivers_whole(const Room& room, const Settings& settings, const BackwardState& walks);

struct ReceiverMeasurement {
  std::vector<ReceiverResult> receivers;
  std::vector<AreaResult> areas;
  std::optional<EmitterParts> parts;  // if Settings::per_emitter asks for them
  std::optional<ImpulseResponses> channels;
  WalkReport report;
};

// Irradiance at the room's receivers, of which there is at least one. Throws InputError naming a receiver that lies on
// an emitter, StoppedTooSoon if the run is stopped before the first round is complete.
ReceiverMeasurement measure_receivers(const RunContext& context);

// Irradiance of the tiles by backward walks from random points of each.
TileMeasurement measure_tiles_backward(const RunContext& context, const TileErrorMeasure& measure);

}  // namespace lichtmc
