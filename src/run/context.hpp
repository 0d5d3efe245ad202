// The data that all steps of one walk of a run share.
#pragma once

#include "lichtmc/control.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/tiles.hpp"
#include "run/run_record.hpp"
#include "run/stop_watch.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

struct RunContext {
  const Room& room;
  const Tiling& tiling;
  const Scene& scene;
  const Settings& settings;  // as requested
  const Control& control;
  StopWatch& watch;   // of this walk
  RunRecord& record;  // of the run
  unsigned threads;   // of this process

  // The settings with the estimator of one walk.
  Settings settings_with(Estimator estimator) const {
    Settings own = settings;
    own.estimator = estimator;
    return own;
  }
};

}  // namespace lichtmc
