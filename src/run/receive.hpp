// Results by walks back to the light: irradiance at the receivers, and of the tiles where that is asked for.
#pragma once

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "run/run_record.hpp"
#include "run/state_data.hpp"
#include "run/stop_watch.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// Throws InputError where no walk from the receivers belongs to the histories of a part.
void check_receiver_rounds(const Room& room, const Settings& settings);

// Throws InputError where walks from the receivers are missing before those that there are, or between them.
void check_receivers_whole(const Room& room, const Settings& settings, const BackwardState& walks);

// Fills in Result::receiver_results and Result::backward. The room has receivers. Throws InputError naming a receiver
// that lies on an emitter. Goes on from the walks that the logbook has, and leaves there what was found, as gather()
// does.
void receive(const Room& room, const Scene& scene, const Settings& settings, const Control& control, StopWatch& watch,
             RunRecord& record, Result& result);

// Fills in the tiles' part of the result by walks from random points of every tile.
void walk_from_tiles(const Room& room, const Scene& scene, const Settings& settings, const Control& control,
                     StopWatch& watch, RunRecord& record, Result& result);

}  // namespace lichtmc
