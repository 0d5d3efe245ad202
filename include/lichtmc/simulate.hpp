// The simulation: a room and settings in, irradiance of every tile out.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"

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
};

// Follows Settings::photons light packets through a room and returns the irradiance of every tile; and where the room
// has receivers, as many walks from them back to the light, and returns the irradiance at each.
//
// The same room, settings and seed give the same tile results, bit for bit, for any number of threads (where a stop
// rule of time or an interrupt ends the run: for the same number of histories). The function keeps no state: several
// simulations may run at once in one process.
//
// Throws InputError where the room or a setting is not sound: see check_room(); ρ = 1 with the absorption estimator; a
// closed room in which nothing absorbs; a receiver that lies on an emitter; Ways::backward without receivers;
// Engine::cuboid for a room that is no cuboid. Throws RuntimeError where memory or the tracing device fails.
Result simulate(const Room& room, const Settings& settings = {}, const Control& control = {});

}  // namespace lichtmc
