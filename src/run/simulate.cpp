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
#include "run/collectives.hpp"
#include "run/forward.hpp"
#include "run/gather.hpp"
#include "run/receive.hpp"
#include "run/run_record.hpp"
#include "run/settings_check.hpp"
#include "run/stop_watch.hpp"
#include "run/surface_results.hpp"
#include "run/warnings.hpp"
#include "walk/non_absorbing_enclosure.hpp"
#include "walk/scene.hpp"

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

std::vector<Ignored> ignored_by_run(const Room& room, Measured measured) {
  std::vector<Ignored> ignored = room.ignored;
  std::size_t without_area = 0;
  for (const Surface& surface : room.surfaces) without_area += surface.without_area;
  if (without_area > 0) {
    ignored.push_back({to_text(without_area, "triangle") + " without area: no light can fall on them.", Effect::none});
  }
  if (!room.receivers.empty() && measured == Measured::tiles) {
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
  result.ignored = ignored_by_run(room, result.settings.measured);
  result.mended = room.mended;
  result.balance.emitted = total_power(room);
  result.warnings = warnings_of(room, result);
}

[[noreturn]] void refuse_non_absorbing_enclosure(const Room& room) {
  throw InputError(
      "Nothing absorbs the light of an emitter in " + room.source +
      ": it is shut in by surfaces whose reflectance is 1 (allowed: at least one below 1, or an opening), so that the "
      "light would grow "
      "without end. Give materials a reflectance below 1, for example with --max-reflectance 0.9, or cut the walk off "
      "with --estimator weight --max-bounces N.");
}

template <class Walk>
double seconds_of(const std::optional<Walk>& walk) {
  return walk ? walk->seconds : 0.0;
}

// What earlier sessions have walked for the tiles, and for the receivers.
struct WalkedBefore {
  explicit WalkedBefore(const StateData& data)
      : tiles(seconds_of(data.photons) + seconds_of(data.tile_walks)), receivers(seconds_of(data.receivers)) {}
  double tiles = 0.0;      // s
  double receivers = 0.0;  // s
};

// Where both are measured each gets half of the time of all sessions, as if the run had not been interrupted.
std::optional<double> half_of_time(const Settings& settings, const WalkedBefore& before, double mine) {
  if (!settings.max_seconds) return std::nullopt;
  const double half = 0.5 * (before.tiles + before.receivers + *settings.max_seconds);
  return std::clamp(half - mine, 0.0, *settings.max_seconds);
}

void simulate_tiles(Result& result, const Room& room, const Scene& scene, const Settings& settings,
                    const Control& control, StopWatch& watch, RunRecord& record) {
  if (settings.tile_walk == WalkDirection::forward) {
    walk_from_emitters(room, scene, settings, control, watch, record, result);
  } else {
    walk_from_tiles(room, scene, settings, control, watch, record, result);
  }
  rate(result);
}

// Which walks there are to do. A state that is only read may hold one of them, or both.
struct WaysToGo {
  WaysToGo(const Room& room, const Settings& settings, const RunRecord& record) {
    const StateData& data = record.data();
    forward = settings.measured != Measured::receivers && (!record.only_read() || data.photons || data.tile_walks);
    backward =
        settings.measured != Measured::tiles && !room.receivers.empty() && (!record.only_read() || data.receivers);
  }
  bool forward = false;
  bool backward = false;
};

constexpr const char* tiles_left_out =
    "The state has no walk for the tiles: the run was stopped while it chose their estimator. They are not among the "
    "results; going on from it begins them anew.";
constexpr const char* receivers_not_measured =
    "The run was stopped before the first walks back from the receivers: they were not measured. Go on with it, and "
    "give it more time than integrating their direct light takes.";
constexpr const char* receivers_left_out =
    "The run was stopped before the direct light of the receivers was found anew: they are not among the results. The "
    "state has the walks back from them; going on from it brings them back.";

// The receivers after the tiles. What was found of the tiles is kept where a stop comes before there is anything to
// tell of the receivers: false then.
bool receive_after_tiles(Result& result, const Room& room, const Scene& scene, const Settings& settings,
                         const Control& control, StopWatch& watch, RunRecord& record) {
  if (count_votes(control.communicator, control.stop.stop_requested()) > 0) {
    result.stopped_by = StopReason::interrupt;
    return false;
  }
  try {
    receive(room, scene, settings, control, watch, record, result);
    return true;
  } catch (const StoppedTooSoon&) {
    result.stopped_by = watch.reason().value_or(StopReason::interrupt);
    return false;
  }
}

// A state has one of them; it is found from the room, so that another one means that the file was tampered with.
void note_engine(StateData& data, Engine used) {
  if ((data.photons || data.tile_walks || data.receivers) && data.engine != used) {
    throw InputError("The state was traced by the engine '" + std::string(to_string(data.engine)) +
                     "', the room needs '" + std::string(to_string(used)) +
                     "' (allowed: the same). The state is not one of this room; run anew.");
  }
  data.engine = used;
}

Result simulate_checked(const Room& room, const Settings& settings, const Control& control, RunRecord& record) {
  Result result;
  result.settings = settings;
  result.threads = threads_for(settings);
  result.processes = size_of(control.communicator);
  result.tiling = make_tiling(room, settings.tile_edge_m);
  const Scene scene(room, result.tiling, settings.engine);
  note_engine(record.data(), scene.engine);
  result.engine = scene.engine;
  // Photons are only counted again where a state is only read, by one thread.
  const unsigned tallies = record.only_read() ? 1 : result.threads;
  check_memory(room, result.tiling, settings, tallies, result.processes, scene.has_reflectance_maps());
  if (!settings.max_bounces && has_non_absorbing_enclosure(scene, settings.seed)) refuse_non_absorbing_enclosure(room);
  const WaysToGo go(room, settings, record);
  const WalkedBefore before(record.data());
  const bool both = go.forward && go.backward;
  if (both && !record.data().receivers) check_receiver_rounds(room, settings);
  const bool receivers_known = record.data().receivers.has_value();
  bool receivers_told = true;
  if (go.forward) {
    StopWatch watch(both ? half_of_time(settings, before, before.tiles) : settings.max_seconds, control.stop,
                    before.tiles, control.communicator);
    simulate_tiles(result, room, scene, settings, control, watch, record);
  }
  if (go.backward) {
    StopWatch watch(both ? half_of_time(settings, before, before.receivers) : settings.max_seconds, control.stop,
                    before.receivers, control.communicator);
    if (both) {
      receivers_told = receive_after_tiles(result, room, scene, settings, control, watch, record);
    } else {
      receive(room, scene, settings, control, watch, record, result);
    }
  }
  complete(result, room);
  const bool tiles_missing = settings.measured != Measured::receivers && !go.forward;
  if (tiles_missing) result.warnings.emplace_back(tiles_left_out);
  if (!receivers_told) result.warnings.emplace_back(receivers_known ? receivers_left_out : receivers_not_measured);
  result.checkpoint_seconds = record.spent();
  result.state = record.close();
  return result;
}

// All members have read the same files and were given the same options, or histories would count twice. All refuse.
void check_ranks_agree(Communicator* communicator, const StateData& data) {
  const auto check = [communicator](const Fingerprint& mine, const std::string& what) {
    Fingerprint of_first = mine;
    broadcast(communicator, of_first);
    const std::uint64_t others = count_votes(communicator, of_first != mine);
    if (others > 0)
      throw InputError(std::to_string(others) + " of " + std::to_string(size_of(communicator)) + " processes have " +
                       what);
  };
  check(data.room,
        "another room than the first (allowed: the same file for all). Put the room where all machines see it.");
  check(fingerprint(data),
        "other settings, another state or another version of lichtmc than the first (allowed: the same for all). Give "
        "all the same options and the same program, and put state.h5 where all machines see it.");
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
    check_ranks_agree(control.communicator, data);
    RunRecord record(control, std::move(data), only_read);
    return simulate_checked(room, settings, control, record);
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
  check_version(state);
  if (state.room() != fingerprint(room)) {
    throw InputError("The state is of another room than " + room.source +
                     " as it is now (allowed: the same surfaces, reflectances, lamps and receivers, those of a table "
                     "or a grid too). Give the files as they were, or run anew.");
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
      "The state has gaps: nothing is there of histories " + std::to_string(ranges[0].last) + " … " +
      std::to_string(ranges[1].first - 1) +
      " (allowed: histories without gaps, to go on). Simulate what is missing with --histories, and merge.");
}

}  // namespace

Result simulate(const Room& room, const Settings& settings, const Control& control) {
  return simulate_from(room, settings, control, new_state(room, settings), false);
}

Result resume(const Room& room, State state, const Settings& rules, const Control& control) {
  check_state_for(room, state);
  const double seconds_before = state.seconds();
  Settings settings = state.settings();
  settings.photons = rules.photons;
  settings.target_error = rules.target_error;
  settings.max_seconds = rules.max_seconds;
  settings.threads = rules.threads;
  StateData data = data_of(std::move(state));
  if (data.photons) refuse_gaps(data.photons->ranges);
  if (data.receivers) check_receivers_whole(room, settings, *data.receivers);
  data.settings = settings;
  // Of all sessions: a later one subtracts what they have taken.
  if (settings.max_seconds) data.settings.max_seconds = seconds_before + *settings.max_seconds;
  return simulate_from(room, settings, control, std::move(data), false);
}

Result result_of(const Room& room, State state, unsigned threads, const Control& control) {
  check_state_for(room, state);
  const StateData& found = state.data();
  if (!found.photons && !found.tile_walks && !found.receivers) {
    throw InputError(
        "The state holds no walk: the run was stopped before an estimator was chosen (allowed: a state with something "
        "counted). Go on with it by lichtmc resume.");
  }
  Settings settings = state.settings();
  settings.threads = threads;
  return simulate_from(room, settings, control, data_of(std::move(state)), true);
}

}  // namespace lichtmc
