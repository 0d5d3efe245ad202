#include "lichtmc/simulate.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/message.hpp"
#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "run/forward.hpp"
#include "run/receive.hpp"
#include "run/settings_check.hpp"
#include "run/stop_watch.hpp"
#include "run/surface_results.hpp"
#include "run/warnings.hpp"
#include "walk/scene.hpp"
#include "walk/trap.hpp"

namespace lichtmc {

namespace {

unsigned threads_for(const Settings& settings) {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  const unsigned asked = settings.threads == 0 ? processors : settings.threads;
  // A thread without a batch would only cost memory.
  return static_cast<unsigned>(std::min<std::uint64_t>(asked, batches_of(settings.photons)));
}

std::vector<Ignored> ignored_by_run(const Room& room, Ways ways) {
  std::vector<Ignored> ignored = room.ignored;
  std::size_t without_area = 0;
  for (const Surface& surface : room.surfaces) without_area += surface.without_area;
  if (without_area > 0) {
    ignored.push_back({to_text(without_area, "triangle") + " without area: no light can fall on them.", Effect::none});
  }
  if (!room.receivers.empty() && ways == Ways::forward) {
    ignored.push_back({to_text(room.receivers.size(), "receiver") + " (" + in_quotes(room.receivers.front().name) +
                           (room.receivers.size() > 1 ? ", …" : "") + "): only tiles were asked for.",
                       Effect::none});
  }
  return ignored;
}

// How good the tiles are.
void rate(Result& result) {
  result.rms_relative_error = rms_relative_error(result.tiling, result.tiles);
  result.figure_of_merit = 1.0 / (result.rms_relative_error * result.rms_relative_error * result.seconds);
  if (result.convergence.empty() || result.convergence.back().histories != result.histories)
    result.convergence.push_back({result.histories, result.seconds, result.rms_relative_error});
  result.tiles_without_hits = static_cast<std::uint64_t>(std::count_if(
      result.tiles.begin(), result.tiles.end(), [](const TileResult& tile) { return !(tile.irradiance > 0.0); }));
}

// What holds of the run as a whole.
void complete(Result& result, const Room& room) {
  result.room = room.source;
  result.quantity = room.quantity;
  result.receivers = room.receivers;
  result.ignored = ignored_by_run(room, result.settings.ways);
  result.mended = room.mended;
  result.balance.emitted = total_power(room);
  result.warnings = warnings_of(room, result);
}

[[noreturn]] void refuse_trap(const Room& room) {
  throw InputError(
      "Nothing absorbs the light of an emitter in " + room.source +
      ": it is shut in by surfaces whose reflectance is 1 (allowed: at least one below 1, or an opening), so that the "
      "light would grow "
      "without end. Give materials a reflectance below 1, for example with --max-reflectance 0.9, or cut the walk off "
      "with --estimator weight --max-bounces N.");
}

void simulate_tiles(Result& result, const Room& room, const Scene& scene, const Settings& settings,
                    const Control& control) {
  StopWatch watch(settings.max_seconds, control.stop);
  if (settings.tiles == TileWalk::forward) {
    walk_from_emitters(room, scene, settings, control, watch, result);
  } else {
    walk_from_tiles(room, scene, settings, control, watch, result);
  }
  rate(result);
}

Result simulate_checked(const Room& room, const Settings& settings, const Control& control) {
  Result result;
  result.settings = settings;
  result.threads = threads_for(settings);
  result.tiling = make_tiling(room, settings.tile_edge_m);
  const Scene scene(room, result.tiling, settings.engine);
  result.engine = scene.engine;
  if (!settings.max_bounces && traps_light(scene, settings.seed)) refuse_trap(room);
  const bool forward = settings.ways != Ways::backward;
  const bool backward = settings.ways != Ways::forward && !room.receivers.empty();
  Settings each = settings;
  if (forward && backward && each.max_seconds) each.max_seconds = 0.5 * *each.max_seconds;
  if (forward) simulate_tiles(result, room, scene, each, control);
  if (backward && !control.stop.stop_requested()) {
    StopWatch watch(each.max_seconds, control.stop);
    receive(room, scene, each, control, watch, result);
  }
  complete(result, room);
  return result;
}

}  // namespace

Result simulate(const Room& room, const Settings& settings, const Control& control) {
  try {
    check_settings(settings);
    check_room(room);
    check_settings_for(room, settings);
    return simulate_checked(room, settings, control);
  } catch (const std::bad_alloc&) {
    throw RuntimeError("There is not enough memory to simulate " + room.source +
                       ". Use larger tiles (--tile) or fewer threads (--threads).");
  }
}

}  // namespace lichtmc
