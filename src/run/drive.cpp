#include "run/drive.hpp"

#include <string>
#include <utility>
#include <vector>

#include "run/collectives.hpp"
#include "run/forecast.hpp"
#include "run/pilot.hpp"

namespace lichtmc {

namespace {

// The estimator used. If a stop came before all were tried, an uninterrupted run might have chosen another one: the
// choice is not recorded.
struct EstimatorChoice {
  std::unique_ptr<Work> work;
  Estimator estimator = Estimator::collision;
  std::string reason;
  bool complete = true;
};

class Driver {
 public:
  Driver(const RunContext& context, Measurement& measurement) : context_(context), measurement_(measurement) {}

  Driven run() {
    EstimatorChoice chosen = take_work();
    work_ = std::move(chosen.work);
    report_.estimator = chosen.estimator;
    report_.choice = std::move(chosen.reason);
    records_ = chosen.complete;
    report_.stopped_by = context_.record.only_read() ? complete() : simulate();
    report_.seconds = context_.watch.seconds();
    if (records_ && work_->done() > 0) write_to(context_.record.data());
    const WorkCounts counts = work_->counts();
    report_.histories = counts.histories;
    report_.impacts = counts.impacts;
    report_.connections = counts.connections;
    report_.rays = counts.traced.rays;
    report_.retraced = counts.traced.retraced;
    report_.shadow_rays = counts.traced.shadow_rays;
    report_.undecided = counts.traced.undecided;
    return {std::move(work_), std::move(report_)};
  }

 private:
  // The walk of the record, or a new one with the requested or chosen estimator.
  EstimatorChoice take_work() {
    StateData& data = context_.record.data();
    if (const Walked* stored = measurement_.stored(data)) {
      EstimatorChoice before{measurement_.make_work(stored->estimator, Progress::Stage::tiles), stored->estimator,
                             stored->choice, true};
      report_.convergence = stored->convergence;
      before.work->restore(data);
      return before;
    }
    const std::vector<Estimator> candidates = measurement_.candidates();
    if (candidates.size() > 1) return choose(candidates);
    return {measurement_.make_work(candidates.front(), Progress::Stage::tiles), candidates.front(),
            measurement_.reason(), true};
  }

  // A short pilot of each estimator; the best is used. If a stop comes first, the first estimator is used.
  EstimatorChoice choose(const std::vector<Estimator>& candidates) {
    std::vector<std::unique_ptr<Work>> works;
    std::vector<Pilot> pilots;
    for (const Estimator estimator : candidates) {
      works.push_back(measurement_.make_work(estimator, Progress::Stage::pilot));
      simulate_up_to(*works.back(), measurement_.pilot_count(estimator));
      pilots.push_back(works.back()->pilot());
      if (context_.watch.reason()) {
        const std::string name(to_string(candidates.front()));
        return {std::move(works.front()), candidates.front(),
                "The estimator '" + name + "' was used for " + measurement_.name() +
                    ": the run ended before all estimators were tried. Resuming it restarts these walks.",
                false};
      }
    }
    Choice choice = measurement_.judge(pilots);
    broadcast(context_.control.communicator, choice.best);
    const Estimator estimator = candidates[choice.best];
    std::unique_ptr<Work> best = measurement_.keeps_pilot() ? std::move(works[choice.best])
                                                            : measurement_.make_work(estimator, Progress::Stage::tiles);
    return {std::move(best), estimator, choice.reason, true};
  }

  StopReason complete() {
    work_->complete();
    return StopReason::photons;
  }

  // The stop rules: photons, target error, time, interrupt, whichever comes first.
  StopReason simulate() {
    const std::optional<double>& target = context_.settings.target_error;
    const std::uint64_t done_before = work_->done();  // of an earlier session, or of the pilot
    work_->begin();
    CheckSchedule schedule = work_->schedule();
    schedule.skip(done_before);
    Forecast forecast;
    for (;; schedule.advance()) {
      simulate_up_to(*work_, schedule.next(), records_);
      if (const auto reason = context_.watch.reason()) return *reason;
      if (schedule.is_last() && !target) return StopReason::photons;
      const double error = work_->error();
      const std::uint64_t histories = work_->histories_of(schedule.next());
      report_.convergence.push_back({histories, context_.watch.seconds(), error});
      if (target) {
        forecast.add(histories, error);
        report_.histories_to_target = forecast.histories_to(*target);
        bool reached = error <= *target;
        broadcast(context_.control.communicator, reached);
        if (reached) return StopReason::target_error;
      }
      work_->show(error, report_.histories_to_target);
      if (schedule.is_last()) return StopReason::photons;
    }
  }

  // The clock of rank 0 determines when a checkpoint is due.
  void simulate_up_to(Work& work, std::uint64_t count, bool checkpoints = false) {
    while (work.done() < count && !context_.watch.reason()) {
      work.simulate_towards(count);
      if (context_.watch.reason() || !checkpoints) continue;
      bool due = context_.record.due();
      broadcast(context_.control.communicator, due);
      if (!due) continue;
      context_.record.checkpoint([this](StateData& data) { write_to(data); });
      work.release(context_.record.data());
    }
  }

  void write_to(StateData& data) {
    Walked& walked = work_->write_to(data);
    walked.estimator = report_.estimator;
    walked.choice = report_.choice;
    walked.convergence = report_.convergence;
    walked.seconds = context_.watch.seconds();
  }

  const RunContext& context_;
  Measurement& measurement_;
  std::unique_ptr<Work> work_;
  WalkReport report_;
  bool records_ = true;
};

}  // namespace

Driven drive(const RunContext& context, Measurement& measurement) {
  return Driver(context, measurement).run();
}

void finish_report(WalkReport& report, const RunError& error) {
  report.rms_relative_error = error.relative;
  report.rms_relative_error_without_floor = error.without_floor;
  report.error_floor = error.floor;
  report.figure_of_merit = 1.0 / (error.relative * error.relative * report.seconds);
  if (report.convergence.empty() || report.convergence.back().histories != report.histories)
    report.convergence.push_back({report.histories, report.seconds, error.relative});
}

}  // namespace lichtmc
