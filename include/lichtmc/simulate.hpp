// The simulation: a room and settings in, irradiance of every tile out.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>

#include "lichtmc/communicator.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/state.hpp"

namespace lichtmc {

// Where a run stands.
struct Progress {
  enum class Stage {
    direct_light,  // integrating it; histories and target are tiles, or receivers
    pilot,         // short walks by which Estimator::automatic chooses
    tiles,         // walks for the tiles
    receivers,     // walks for the receivers
  };
  Stage stage = Stage::tiles;
  std::uint64_t histories = 0;  // simulated so far
  std::uint64_t target = 0;     // that there are to simulate if no other stop rule comes first
  std::uint64_t impacts = 0;
  double seconds = 0.0;  // since the walk, or its direct light, began
  // At the last time it was evaluated; NaN before that.
  double rms_relative_error = std::numeric_limits<double>::quiet_NaN();
  // Forecast of the time until Settings::target_error is met, from the errors so far; NaN where there is none.
  double seconds_to_target = std::numeric_limits<double>::quiet_NaN();
};

struct Control {
  // Called some times a second while the walk runs, from one thread at a time, and that may be any of the run's
  // threads. It should return soon. An exception from it ends the run and comes out of simulate().
  std::function<void(const Progress&)> progress;
  // Ends the run early; the result then holds what was simulated so far (StopReason::interrupt).
  std::stop_token stop;
  // Called every checkpoint_seconds (≥ 0) with what was counted so far, for write_state(), from the thread that called
  // simulate(); the walk waits meanwhile. Seldomer where that would take more than a hundredth of the time. Not called
  // while direct light is integrated or an estimator is being chosen. An exception from it ends the run.
  std::function<void(const State&)> checkpoint;
  double checkpoint_seconds = 60.0;
  // Members that share the run, or null. All get the result; callbacks are called by the first alone. A stop that one
  // of them asks for, or whose time is over, ends the run of all, within a second or so.
  Communicator* communicator = nullptr;
};

// Follows Settings::photons light packets through a room and returns the irradiance of every tile; and where the room
// has receivers, as many walks from them back to the light, and returns the irradiance at each.
//
// The same room, settings and seed give the same tile results, bit for bit, for any number of threads and members of a
// team (where a stop rule of time or an interrupt ends the run: for the same number of histories). The function keeps
// no state: several simulations may run at once in one process.
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
