#include "lichtmc/simulate.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "base/message.hpp"
#include "base/parallel.hpp"
#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/units.hpp"
#include "lichtmc/version.hpp"
#include "run/collectives.hpp"
#include "run/context.hpp"
#include "run/drive.hpp"
#include "run/error_measure.hpp"
#include "run/keep_measured.hpp"
#include "run/receive.hpp"
#include "run/run_record.hpp"
#include "run/settings_check.hpp"
#include "run/stop_watch.hpp"
#include "run/tiles_forward.hpp"
#include "run/unreached_tiles.hpp"
#include "run/warnings.hpp"
#include "tracer/prepared_room.hpp"
#include "walk/non_absorbing_enclosure.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

namespace {

unsigned threads_for(const Settings& settings) {
  const unsigned processors = usable_processors();
  const unsigned asked = settings.threads == 0 ? processors : settings.threads;
  // A thread without a batch would only use memory.
  return static_cast<unsigned>(std::min<std::uint64_t>(asked, batches_of(settings.photons)));
}

std::vector<Ignored> ignored_by_run(const Room& room, Measured measured) {
  std::vector<Ignored> ignored = room.ignored;
  std::size_t without_area = 0;
  for (const Surface& surface : room.surfaces) without_area += surface.without_area;
  if (without_area > 0) {
    ignored.push_back({to_text(without_area, "triangle") + " without area: they receive no light.", Effect::none});
  }
  if (!room.receivers.empty() && measured == Measured::tiles) {
    ignored.push_back({to_text(room.receivers.size(), "receiver") + " (" + in_quotes(room.receivers.front().name) +
                           (room.receivers.size() > 1 ? ", …" : "") + "): only tiles were requested.",
                       Effect::none});
  }
  return ignored;
}

// Sets the results that depend on the whole run.
void complete(Result& result, const Room& room, const Enclosure* enclosure) {
  result.room = room.source;
  result.quantity = room.quantity;
  result.receivers = room.receivers;
  result.ignored = ignored_by_run(room, result.settings.measured);
  result.overrides = room.overrides;
  for (const WalkReport* report : {&result.walk, &result.receiver_walk}) {
    if (!report->choice.empty()) result.choices.push_back(report->choice);
  }
  result.balance.emitted = total_power(room);
  result.warnings = warnings_of(room, result, enclosure);
}

[[noreturn]] void refuse_non_absorbing_enclosure(const Room& room, const NonAbsorbingEnclosure& enclosure) {
  throw InputError(
      "Nothing absorbs the light of the emitter " + in_quotes(room.emitters[enclosure.emitter].name) + " in " +
      room.source + ": it is enclosed by surfaces of reflectance 1, among them " +
      in_quotes(room.surfaces[enclosure.surface].name) +
      " (allowed: at least one below 1, or an opening), so that the " + std::string(irradiance_word(room.quantity)) +
      " would be infinite. Give materials a reflectance below 1, for example with --max-reflectance 0.9, or limit the "
      "number of flights with --estimator "
      "weight --max-bounces N. If a body about a lamp should let light through, leave it out of the room.");
}

template <class Walk>
double seconds_of(const std::optional<Walk>& walk) {
  return walk ? walk->seconds : 0.0;
}

// Walking time of earlier sessions for the tiles, and for the receivers.
struct EarlierSeconds {
  explicit EarlierSeconds(const StateData& data)
      : tiles(seconds_of(data.photons) + seconds_of(data.tile_walks)), receivers(seconds_of(data.receivers)) {}
  double tiles = 0.0;      // s
  double receivers = 0.0;  // s
};

// If both are measured, each gets half of the time of all sessions, as in a run without interruption.
std::optional<double> half_of_time(const Settings& settings, const EarlierSeconds& earlier, double mine) {
  if (!settings.max_seconds) return std::nullopt;
  const double half = 0.5 * (earlier.tiles + earlier.receivers + *settings.max_seconds);
  return std::clamp(half - mine, 0.0, *settings.max_seconds);
}

// The walks of a run. A state that is only read may contain one of them, or both.
struct PlannedWalks {
  PlannedWalks(const Room& room, const Settings& settings, const RunRecord& record) {
    const StateData& data = record.data();
    tiles = settings.measured != Measured::receivers && (!record.only_read() || data.photons || data.tile_walks);
    receivers =
        settings.measured != Measured::tiles && !room.receivers.empty() && (!record.only_read() || data.receivers);
  }
  bool tiles = false;
  bool receivers = false;
  bool both() const { return tiles && receivers; }
};

constexpr const char* tiles_left_out =
    "The state has no walk for the tiles: the run was stopped while it chose their estimator. The results do not "
    "include them; resuming the run restarts them.";
constexpr const char* receivers_not_measured =
    "The run was stopped before the first round of walks for the receivers: they were not measured. Resume it, with "
    "more time than the integration of their direct light takes.";
constexpr const char* receivers_left_out =
    "The run was stopped before the direct light of the receivers was computed again: the results do not include them. "
    "The state has their walks; resuming the run includes them.";

// The engine of a state follows from the room: another one means that the file was changed by another program.
void note_engine(StateData& data, Engine used) {
  if ((data.photons || data.tile_walks || data.receivers) && data.engine != used) {
    throw InputError("The state was traced by the engine '" + std::string(to_string(data.engine)) +
                     "', the room needs '" + std::string(to_string(used)) +
                     "' (allowed: the same). The state does not belong to this room; start a new run.");
  }
  data.engine = used;
}

// One run whose input has been checked.
class Run {
 public:
  Run(const Room& room, const Settings& settings, const Control& control, RunRecord& record)
      : room_(room),
        settings_(settings),
        control_(control),
        record_(record),
        planned_(room, settings, record),
        earlier_(record.data()),
        receivers_in_state_(record.data().receivers.has_value()) {
    result_.settings = settings;
    result_.threads = threads_for(settings);
    result_.processes = size_of(control.communicator);
    const auto report = [&control](std::string_view step) {
      if (!control.progress) return;
      Progress progress;
      progress.stage = Progress::Stage::preparation;
      progress.step = step;
      control.progress(progress);
    };
    const auto prepared = prepared_or_new(control.prepared, room, settings.threads, report);
    result_.tiling = prepared->take_tiling(settings.tile_edge_m);
    scene_ = std::make_unique<Scene>(room, result_.tiling, settings.engine, prepared);
    note_engine(record.data(), scene_->engine);
    result_.engine = scene_->engine;
  }

  Result simulate() {
    check();
    if (planned_.tiles) measure_tiles();
    if (planned_.receivers) measure_receivers_after_tiles();
    add_covers();
    PreparedRoom* prepared = scene_->tracer->prepared();
    complete(result_, room_, prepared != nullptr ? &prepared->enclosure() : nullptr);
    warn_of_missing();
    result_.checkpoint_seconds = record_.spent();
    result_.state = record_.close();
    return std::move(result_);
  }

 private:
  void check() const {
    // If a state is only read, one thread simulates the incomplete last batch.
    const unsigned tallies = record_.only_read() ? 1 : result_.threads;
    check_memory(room_, result_.tiling, settings_, tallies, result_.processes, scene_->has_reflectance_maps());
    if (!settings_.max_bounces) {
      if (const auto enclosure = find_non_absorbing_enclosure(*scene_, settings_.seed))
        refuse_non_absorbing_enclosure(room_, *enclosure);
    }
    if (planned_.both() && !receivers_in_state_) check_receiver_rounds(room_, settings_);
  }

  // If tiles and receivers are measured, each gets half of the time.
  std::optional<double> time_for(double mine) const {
    return planned_.both() ? half_of_time(settings_, earlier_, mine) : settings_.max_seconds;
  }

  RunContext context(StopWatch& watch) const {
    return {room_, result_.tiling, *scene_, settings_, control_, watch, record_, result_.threads};
  }

  void measure_tiles() {
    const UnreachedSides unreached(room_, result_.tiling, *scene_);
    const TileErrorMeasure error(room_, result_.tiling, unreached, settings_);
    StopWatch watch(time_for(earlier_.tiles), control_.stop, earlier_.tiles, control_.communicator);
    const RunContext tiles_context = context(watch);
    TileMeasurement measured = settings_.tile_walk == WalkDirection::forward
                                   ? measure_tiles_forward(tiles_context, error)
                                   : measure_tiles_backward(tiles_context, error);
    result_.walk = std::move(measured.report);
    result_.tiles = std::move(measured.tiles);
    result_.surfaces = std::move(measured.surfaces);
    result_.balance = measured.balance;
    result_.incident = measured.incident;
    result_.incident_standard_error = measured.incident_standard_error;
    result_.lost_histories = measured.lost_histories;
    keep_measured(room_, result_);
    result_.tiles_without_hits = static_cast<std::uint64_t>(std::count_if(
        result_.tiles.begin(), result_.tiles.end(), [](const TileResult& tile) { return !(tile.irradiance > 0.0); }));
    leave_out_unreached(room_, unreached, result_);
  }

  // If the run is stopped before the receivers have a result, the result of the tiles is kept.
  void measure_receivers_after_tiles() {
    if (planned_.tiles && count_votes(control_.communicator, control_.stop.stop_requested()) > 0) {
      result_.walk.stopped_by = StopReason::interrupt;
      return;
    }
    StopWatch watch(time_for(earlier_.receivers), control_.stop, earlier_.receivers, control_.communicator);
    try {
      ReceiverMeasurement measured = measure_receivers(context(watch));
      result_.receiver_results = std::move(measured.receivers);
      result_.areas = std::move(measured.areas);
      result_.parts = std::move(measured.parts);
      result_.channels = std::move(measured.channels);
      result_.receiver_walk = std::move(measured.report);
    } catch (const StoppedTooSoon&) {
      if (!planned_.tiles) throw;
      result_.walk.stopped_by = watch.reason().value_or(StopReason::interrupt);
    }
  }

  // Which surfaces cover others in their plane, and the covered areas.
  void add_covers() {
    const FacesInOnePlane* planes = scene_->tracer->faces_in_one_plane();
    if (planes == nullptr) return;
    result_.covers = planes->covers();
    for (std::size_t m = 0; m < result_.surfaces.size(); ++m) {
      const TileMap& map = result_.tiling.maps[m];
      result_.surfaces[m].covered_m2 = planes->covered_m2(map.surface, map.side == Side::back);
    }
  }

  void warn_of_missing() {
    if (settings_.measured != Measured::receivers && !planned_.tiles) result_.warnings.emplace_back(tiles_left_out);
    if (planned_.receivers && result_.receiver_results.empty())
      result_.warnings.emplace_back(receivers_in_state_ ? receivers_left_out : receivers_not_measured);
  }

  const Room& room_;
  const Settings& settings_;
  const Control& control_;
  RunRecord& record_;
  PlannedWalks planned_;
  EarlierSeconds earlier_;
  bool receivers_in_state_;
  Result result_;
  std::unique_ptr<Scene> scene_;
};

// All ranks must have the same files and options; otherwise histories would count twice. All ranks throw if one
// differs.
void check_ranks_agree(Communicator* communicator, const StateData& data) {
  const auto check = [communicator](const Fingerprint& mine, const std::string& what) {
    Fingerprint of_rank_0 = mine;
    broadcast(communicator, of_rank_0);
    const std::uint64_t others = count_votes(communicator, of_rank_0 != mine);
    if (others > 0)
      throw InputError(std::to_string(others) + " of " + std::to_string(size_of(communicator)) + " processes have " +
                       what);
  };
  check(data.room,
        "another room than rank 0 (allowed: the same file for all). Put the room on a file system shared by all "
        "machines.");
  check(fingerprint(data),
        "other settings, another state or another version of lichtmc than rank 0 (allowed: the same for all). Use the "
        "same options and the same program for all, and put state.h5 on a file system shared by all machines.");
}

void check_areas_are_laid(const Room& room) {
  if (room.area_requests.empty()) return;
  throw InputError("The calculation area " + in_quotes(room.area_requests.front().properties.name) + " in " +
                   room.source + " has no points (allowed: areas that lay_areas() has given points). Call lay_areas() "
                   "after reading the room.");
}

// The common part of a new run and of a continued one.
Result simulate_from(const Room& room, const Settings& settings, const Control& control, StateData data,
                     bool only_read) {
  try {
    check_settings(settings);
    check_room(room);
    check_areas_are_laid(room);
    check_settings_for(room, settings);
    if (!(control.checkpoint_seconds >= 0.0)) {
      throw InputError("The time between checkpoints is " + to_text(control.checkpoint_seconds) +
                       " s (allowed: 0 or more). Give --checkpoint a time, for example 60s.");
    }
    check_ranks_agree(control.communicator, data);
    RunRecord record(control, std::move(data), only_read);
    return Run(room, settings, control, record).simulate();
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
    throw InputError("The state belongs to another room than " + room.source +
                     " as it is now (allowed: the same surfaces, reflectances, emitters and receivers, also those of a "
                     "table or a grid). Give the unchanged files, or start a new run.");
  }
}

// The data, without a second copy of the tallies if this is the only reference to the state.
StateData data_of(State&& state) {
  StateData data = state.data();
  state = {};
  return data;
}

void refuse_gaps(const std::vector<HistoryRange>& ranges) {
  if (ranges.size() < 2) return;
  throw InputError("The state has gaps: it does not contain histories " + std::to_string(ranges[0].last) + " … " +
                   std::to_string(ranges[1].first - 1) +
                   " (allowed: histories without gaps). Simulate the missing ones with --histories, and merge.");
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
  settings.error_floor_share = rules.error_floor_share;
  settings.error_floor = rules.error_floor;
  settings.target_error = rules.target_error;
  settings.max_seconds = rules.max_seconds;
  settings.threads = rules.threads;
  StateData data = data_of(std::move(state));
  if (data.photons) refuse_gaps(data.photons->ranges);
  if (data.receivers) check_receivers_whole(room, settings, *data.receivers);
  data.settings = settings;
  // The total of all sessions: a later one subtracts their time.
  if (settings.max_seconds) data.settings.max_seconds = seconds_before + *settings.max_seconds;
  return simulate_from(room, settings, control, std::move(data), false);
}

Result result_of(const Room& room, State state, unsigned threads, const Control& control) {
  check_state_for(room, state);
  const StateData& found = state.data();
  if (!found.photons && !found.tile_walks && !found.receivers) {
    throw InputError(
        "The state contains no walk: the run was stopped before an estimator was chosen (allowed: a state with a "
        "walk). Continue it by lichtmc resume.");
  }
  Settings settings = state.settings();
  settings.threads = threads;
  return simulate_from(room, settings, control, data_of(std::move(state)), true);
}

}  // namespace lichtmc
