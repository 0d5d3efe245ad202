// Photons from the emitters with one estimator, as work for the run driver.
#pragma once

#include <vector>

#include "run/context.hpp"
#include "run/error_measure.hpp"
#include "run/scores.hpp"
#include "run/tile_light.hpp"
#include "run/work.hpp"
#include "run/worker_threads.hpp"

namespace lichtmc {

class ForwardWork final : public Work {
 public:
  // direct: of every tile if it was integrated, else empty. The context and the measure must outlive the work.
  ForwardWork(const RunContext& context, Estimator estimator, Progress::Stage stage,
              const std::vector<TileDirect>& direct, const TileErrorMeasure& measure);

  std::uint64_t done() const override { return workers_.histories(); }
  std::uint64_t histories_of(std::uint64_t count) const override { return count; }
  CheckSchedule schedule() const override;
  void restore(StateData& data) override;
  void begin() override;
  void simulate_towards(std::uint64_t count) override { workers_.simulate_towards(count); }
  void complete() override { workers_.simulate_ends(); }
  double error() override { return run_error().relative; }
  Pilot pilot() override;
  WorkCounts counts() override;
  Walked& write_to(StateData& data) override;
  void release(StateData& data) override;
  void show(double rms_relative_error, double histories_to_target) override;

  RunError run_error();
  const Totals& totals() { return workers_.totals(); }
  const Scores& scores() const { return scores_; }

 private:
  void check_totals(const Counted& stored) const;

  const RunContext& context_;
  const TileErrorMeasure& measure_;
  Settings settings_;  // with the estimator of this work
  Scores scores_;
  WorkerThreads workers_;
  std::uint64_t photons_;    // to simulate if no other stop rule comes first
  std::uint64_t pilot_ = 0;  // histories after which the estimator was chosen
  bool is_pilot_;
};

}  // namespace lichtmc
