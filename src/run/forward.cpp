#include "run/forward.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "run/collectives.hpp"
#include "run/forecast.hpp"
#include "run/pilot.hpp"
#include "run/scores.hpp"
#include "run/surface_results.hpp"
#include "run/tile_light.hpp"
#include "run/worker_threads.hpp"

namespace lichtmc {

namespace {

// One estimator at work. Histories are numbered the same with all of them: those of a pilot are the first of the run.
struct Candidate {
  Settings settings;
  Scores scores;
  std::unique_ptr<WorkerThreads> workers;
};

std::vector<Candidate> make_candidates(const Room& room, const Scene& scene, const Settings& settings,
                                       const Control& control, StopWatch& watch, const Result& result,
                                       const std::vector<TileDirect>& direct) {
  std::vector<Candidate> candidates;
  for (const Estimator estimator : candidates_for(room, settings)) {
    Settings own = settings;
    own.estimator = estimator;
    candidates.push_back({own, Scores(room, result.tiling, score_law(estimator, scene.has_reflectance_maps()), direct),
                          std::make_unique<WorkerThreads>(scene, own, control, watch, result.threads)});
  }
  return candidates;
}

double known_of(const TileResult& tile) {
  return std::isnan(tile.direct) ? 0.0 : tile.direct;
}

Pilot outcome(const Candidate& candidate) {
  const Totals& totals = candidate.workers->totals();
  Pilot pilot;
  pilot.estimator = candidate.settings.estimator;
  pilot.flights = static_cast<double>(totals.traced.rays);
  if (totals.histories == 0) return pilot;
  for (const TileResult& tile : candidate.scores.tiles(totals)) {
    pilot.values.push_back(tile.irradiance - known_of(tile));
    pilot.hits.push_back(static_cast<double>(tile.hits));
    pilot.errors.push_back(tile.hits > 0 ? tile.standard_error : 0.0);
  }
  return pilot;
}

Choice choose_for_tiles(std::vector<Pilot>& pilots, const Candidate& candidate, const Tiling& tiling) {
  CountedTiles tiles;
  tiles.maps = tiling.maps.size();
  for (const Tile& tile : tiling.tiles) {
    tiles.areas.push_back(tile.area_m2);
    tiles.map.push_back(tile.map);
  }
  std::vector<double> means = likely_values(pilots, tiles);
  make_errors_likely(pilots, means, tiles);
  const std::vector<TileResult> found = candidate.scores.tiles(candidate.workers->totals());
  for (std::size_t t = 0; t < means.size(); ++t) means[t] += known_of(found[t]);
  return choose_best(pilots, means, tiles.areas, "the tiles");
}

// Leaves the contender that does best; it goes on from where its pilot has ended. False where a stop came before that
// was known: another session must not go on with what an uninterrupted run might not have chosen.
bool keep_best(std::vector<Candidate>& candidates, std::uint64_t photons, const StopWatch& watch,
               Communicator* communicator, RunRecord& record, Result& result) {
  Counted& log = record.data().photons.emplace();
  bool chosen = true;
  if (candidates.size() > 1) {
    std::vector<Pilot> pilots;
    for (Candidate& candidate : candidates) {
      candidate.workers->set_stage(Progress::Stage::pilot);
      candidate.workers->simulate_up_to(std::min(pilot_histories(photons, candidate.settings.estimator), photons));
      pilots.push_back(outcome(candidate));
      if (watch.reason()) break;
    }
    Choice choice;
    chosen = !watch.reason();
    if (!chosen) {
      choice.reason = "The estimator '" + std::string(to_string(pilots.front().estimator)) +
                      "' was taken for the tiles: the run ended before all were tried. To go on from there begins the "
                      "run anew.";
    } else {
      choice = choose_for_tiles(pilots, candidates.front(), result.tiling);
    }
    broadcast(communicator, choice.best);
    log.choice = choice.reason;
    std::swap(candidates.front(), candidates[choice.best]);
    candidates.erase(candidates.begin() + 1, candidates.end());
    candidates.front().workers->set_stage(Progress::Stage::tiles);
    log.pilot = candidates.front().workers->histories();
  }
  log.estimator = candidates.front().settings.estimator;
  return chosen;
}

// Numbers of histories after which errors are looked at. They depend on nothing but the settings, the tiles and the
// pilot, so that a run ends at the same history for any number of threads, members and sessions.
class CheckSchedule {
 public:
  CheckSchedule(const Settings& settings, std::size_t tiles, std::uint64_t pilot)
      : settings_(&settings), look_(std::min(std::max(first(tiles), pilot), settings.photons)) {}

  std::uint64_t now() const { return look_; }
  // A quarter more each time, whole batches: at most a quarter is simulated in vain.
  void advance() {
    const std::uint64_t part = settings_->target_error ? 4 : 1;
    const std::uint64_t more = std::max<std::uint64_t>(1, look_ / batch_histories / part) * batch_histories;
    look_ = settings_->photons - look_ > more ? look_ + more : settings_->photons;
  }
  bool is_last() const { return look_ == settings_->photons; }

 private:
  std::uint64_t first(std::size_t tiles) const {
    constexpr std::uint64_t first_look =
        32 * std::uint64_t{batch_histories};  // an error from 32 batches is known to 13 %
    // Where no target asks for them, looks only show how the error falls: none before tiles are hit, and few.
    const std::uint64_t hits_each_quarter = (tiles / 4 / batch_histories + 1) * batch_histories;
    return settings_->target_error ? first_look : std::max(first_look, hits_each_quarter);
  }

  const Settings* settings_;
  std::uint64_t look_;
};

// Simulates until the first stop rule is met.
StopReason run_until_stopped(const Candidate& candidate, const StopWatch& watch, Communicator* communicator,
                             Counted& log, Result& result) {
  const Settings& settings = candidate.settings;
  WorkerThreads& workers = *candidate.workers;
  CheckSchedule looks(settings, result.tiling.tiles.size(), log.pilot);
  // What an earlier session has simulated it has looked at.
  while (looks.now() < workers.histories() && !looks.is_last()) looks.advance();
  Forecast forecast;
  for (;; looks.advance()) {
    workers.simulate_up_to(looks.now());
    if (watch.reason()) return *watch.reason();
    if (looks.is_last() && !settings.target_error) return StopReason::photons;
    const double error = rms_relative_error(result.tiling, candidate.scores.tiles(workers.totals()));
    log.convergence.push_back({looks.now(), watch.seconds(), error});
    if (settings.target_error) {
      forecast.look(looks.now(), error);
      result.histories_to_target = forecast.histories_to(*settings.target_error);
      bool reached = error <= *settings.target_error;
      broadcast(communicator, reached);
      if (reached) return StopReason::target_error;
    }
    workers.set_error(error, result.histories_to_target);
    if (looks.is_last()) return StopReason::photons;
  }
}

void fill_in(Result& result, const Totals& totals, const Scores& scores) {
  result.histories = totals.histories;
  result.impacts = totals.impacts;
  result.rays += totals.traced.rays;  // beside those that asked for shadows
  result.retraced = totals.traced.retraced;
  result.lost_histories = totals.ends.lost_histories;
  result.balance = scores.balance(totals);
  scores.incident(totals, result.incident, result.incident_standard_error);
  result.tiles = scores.tiles(totals);
  result.surfaces = scores.surfaces(totals, result.tiles);
}

// Rooms that have the same fingerprint have as many tiles; other programs may have changed the file.
void check_totals(const Counted& log, const Tiling& tiling, const Scene& scene) {
  const Totals& totals = *log.totals;
  if (totals.tiles.size() != tiling.tiles.size() || totals.tile_maps.size() != tiling.maps.size()) {
    throw InputError("The state has " + std::to_string(totals.tiles.size()) + " tiles, the room has " +
                     std::to_string(tiling.tiles.size()) +
                     " (allowed: as many). The state is not one of this room; run anew.");
  }
  const bool hits_apart = score_law(log.estimator, scene.has_reflectance_maps()).hits == Hits::apart;
  if (hits_apart == totals.hits.empty()) {
    throw InputError(std::string("The state counts hits ") + (hits_apart ? "as" : "apart from") +
                     " scores (allowed in this room, with the estimator '" + std::string(to_string(log.estimator)) +
                     "': " + (hits_apart ? "apart" : "as scores") + "). The state is not one of this room; run anew.");
  }
}

}  // namespace

void walk_from_emitters(const Room& room, const Scene& scene, const Settings& settings, const Control& control,
                        StopWatch& watch, RunRecord& record, Result& result) {
  std::optional<Counted>& log = record.data().photons;
  std::vector<TileDirect> direct;
  if (settings.direct == Direct::analytic) {
    // Going on takes it anew, however little time there is left: without it the photons would be lost.
    if (log) watch.suspend_limit();
    TraceCount count;
    const double began = watch.seconds();
    direct = TileLight(room, result.tiling, scene, settings, WalkDirection::forward)
                 .of_tiles(control, result.threads, watch, count);
    result.rays = count.rays;
    result.shadow_rays = count.shadow_rays;
    result.direct_seconds = watch.seconds() - began;
    if (log) watch.restart_limit();
  }
  Settings own = settings;
  if (log) {
    own.estimator = log->estimator;
    own.photons = std::max(own.photons, log->size());
  }
  std::vector<Candidate> candidates = make_candidates(room, scene, own, control, watch, result, direct);
  bool chosen_well = true;
  if (log) {
    check_totals(*log, result.tiling, scene);
    candidates.front().workers->go_on_from(log->ranges, std::move(log->totals));
  } else {
    chosen_well = keep_best(candidates, settings.photons, watch, control.communicator, record, result);
  }
  const Candidate& chosen = candidates.front();
  WorkerThreads& workers = *chosen.workers;
  workers.keep(record);
  if (record.only_read()) {
    workers.simulate_ends();
    result.stopped_by = StopReason::photons;
  } else {
    result.stopped_by = run_until_stopped(chosen, watch, control.communicator, *log, result);
  }
  const Totals& totals = workers.totals();
  if (totals.histories == 0) {
    throw RuntimeError(
        "The run was stopped before the first photon was simulated: there is no result. Give it more time.");
  }
  result.seconds = watch.seconds();
  result.estimator = log->estimator;
  if (!log->choice.empty()) result.choices.push_back(log->choice);
  fill_in(result, totals, chosen.scores);
  const Counted counted = workers.state();
  log->ranges = counted.ranges;
  log->totals = counted.totals;
  log->seconds = result.seconds;
  result.convergence = log->convergence;
  if (!chosen_well) log.reset();
}

}  // namespace lichtmc
