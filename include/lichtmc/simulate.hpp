// The simulation: from a room and settings to the irradiance of every tile and receiver.
#pragma once

#include "lichtmc/control.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/state.hpp"

namespace lichtmc {

// Simulates Settings::photons histories and returns the irradiance of every tile; if the room has receivers, also
// simulates the same number of backward histories and returns the irradiance at each receiver.
//
// The same room, settings and seed give the same results, bit for bit, for any number of threads and ranks (if a time
// limit or an interrupt ends the run: for the same number of histories). The function keeps no state: several
// simulations may run concurrently in one process.
//
// Throws InputError if the room (see check_room()) or a setting is not valid; for ρ = 1 with the absorption estimator;
// a closed room without absorption; a receiver on an emitter; Measured::receivers without receivers; Engine::cuboid for
// a room that is not a cuboid. Throws RuntimeError if memory or the tracing device fails.
Result simulate(const Room& room, const Settings& settings = {}, const Control& control = {});

// The memory that impulse responses need (Settings::channel), in bytes: their sums, the results and the state as it is
// written. It grows with receivers, emitters that are kept apart, orders and bins; simulate() refuses more than the
// machine has. threads: of the run. needed is 0 without impulse responses.
MemoryForecast forecast_channel_memory(const Room& room, const Settings& settings, unsigned threads = 2);

// Continues a run of the same room until the first stop rule of `rules` is met: photons, counted from the first of the
// run; target_error; max_seconds, of this session without repeated integration of direct light. rules.threads is used
// too; all other settings are those of the state. The result is, bit for bit, that of one run with these rules; if the
// state already meets them, that of the state. An estimator that was chosen is kept.
//
// Throws as simulate() does, and InputError if the room is not that of the state, versions differ, or the state has
// gaps.
Result resume(const Room& room, State state, const Settings& rules, const Control& control = {});

// The result of a state, of one run or of merged parts. threads: as Settings::threads. Throws as resume() does, but not
// for gaps, and InputError if the state contains no walk.
Result result_of(const Room& room, State state, unsigned threads = 0, const Control& control = {});

}  // namespace lichtmc
