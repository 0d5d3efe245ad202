// The caller's control over a run: progress, stop, checkpoints, ranks that share it.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>

#include "lichtmc/communicator.hpp"
#include "lichtmc/prepared_room.hpp"
#include "lichtmc/progress.hpp"
#include "lichtmc/state.hpp"

namespace lichtmc {

struct Control {
  // Called before each step of the preparation, and some times a second while a walk runs, by one thread at a time,
  // which may be any thread of the run. It should return quickly. An exception from it ends the run and is rethrown by
  // simulate().
  std::function<void(const Progress&)> progress;
  // Ends the run early; the result then contains what was simulated so far (StopReason::interrupt).
  std::stop_token stop;
  // Called every checkpoint_seconds (≥ 0) with the state so far, for write_state(), by the thread that called
  // simulate(); the walk waits meanwhile. Less often if it would take more than 1 % of the time. Not
  // called while direct light is integrated or an estimator is being chosen. An exception from it ends the run.
  std::function<void(const State&)> checkpoint;
  double checkpoint_seconds = 60.0;
  // Ranks that share the run, or null. All get the result; callbacks are called by rank 0 only. A stop on any rank, or
  // the end of its time, ends the run of all ranks within about a second.
  Communicator* communicator = nullptr;
  // What is known of the room's surfaces, from prepare(); null: it is found again. The steps of its preparation are
  // then reported to its own callback.
  std::shared_ptr<PreparedRoom> prepared;
};

}  // namespace lichtmc
