// The simulation: a room and settings in, irradiance of every tile out.
#pragma once

#include "lichtmc/control.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/state.hpp"

namespace lichtmc {

// Follows Settings::photons photons through a room and returns the irradiance of every tile; where the room has
// receivers, also follows as many backward walks from them and returns the irradiance at each.
//
// The same room, settings and seed give the same results, bit for bit, for any number of threads and ranks (where a
// time limit or an interrupt ends the run: for the same number of histories). The function keeps no state: several
// simulations may run at once in one process.
//
// Throws InputError where the room or a setting is not sound: see check_room(); ρ = 1 with the absorption estimator; a
// closed room in which nothing absorbs; a receiver that lies on an emitter; Measured::receivers without receivers;
// Engine::cuboid for a room that is no cuboid. Throws RuntimeError where memory or the tracing device fails.
Result simulate(const Room& room, const Settings& settings = {}, const Control& control = {});

// Goes on with a run of the same room until the first of the stop rules of `rules` is met: photons, counted from the
// run's first; target_error; max_seconds, of this session, in which integrating direct light anew does not count. Its
// threads count too; everything else is as the state has it. The result is, to the last digit, that of one run under
// these rules (where they are looser than those that the state has ended by: that of the state). A run whose estimator
// was chosen keeps its choice.
//
// Throws as simulate() does, and InputError where the room is not the state's, where versions differ, or where the
// state has gaps.
Result resume(const Room& room, State state, const Settings& rules, const Control& control = {});

// The result of what a state holds, of one run or of several that were merged. threads: as Settings::threads. Throws as
// resume() does, and InputError where the state holds nothing; gaps do not matter.
Result result_of(const Room& room, State state, unsigned threads = 0, const Control& control = {});

}  // namespace lichtmc
