#include "run/tiles_forward.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lichtmc/error.hpp"
#include "run/drive.hpp"
#include "run/forward_work.hpp"
#include "run/pilot.hpp"
#include "run/tile_light.hpp"

namespace lichtmc {

namespace {

class ForwardTiles final : public Measurement {
 public:
  ForwardTiles(const RunContext& context, const TileErrorMeasure& measure) : context_(context), measure_(measure) {
    if (context.settings.direct != Direct::analytic) return;
    const bool resumed = stored(context.record.data()) != nullptr;
    direct_cost_ = compute_direct(context, resumed, [&](TraceCount& rays) {
      const TileLight light(context.room, context.tiling, context.scene, context.settings, WalkDirection::forward);
      direct_ = light.of_tiles(context.control, context.threads, context.watch, rays);
    });
  }

  std::string name() const override { return "the tiles"; }
  std::vector<Estimator> candidates() const override { return candidates_for(context_.room, context_.settings); }
  Walked* stored(StateData& data) const override { return data.photons ? &*data.photons : nullptr; }
  std::unique_ptr<Work> make_work(Estimator estimator, Progress::Stage stage) override {
    return std::make_unique<ForwardWork>(context_, estimator, stage, direct_, measure_);
  }
  std::uint64_t pilot_count(Estimator estimator) const override {
    const std::uint64_t photons = context_.settings.photons;
    return std::min(pilot_histories(photons, estimator), photons);
  }
  bool keeps_pilot() const override { return true; }
  Choice judge(std::vector<Pilot>& pilots) override {
    CountedTiles tiles;
    tiles.maps = context_.tiling.maps.size();
    for (const Tile& tile : context_.tiling.tiles) {
      tiles.areas.push_back(tile.area_m2);
      tiles.map.push_back(tile.map);
    }
    std::vector<double> means = likely_values(pilots, tiles);
    make_errors_likely(pilots, means, tiles);
    for (std::size_t t = 0; t < direct_.size(); ++t) means[t] += direct_[t].front + direct_[t].behind;
    for (std::size_t t = 0; t < means.size(); ++t) {
      if (!measure_.counts(t)) means[t] = 0.0;  // left out
    }
    return choose_best(pilots, means, measure_.floor(means), tiles.areas, name());
  }

  const DirectCost& direct_cost() const { return direct_cost_; }

 private:
  const RunContext& context_;
  const TileErrorMeasure& measure_;
  std::vector<TileDirect> direct_;  // of every tile, if it is integrated
  DirectCost direct_cost_;
};

}  // namespace

TileMeasurement measure_tiles_forward(const RunContext& context, const TileErrorMeasure& measure) {
  ForwardTiles tiles(context, measure);
  Driven driven = drive(context, tiles);
  auto& work = static_cast<ForwardWork&>(*driven.work);
  const Totals& totals = work.totals();
  if (totals.histories == 0) {
    throw RuntimeError(
        "The run was stopped before the first photon was simulated: there is no result. Give it more time.");
  }
  TileMeasurement measured;
  measured.report = std::move(driven.report);
  tiles.direct_cost().add_to(measured.report);
  measured.lost_histories = totals.ends.lost_histories;
  measured.balance = work.scores().balance(totals);
  const Estimate incident = work.scores().incident(totals);
  measured.incident = incident.mean;
  measured.incident_standard_error = incident.standard_error;
  measured.tiles = work.scores().tiles(totals);
  measured.surfaces = work.scores().surfaces(totals, measured.tiles);
  finish_report(measured.report, work.run_error());
  return measured;
}

}  // namespace lichtmc
