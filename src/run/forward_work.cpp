#include "run/forward_work.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "walk/choose_policy.hpp"

namespace lichtmc {

ForwardWork::ForwardWork(const RunContext& context, Estimator estimator, Progress::Stage stage,
                         const std::vector<TileDirect>& direct, const TileErrorMeasure& measure)
    : context_(context),
      measure_(measure),
      settings_(context.settings_with(estimator)),
      scores_(context.room, context.tiling, score_law(estimator, context.scene.has_reflectance_maps()), direct),
      workers_(context.scene, settings_, context.control, context.watch, context.threads),
      photons_(context.settings.photons),
      is_pilot_(stage == Progress::Stage::pilot) {
  workers_.set_stage(stage);
}

CheckSchedule ForwardWork::schedule() const {
  constexpr std::uint64_t few_batches = 32;  // an error from 32 batches has a relative error of 13 %
  std::uint64_t first = few_batches * batch_histories;
  // Without a target, checks only show how the error decreases: few checks, and none before tiles are hit.
  const std::uint64_t hits_each_quarter =
      (context_.tiling.tiles.size() / 4 / batch_histories + 1) * std::uint64_t{batch_histories};
  if (!settings_.target_error) first = std::max(first, hits_each_quarter);
  // With a target, each check after 25 % more histories: at most 25 % are simulated beyond it.
  return {std::max(first, pilot_), photons_, batch_histories, settings_.target_error ? std::uint64_t{4} : 1};
}

void ForwardWork::restore(StateData& data) {
  Counted& stored = *data.photons;
  check_totals(stored);
  photons_ = std::max(photons_, stored.size());
  pilot_ = stored.pilot;
  workers_.restore(stored.ranges, std::move(stored.totals));
}

// Rooms with the same fingerprint have the same number of tiles; other programs may have changed the file.
void ForwardWork::check_totals(const Counted& stored) const {
  const Totals& totals = *stored.totals;
  const Tiling& tiling = context_.tiling;
  if (totals.tiles.size() != tiling.tiles.size() || totals.tile_maps.size() != tiling.maps.size()) {
    throw InputError("The state has " + std::to_string(totals.tiles.size()) + " tiles, the room has " +
                     std::to_string(tiling.tiles.size()) +
                     " (allowed: the same number). The state does not belong to this room; start a new run.");
  }
  if (context_.scene.has_reflectance_maps() == totals.absorbed_by.empty()) {
    throw InputError(
        std::string("The state has ") + (totals.absorbed_by.empty() ? "no absorbed power" : "absorbed power") +
        " of each surface (allowed: it exists exactly if the room has textures). The state does not belong "
        "to this room; start a new run.");
  }
  const bool hits_apart = score_law(settings_.estimator, context_.scene.has_reflectance_maps()).hits == Hits::apart;
  if (hits_apart == totals.hits.empty()) {
    throw InputError(std::string("The state counts hits ") + (hits_apart ? "as" : "apart from") +
                     " scores (allowed in this room, with the estimator '" +
                     std::string(to_string(settings_.estimator)) + "': " + (hits_apart ? "apart" : "as scores") +
                     "). The state does not belong to this room; start a new run.");
  }
}

void ForwardWork::begin() {
  if (is_pilot_) pilot_ = workers_.histories();
  workers_.set_stage(Progress::Stage::tiles);
  workers_.begin(context_.record);
}

RunError ForwardWork::run_error() {
  const Totals& totals = workers_.totals();
  return measure_.of(scores_.tiles(totals), scores_.powers_of_no_hit(totals.histories));
}

// Values and errors of the photons' scores, without integrated direct light.
Pilot ForwardWork::pilot() {
  const Totals& totals = workers_.totals();
  Pilot pilot;
  pilot.estimator = settings_.estimator;
  pilot.flights = static_cast<double>(totals.traced.rays);
  if (totals.histories == 0) return pilot;
  for (const TileResult& tile : scores_.tiles(totals)) {
    pilot.values.push_back(tile.irradiance - (std::isnan(tile.direct) ? 0.0 : tile.direct));
    pilot.hits.push_back(static_cast<double>(tile.hits));
    pilot.errors.push_back(tile.hits > 0 ? tile.standard_error : 0.0);
  }
  return pilot;
}

WorkCounts ForwardWork::counts() {
  const Totals& totals = workers_.totals();
  return {totals.histories, totals.impacts, 0, totals.traced};
}

Walked& ForwardWork::write_to(StateData& data) {
  Counted& photons = data.photons ? *data.photons : data.photons.emplace();
  const Counted counted = workers_.state();
  photons.ranges = counted.ranges;
  photons.totals = counted.totals;
  photons.pilot = pilot_;
  return photons;
}

void ForwardWork::release(StateData& data) {
  workers_.after_checkpoint();
  data.photons->totals.reset();
}

void ForwardWork::show(double rms_relative_error, double histories_to_target) {
  workers_.set_error(rms_relative_error, histories_to_target);
}

}  // namespace lichtmc
