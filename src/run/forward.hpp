// Forward walks: photons from the emitters to the tiles, until the first stop rule is met.
#pragma once

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "run/run_record.hpp"
#include "run/stop_watch.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// Fills in what the photons tell: tiles, surfaces, balance, incident power, and how they were got. Goes on from the
// photons that the logbook has, and leaves there what was counted in the end. Throws RuntimeError where the run is
// stopped before the first photon is simulated.
void walk_from_emitters(const Room& room, const Scene& scene, const Settings& settings, const Control& control,
                        StopWatch& watch, RunRecord& record, Result& result);

}  // namespace lichtmc
