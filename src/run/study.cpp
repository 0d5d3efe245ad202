#include "lichtmc/study.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "base/message.hpp"
#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/simulate.hpp"
#include "room/reflectance.hpp"
#include "run/advice.hpp"
#include "run/error_measure.hpp"
#include "run/scores.hpp"
#include "walk/choose_policy.hpp"

namespace lichtmc {

namespace {

// Tiles are compared with references of at most this relative standard error.
constexpr double known_to = 0.1;
// A reference has this number of times the histories of any row: its error adds 1/60 to that of the longest.
constexpr std::uint64_t reference_factor = 30;
constexpr std::uint64_t steps_of_ladder = 4;  // each has four times the histories of the one before

struct Reference {
  Result result;
  std::vector<double> irradiances;  // per tile
  std::vector<bool> known;          // per tile
  double floor = 0.0;               // W/m² or lx
  StudyReference facts;
};

double area_weighted_rms(double squares, double area) {
  return area > 0.0 ? std::sqrt(squares / area) : std::numeric_limits<double>::quiet_NaN();
}

// Without an error floor tiles without light are left out.
Reference make_reference(const Settings& settings, Result result) {
  Reference reference;
  const auto reached = [&result](std::size_t t) { return result.unreached.empty() || !result.unreached[t]; };
  double lit = 0.0;
  double power = 0.0;
  for (std::size_t t = 0; t < result.tiles.size(); ++t) {
    const double area_m2 = result.tiling.tiles[t].area_m2;
    reference.irradiances.push_back(result.tiles[t].irradiance);
    if (!reached(t)) continue;
    lit += area_m2;
    power += area_m2 * result.tiles[t].irradiance;
  }
  reference.floor = error_floor(settings, lit > 0.0 ? power / lit : 0.0);
  double area = 0.0;
  double squares = 0.0;
  lit = 0.0;
  for (std::size_t t = 0; t < result.tiles.size(); ++t) {
    const double against = std::max(reference.irradiances[t], reference.floor);
    const double relative = result.tiles[t].standard_error / against;
    const double area_m2 = result.tiling.tiles[t].area_m2;
    const bool counts = reached(t) && against > 0.0;
    reference.known.push_back(counts && relative <= known_to);
    if (counts) lit += area_m2;
    if (!reference.known.back()) continue;
    area += area_m2;
    squares += area_m2 * relative * relative;
  }
  reference.facts = {result.settings.tile_edge_m, result.tiles.size(), result.walk.histories,
                     area_weighted_rms(squares, area), lit > 0.0 ? area / lit : 0.0};
  reference.result = std::move(result);
  return reference;
}

// The errors that a run states, relative to the reference.
double stated_error(const Room& room, const Result& result, const Reference& reference) {
  std::vector<double> no_hit;
  if (result.settings.tile_walk == WalkDirection::forward) {
    const bool mapped = std::any_of(room.surfaces.begin(), room.surfaces.end(), has_varying_reflectance);
    no_hit = Scores(room, result.tiling, score_law(result.walk.estimator, mapped), {})
                 .powers_of_no_hit(result.walk.histories);
  }
  return rms_relative_error(result.tiling, result.tiles,
                            {reference.known, reference.irradiances, reference.floor, no_hit});
}

StudyRow row_of(const Room& room, const Result& result, const Reference& reference) {
  StudyRow row;
  row.direction = result.settings.tile_walk;
  row.estimator = result.walk.estimator;
  row.engine = result.engine;
  row.histories = result.walk.histories;
  row.max_bounces = result.settings.max_bounces;
  row.tile_edge_m = result.settings.tile_edge_m;
  row.direct = direct_is_apart(result) ? Direct::analytic : Direct::sampled;
  row.seconds = result.walk.seconds;
  row.direct_seconds = result.walk.direct_seconds;
  double area = 0.0;
  double squares = 0.0;
  double power = 0.0;
  double excess = 0.0;
  for (std::size_t t = 0; t < result.tiles.size(); ++t) {
    if (!reference.known[t]) continue;
    const double truth = reference.irradiances[t];
    const double deviation = result.tiles[t].irradiance - truth;
    const double area_m2 = result.tiling.tiles[t].area_m2;
    area += area_m2;
    squares += area_m2 * std::pow(deviation / std::max(truth, reference.floor), 2);
    power += area_m2 * truth;
    excess += area_m2 * deviation;
  }
  row.rms_error = area_weighted_rms(squares, area);
  row.standard_error = stated_error(room, result, reference);
  row.bias = excess / power;
  row.figure_of_merit = 1.0 / (row.rms_error * row.rms_error * row.seconds);
  return row;
}

double total_area(const Room& room) {
  double area = 0.0;
  for (const Surface& surface : room.surfaces) area += surface_area(surface);
  return area;
}

// 0.1 m, or the length that gives about 2000 tiles, rounded up to two digits so that users can repeat it.
double usual_edge(const Room& room) {
  constexpr double usual = 0.1;
  constexpr double tiles = 2000.0;
  const double edge = std::max(usual, std::sqrt(total_area(room) / tiles));
  const double digit = std::pow(10.0, std::floor(std::log10(edge)) - 1.0);
  return std::stod(short_number(std::ceil(edge / digit - 1e-9) * digit));
}

class StudyRun {
 public:
  StudyRun(const Room& room, const StudyOptions& options) : room_(&room), options_(&options) {
    edge_ = options.tile_edge_m.value_or(usual_edge(room));
  }

  Study run();

 private:
  // A setting and its fraction of the time.
  struct Plan {
    std::string name;
    Settings settings;
    bool ladder = true;  // with increasing numbers of histories, or only with the largest
    double share = 0.0;
  };

  Settings settings_with(Estimator estimator, Engine engine = Engine::automatic) const;
  std::vector<Plan> plans() const;
  const Reference& reference_for(double edge, double share);
  void measure(const Plan& plan);
  bool measure_once(const Plan& plan, const Reference& reference, std::uint64_t photons, double& seconds_left);
  void begin(const std::string& what);
  double seconds() const;
  void report_progress() const;
  Control control() const;

  const Room* room_;
  const StudyOptions* options_;
  double edge_;
  std::map<double, Reference> references_;  // by tile edge
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::string what_;
  std::size_t begun_ = 0;
  std::uint64_t last_histories_ = 0;  // histories of the ladder's last run
  std::size_t of_ = 0;
  Study study_;
};

Settings StudyRun::settings_with(Estimator estimator, Engine engine) const {
  Settings settings;
  settings.estimator = estimator;
  settings.engine = engine;
  settings.measured = Measured::tiles;
  settings.tile_edge_m = edge_;
  settings.seed = options_->seed;
  settings.threads = options_->threads;
  settings.error_floor_share = options_->error_floor_share;
  settings.error_floor = options_->error_floor;
  return settings;
}

std::string name_of(const Settings& settings) {
  std::string name = std::string(to_string(settings.tile_walk)) + ", " + std::string(to_string(settings.estimator));
  if (settings.max_bounces) name += " cut off after " + to_text(*settings.max_bounces, "flight");
  if (settings.direct == Direct::analytic) name += ", direct light integrated";
  if (settings.engine != Engine::automatic) name += ", " + std::string(to_string(settings.engine));
  return name + ", tiles of " + short_number(settings.tile_edge_m) + " m";
}

std::vector<StudyRun::Plan> StudyRun::plans() const {
  std::vector<Plan> plans;
  const auto add = [&](const Settings& settings, bool ladder, double share) {
    plans.push_back({name_of(settings), settings, ladder, share});
  };
  constexpr Estimator estimators[] = {Estimator::weight, Estimator::collision, Estimator::absorption};
  for (const Estimator estimator : estimators) {
    add(settings_with(estimator), true, 2.0);
    Settings integrated = settings_with(estimator);
    integrated.direct = Direct::analytic;
    add(integrated, true, 2.0);
    Settings backward = settings_with(estimator);
    backward.tile_walk = WalkDirection::backward;
    add(backward, true, 2.0);
  }
  // In cuboids Embree is measured in addition to the closed form.
  const Engine usual = references_.at(edge_).result.engine;
  if (usual == Engine::cuboid) add(settings_with(Estimator::collision, Engine::embree), true, 2.0);
  add(settings_with(Estimator::collision, Engine::embree_fast), true, 2.0);
  for (const std::uint32_t bounces : {2U, 3U, 5U, 7U, 10U, 14U, 20U, 30U, 50U}) {
    Settings cut = settings_with(Estimator::weight);
    cut.max_bounces = bounces;
    add(cut, false, 0.5);
  }
  for (const double factor : {0.5, 2.0}) {
    Settings other = settings_with(Estimator::collision);
    other.tile_edge_m *= factor;
    add(other, false, 0.5);
  }
  double all = 0.0;
  for (const Plan& plan : plans) all += plan.share;
  constexpr double for_rows = 0.55;  // of the time; the remainder is for references
  for (Plan& plan : plans) plan.share *= for_rows / all;
  return plans;
}

double StudyRun::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

void StudyRun::report_progress() const {
  if (options_->progress) options_->progress({what_, begun_ - 1, of_, seconds(), options_->seconds});
}

void StudyRun::begin(const std::string& what) {
  what_ = what;
  ++begun_;
  report_progress();
}

Control StudyRun::control() const {
  Control control;
  control.progress = [this](const Progress&) { report_progress(); };
  control.stop = options_->stop;
  return control;
}

const Reference& StudyRun::reference_for(double edge, double share) {
  if (const auto found = references_.find(edge); found != references_.end()) return found->second;
  begin("reference, tiles of " + short_number(edge) + " m");
  Settings settings = settings_with(Estimator::collision);
  settings.tile_edge_m = edge;
  settings.seed = options_->seed ^ 0x9E3779B97F4A7C15U;
  settings.photons = no_photon_limit;
  settings.max_seconds = share * options_->seconds;
  Reference reference = make_reference(settings, simulate(*room_, settings, control()));
  if (reference.result.walk.histories < 2 * reference_factor * batch_histories) {
    throw InputError("The time of " + short_number(options_->seconds) + " s is too short to study " + room_->source +
                     ": its reference has " + std::to_string(reference.result.walk.histories) + " photons (allowed: " +
                     std::to_string(2 * reference_factor * batch_histories) + " or more). Give --max-time more.");
  }
  study_.references.push_back(reference.facts);
  study_.threads = reference.result.threads;
  return references_.emplace(edge, std::move(reference)).first->second;
}

// Returns whether the run ended in time. A run that the time limit made shorter than the previous one is not recorded.
bool StudyRun::measure_once(const Plan& plan, const Reference& reference, std::uint64_t photons, double& seconds_left) {
  Settings settings = plan.settings;
  settings.photons = photons;
  settings.max_seconds = seconds_left;
  const auto began = std::chrono::steady_clock::now();
  const Result result = simulate(*room_, settings, control());
  seconds_left -= std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const bool longer = !plan.ladder || result.walk.histories > last_histories_;
  last_histories_ = result.walk.histories;
  if (longer) study_.rows.push_back(row_of(*room_, result, reference));
  return result.walk.stopped_by == StopReason::photons && seconds_left > 0.0;
}

void StudyRun::measure(const Plan& plan) {
  constexpr double for_other_sizes = 0.05;
  double seconds_left = plan.share * options_->seconds;
  last_histories_ = 0;
  try {
    const Reference& reference = reference_for(plan.settings.tile_edge_m, for_other_sizes);
    begin(plan.name);
    const std::uint64_t batches = reference.result.walk.histories / reference_factor / batch_histories;
    for (std::uint64_t step = plan.ladder ? steps_of_ladder : 1; step-- > 0;) {
      const std::uint64_t on_step = batches >> (2 * step);
      if (on_step < 2) continue;  // one batch alone gives no error
      if (!measure_once(plan, reference, on_step * batch_histories, seconds_left)) break;
    }
  } catch (const InputError& error) {
    study_.left_out.push_back(plan.name + ": " + error.what());
  } catch (const RuntimeError& error) {
    study_.left_out.push_back(plan.name + ": not completed in its part of the time, " +
                              short_number(plan.share * options_->seconds) + " s. Give --max-time more.");
  }
}

Study StudyRun::run() {
  study_.room = room_->source;
  constexpr double for_reference = 0.35;
  reference_for(edge_, for_reference);
  const std::vector<Plan> all = plans();
  of_ = all.size() + 3;  // plus the references
  for (const Plan& plan : all) {
    if (options_->stop.stop_requested()) break;
    measure(plan);
  }
  study_.advice = advice_from(study_.rows, edge_, room_->source);
  return std::move(study_);
}

}  // namespace

Study study(const Room& room, const StudyOptions& options) {
  constexpr double shortest = 5.0;
  if (!(options.seconds >= shortest) || !std::isfinite(options.seconds)) {
    throw InputError("The time for the study is " + to_text(options.seconds) +
                     " s (allowed: 5 s or more). Give --max-time a time, for example 10min.");
  }
  return StudyRun(room, options).run();
}

}  // namespace lichtmc
