#include "lichtmc/simulate.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sched.h>

#include "base/message.hpp"
#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"
#include "run/forward.hpp"
#include "run/gather.hpp"
#include "run/logbook.hpp"
#include "run/receive.hpp"
#include "run/settings_check.hpp"
#include "run/stop_watch.hpp"
#include "run/surface_results.hpp"
#include "run/team_work.hpp"
#include "run/warnings.hpp"
#include "walk/scene.hpp"
#include "walk/trap.hpp"

namespace lichtmc {

namespace {

// Those that this process may run on: batch systems and mpirun bind processes to some of the machine's.
unsigned usable_processors() {
  cpu_set_t usable;
  if (::sched_getaffinity(0, sizeof usable, &usable) == 0)
    return static_cast<unsigned>(std::max(1, CPU_COUNT(&usable)));
  return std::max(1U, std::thread::hardware_concurrency());
}

unsigned threads_for(const Settings& settings) {
  const unsigned processors = usable_processors();
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
                    const Control& control, Logbook& logbook) {
  const StateData& data = logbook.data();
  if (settings.tiles == TileWalk::forward) {
    StopWatch watch(settings.max_seconds, control.stop, data.photons ? data.photons->seconds : 0.0, control.team);
    walk_from_emitters(room, scene, settings, control, watch, logbook, result);
  } else {
    StopWatch watch(settings.max_seconds, control.stop, data.tile_walks ? data.tile_walks->seconds : 0.0, control.team);
    walk_from_tiles(room, scene, settings, control, watch, logbook, result);
  }
  rate(result);
}

bool stop_asked(const Control& control) {
  bool asked = control.stop.stop_requested();
  share(control.team, asked);
  return asked;
}

Result simulate_checked(const Room& room, const Settings& settings, const Control& control, Logbook& logbook) {
  Result result;
  result.settings = settings;
  result.threads = threads_for(settings);
  result.processes = size_of(control.team);
  result.tiling = make_tiling(room, settings.tile_edge_m);
  const Scene scene(room, result.tiling, settings.engine);
  result.engine = logbook.data().engine = scene.engine;
  check_memory(room, result.tiling, settings, result.threads, scene.has_maps());
  if (!settings.max_bounces && traps_light(scene, settings.seed)) refuse_trap(room);
  const StateData& data = logbook.data();
  const bool forward = settings.ways != Ways::backward && (!logbook.only_read() || data.photons || data.tile_walks);
  const bool backward =
      settings.ways != Ways::forward && !room.receivers.empty() && (!logbook.only_read() || data.receivers);
  Settings each = settings;
  bool receivers_missing = false;  // what was found of the tiles is kept then
  if (forward && backward && each.max_seconds) each.max_seconds = 0.5 * *each.max_seconds;
  if (forward) simulate_tiles(result, room, scene, each, control, logbook);
  if (backward && forward && stop_asked(control)) {
    receivers_missing = true;
  } else if (backward) {
    StopWatch watch(each.max_seconds, control.stop, data.receivers ? data.receivers->seconds : 0.0, control.team);
    try {
      receive(room, scene, each, control, watch, logbook, result);
    } catch (const StoppedTooSoon&) {
      if (!forward) throw;
      receivers_missing = true;
    }
  }
  complete(result, room);
  if (receivers_missing)
    result.warnings.emplace_back(
        "The run was stopped before the first walks back from the receivers: they were not measured.");
  result.checkpoint_seconds = logbook.spent();
  result.state = logbook.close();
  return result;
}

// All members have read the same file, or not.
void check_team_room(Team* team, const Fingerprint& room) {
  Fingerprint of_first = room;
  share(team, of_first);
  if (of_first != room)
    throw InputError("Process " + std::to_string(rank_of(team)) +
                     " has another room than the first (allowed: the same file for all). Put the room where all "
                     "machines see it.");
}

// What is the same for a run from the start and for one that goes on.
Result simulate_from(const Room& room, const Settings& settings, const Control& control, StateData data,
                     bool only_read) {
  try {
    check_settings(settings);
    check_room(room);
    check_settings_for(room, settings);
    if (!(control.checkpoint_seconds >= 0.0)) {
      throw InputError("The time between checkpoints is " + to_text(control.checkpoint_seconds) +
                       " s (allowed: 0 or more). Give --checkpoint a time, for example 60s.");
    }
    check_team_room(control.team, data.room);
    Logbook logbook(control, std::move(data), only_read);
    return simulate_checked(room, settings, control, logbook);
  } catch (const std::bad_alloc&) {
    throw RuntimeError("There is not enough memory to simulate " + room.source +
                       ". Use larger tiles (--tile) or fewer threads (--threads).");
  }
}

StateData new_state(const Room& room, const Settings& settings) {
  StateData data;
  data.version = version();
  data.room = fingerprint(room);
  data.settings = settings;
  return data;
}

void check_state_for(const Room& room, const State& state) {
  if (state.empty()) throw InputError("The state is empty. Give one that simulate() or read_state() has returned.");
  if (state.version() != version()) {
    throw InputError("The state was made by lichtmc " + state.version() + ", this is " + std::string(version()) +
                     " (allowed: the same version, or figures could differ). Go on with that version, or run anew.");
  }
  if (state.room() != fingerprint(room)) {
    throw InputError("The state is of another room than " + room.source +
                     " as it is now (allowed: the same surfaces, reflectances, lamps and receivers). Give the room's "
                     "file as it was, or run anew.");
  }
}

// The data, without a second copy of the tallies where nobody else holds the state.
StateData data_of(State&& state) {
  StateData data = state.data();
  state = {};
  return data;
}

void refuse_gaps(const std::vector<HistoryRange>& ranges) {
  if (ranges.size() < 2) return;
  throw InputError(
      "The state has gaps: nothing is there of " + std::to_string(ranges[0].last) + " … " +
      std::to_string(ranges[1].first - 1) +
      " (allowed: histories without gaps, to go on). Simulate what is missing with --histories, and merge.");
}

}  // namespace

Result simulate(const Room& room, const Settings& settings, const Control& control) {
  return simulate_from(room, settings, control, new_state(room, settings), false);
}

Result resume(const Room& room, State state, const Settings& rules, const Control& control) {
  check_state_for(room, state);
  Settings settings = state.settings();
  settings.photons = rules.photons;
  settings.target_error = rules.target_error;
  settings.max_seconds = rules.max_seconds;
  settings.threads = rules.threads;
  StateData data = data_of(std::move(state));
  if (data.photons) refuse_gaps(data.photons->ranges);
  if (data.tile_walks) refuse_gaps(data.tile_walks->ranges);
  if (data.receivers) refuse_gaps(data.receivers->ranges);
  data.settings = settings;
  return simulate_from(room, settings, control, std::move(data), false);
}

Result result_of(const Room& room, State state, const Control& control) {
  check_state_for(room, state);
  const Settings settings = state.settings();
  return simulate_from(room, settings, control, data_of(std::move(state)), true);
}

}  // namespace lichtmc
