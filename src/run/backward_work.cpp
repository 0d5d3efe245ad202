#include "run/backward_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lichtmc/error.hpp"
#include "run/collectives.hpp"
#include "run/drive.hpp"
#include "run/rounds.hpp"

namespace lichtmc {

namespace {

// Histories that a thread simulates at a time: some waves, so that the cost of the lock at their end is negligible.
constexpr std::uint64_t histories_at_a_time = 8192;

// The same where photons contribute to many origins, counted for each. A wave of them should not be too small.
constexpr std::uint64_t histories_of_block = 65536;

// A piece of work with impulse responses is larger by this factor: at its end their bins are added to those of all.
constexpr std::uint64_t pieces_with_channels = 16;

[[noreturn]] void refuse_too_short() {
  throw StoppedTooSoon(
      "The run was stopped before its direct light and the first backward walks were completed: there is no result, "
      "and the files in its folder are unchanged. Give it more time.");
}

}  // namespace

BackwardWork::BackwardWork(const RunContext& context, const BackwardTask& task, Estimator estimator,
                           Progress::Stage stage, std::shared_ptr<const std::vector<DirectIrradiance>> direct)
    : context_(context),
      task_(task),
      settings_(context.settings_with(estimator)),
      together_(task.plan.histories(task.origins)),
      range_(rounds_of(settings_, together_)),
      reporter_(context.control, context.watch, stage == Progress::Stage::pilot ? stage : task.stage,
                histories_of(range_.last - range_.first)) {
  found_.direct = std::move(direct);
  found_.sums = std::make_shared<std::vector<BackwardSums>>(task.origins);
  if (task.channels != nullptr && stage != Progress::Stage::pilot)
    found_.channels = std::make_shared<ChannelSums>(*task.channels, task.origins);
  if (task.parts > 0 && stage != Progress::Stage::pilot)
    found_.parts = std::make_shared<PartSums>(task.origins, task.parts);
  found_.plan = task.plan;
  found_.group = task.group;
  found_.unit = task.unit;
}

std::uint64_t BackwardWork::histories_of(std::uint64_t rounds) const {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  return rounds > most / together_ ? most : rounds * together_;
}

CheckSchedule BackwardWork::schedule() const {
  // An error from 256 walks has a relative error of 4 %.
  const std::uint64_t first = std::max<std::uint64_t>(2, 256 / task_.plan.histories(1));
  return {first, range_.last - range_.first, 1, 4};
}

std::uint64_t BackwardWork::pilot_rounds(const RunContext& context, const BackwardTask& task, Estimator estimator) {
  // Some walks from every origin: without them there is nothing to compare.
  constexpr std::uint64_t fewest_rounds = 8;
  const std::uint64_t together = task.plan.histories(task.origins);
  Settings settings = context.settings;
  settings.photons = std::max(pilot_histories(settings.photons, estimator), fewest_rounds * together);
  const HistoryRange rounds = rounds_of(settings, together);
  return rounds.last - rounds.first;
}

void BackwardWork::restore(StateData& data) {
  BackwardState& before = *(data.*task_.slot);
  if (before.sums->size() != task_.origins || before.plan != task_.plan) {
    throw InputError("The state has walks from " + std::to_string(before.sums->size()) + " origins, the room has " +
                     std::to_string(task_.origins) +
                     " (allowed: the same number). The state does not belong to this room; start a new run.");
  }
  if (!context_.record.only_read()) check_whole(settings_, together_, before, task_.name);
  if (task_.channels != nullptr) {
    if (data.channels == nullptr || !data.channels->has_size_of(*found_.channels)) {
      throw InputError(
          "The state's impulse responses have other sizes than those of the room (allowed: the same numbers of "
          "receivers, "
          "emitters, orders, bins and frequencies). The state does not belong to this room; start a new run.");
    }
    found_.channels = own(std::move(data.channels));
  }
  if (task_.parts > 0) {
    if (data.parts == nullptr || !data.parts->has_size_of(*found_.parts)) {
      throw InputError(
          "The state has other parts of emitters than the room, or none (allowed: the same receivers and emitters; "
          "parts "
          "are kept for calculation areas and with --per-emitter). The state does not belong to this room and these "
          "options; start a new run.");
    }
    found_.parts = own(std::move(data.parts));
  }
  found_.sums = own(std::move(before.sums));
  count_ = before.count;
  found_.rounds = before.size();
  before_ = before.ranges;
  range_.first = before_.back().first;
  range_.last = std::max(range_.last, before_.back().last);
  before_.pop_back();
  rounds_before_ = count_of(before_);
  found_.ranges = ranges();
  reporter_.set_before(histories_of(found_.rounds));
}

Walked& BackwardWork::write_to(StateData& data) {
  std::optional<BackwardState>& slot = data.*task_.slot;
  BackwardState& state = slot ? *slot : slot.emplace();
  state.plan = task_.plan;
  state.ranges = ranges();
  state.count = count_;
  state.sums = found_.sums;
  if (found_.channels) data.channels = found_.channels;
  if (found_.parts) data.parts = found_.parts;
  return state;
}

Pilot BackwardWork::pilot() {
  Pilot pilot;
  pilot.estimator = settings_.estimator;
  pilot.flights = static_cast<double>(count_.traced.rays);
  for (std::size_t k = 0; k < found_.sums->size(); ++k) {
    pilot.values.push_back((*found_.direct)[k].value + found_.indirect(k));
    pilot.errors.push_back(found_.indirect_error(k));
  }
  return pilot;
}

// One step of some tenths of a second, after which the sums are complete; longer with impulse responses, whose sums are
// many.
void BackwardWork::simulate_towards(std::uint64_t rounds) {
  const double step_seconds = found_.channels ? 2.0 : 0.5;
  const double began = context_.watch.seconds();
  const std::uint64_t step = std::min(step_, rounds - found_.rounds);
  if (!simulate_step(found_.rounds + step)) return;
  const double took = context_.watch.seconds() - began;
  if (step == step_ || took > step_seconds) {
    const double factor = std::min(4.0, step_seconds / std::max(took, 1e-6));
    step_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(static_cast<double>(step) * factor));
  }
  broadcast(context_.control.communicator, step_);
}

// A part of a step that a stop interrupts is discarded: every origin has the same rounds. Returns whether the step was
// completed. Ranks agree after each step.
bool BackwardWork::simulate_step(std::uint64_t rounds) {
  std::vector<BackwardSums> sums(task_.origins);
  if (found_.channels && step_channels_.bins.empty()) step_channels_ = ChannelSums(*task_.channels, task_.origins);
  if (found_.parts && step_parts_.of_groups.empty()) step_parts_ = PartSums(task_.origins, task_.parts);
  BackwardCount count;
  next_ = 0;
  context_.watch.run_on_threads(context_.threads, [&](unsigned) {
    take_rounds(found_.rounds, rounds, {sums, step_channels_, step_parts_, count});
  });
  context_.watch.agree();
  if (context_.watch.reason()) return false;
  reduce(context_.control.communicator, sums);
  reduce(context_.control.communicator, count);
  found_.sums = own<std::vector<BackwardSums>>(std::move(found_.sums));
  add_fields(*found_.sums, sums);
  if (found_.channels) {
    reduce(context_.control.communicator, step_channels_);
    found_.channels = own<ChannelSums>(std::move(found_.channels));
    move_sums(*found_.channels, step_channels_);
  }
  if (found_.parts) {
    reduce(context_.control.communicator, step_parts_);
    found_.parts = own<PartSums>(std::move(found_.parts));
    step_parts_.move_to(*found_.parts, 0, task_.parts);
  }
  add_fields(count_, count);
  found_.rounds = rounds;
  found_.ranges = ranges();
  return true;
}

BackwardWork::Pieces BackwardWork::pieces_of(std::uint64_t rounds) const {
  const std::uint64_t of_origin = task_.plan.histories(1);
  Pieces pieces;
  if (task_.block > 0) {
    // Blocks of origins that share the photons from the emitters, each with a part of the rounds.
    pieces.origins = std::min<std::uint64_t>(task_.block, task_.origins);
    const std::uint64_t histories = histories_of_block * (task_.channels != nullptr ? pieces_with_channels : 1);
    const std::uint64_t at_a_time = std::max<std::uint64_t>(1, histories / (of_origin * pieces.origins));
    pieces.parts = (rounds + at_a_time - 1) / at_a_time;
  } else {
    // Either many origins with few rounds, or one origin with a part of its rounds.
    const std::uint64_t at_a_time = histories_at_a_time / of_origin;
    pieces.origins = std::max<std::uint64_t>(1, at_a_time / rounds);
    pieces.parts = pieces.origins > 1 ? 1 : (rounds + at_a_time - 1) / at_a_time;
  }
  pieces.count = (task_.origins + pieces.origins - 1) / pieces.origins * pieces.parts;
  return pieces;
}

void BackwardWork::take_rounds(std::uint64_t first, std::uint64_t last, const Step& step) {
  const std::unique_ptr<BackwardWalk> walk = task_.make_walk(settings_, task_.plan);
  const std::uint64_t rounds = last - first;
  const auto [together, parts, pieces] = pieces_of(rounds);
  const Part mine = part_of(context_.control.communicator, pieces);  // of this rank
  const std::uint64_t skipped = range_.first - rounds_before_;       // rounds are numbered from the first of the run
  std::vector<BackwardSums> sums;
  while (!context_.watch.would_stop()) {
    const std::uint64_t piece = mine.first + next_.fetch_add(1);
    if (piece >= mine.last) break;
    WalkBlock work;
    work.first = piece / parts * together;
    work.last = std::min<std::uint64_t>(task_.origins, work.first + together);
    work.first_sample = (skipped + first + rounds * (piece % parts) / parts) * task_.group;
    work.last_sample = (skipped + first + rounds * (piece % parts + 1) / parts) * task_.group;
    sums.assign(work.last - work.first, {});
    BackwardCount count;
    walk->simulate(work, sums, count, [this] {
      reporter_.add(0, 0);
      return context_.watch.would_stop();
    });
    {
      const std::lock_guard lock(mutex_);
      for (std::size_t k = 0; k < sums.size(); ++k) add_fields(step.sums[work.first + k], sums[k]);
      if (found_.channels) walk->hand_over(step.channels, count);
      if (found_.parts) walk->hand_over(step.parts);
      add_fields(step.count, count);
    }
    const std::uint64_t histories =
        (work.last_sample - work.first_sample) / task_.group * task_.plan.histories(work.last - work.first);
    const unsigned ranks = size_of(context_.control.communicator);  // the other ranks have done about the same
    reporter_.add(histories * ranks, count.traced.rays * ranks);
  }
}

std::vector<DirectIrradiance> direct_light_of(std::size_t origins,
                                              const std::function<DirectIrradiance(std::size_t, TraceCount&)>& direct,
                                              const Control& control, unsigned threads, StopWatch& watch,
                                              TraceCount& traced) {
  constexpr std::size_t at_a_time = 64;
  std::vector<DirectIrradiance> found(origins);
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  ProgressReporter reporter(control, watch, Progress::Stage::direct_light, origins);
  const Part mine = part_of(control.communicator, origins);
  next = mine.first;
  TraceCount traced_here;
  watch.run_on_threads(threads, [&](unsigned) {
    TraceCount count;
    while (!watch.would_stop()) {
      const std::size_t first = next.fetch_add(at_a_time);
      if (first >= mine.last) break;
      const std::size_t last = std::min<std::size_t>(mine.last, first + at_a_time);
      for (std::size_t k = first; k < last; ++k) found[k] = direct(k, count);
      reporter.add(last - first, 0);
    }
    const std::lock_guard lock(mutex);
    traced_here.add(count);
  });
  watch.agree();
  if (watch.reason()) refuse_too_short();
  combine(control.communicator, found);
  reduce(control.communicator, traced_here);
  traced.add(traced_here);
  return found;
}

double OriginEstimates::indirect(std::size_t k) const {
  return static_cast<double>((*sums)[k].sum) / static_cast<double>(rounds * group) * unit;
}

double OriginEstimates::indirect_error(std::size_t k) const {
  if (rounds < 2) return std::numeric_limits<double>::quiet_NaN();
  return (*sums)[k].error_of_mean(rounds) / group * unit;
}

namespace {

class BackwardMeasurement final : public Measurement {
 public:
  BackwardMeasurement(const RunContext& context, BackwardTask& task) : context_(context), task_(task) {
    const bool resumed = stored(context.record.data()) != nullptr;
    direct_cost_ = compute_direct(context, resumed, [&](TraceCount& rays) {
      direct_ = std::make_shared<const std::vector<DirectIrradiance>>(
          direct_light_of(task.origins, task.direct, context.control, context.threads, context.watch, rays));
    });
    if (resumed) {
      task_.plan = (context.record.data().*task.slot)->plan;
      return;
    }
    if (task_.choose) task_.choose(task_, *direct_);
    check_rounds(context.settings, task_.plan.histories(task_.origins), task_.name);
  }

  std::string name() const override { return task_.name; }
  std::vector<Estimator> candidates() const override { return task_.candidates; }
  std::string reason() const override { return task_.reason; }
  Walked* stored(StateData& data) const override { return data.*task_.slot ? &*(data.*task_.slot) : nullptr; }
  std::unique_ptr<Work> make_work(Estimator estimator, Progress::Stage stage) override {
    return std::make_unique<BackwardWork>(context_, task_, estimator, stage, direct_);
  }
  std::uint64_t pilot_count(Estimator estimator) const override {
    return BackwardWork::pilot_rounds(context_, task_, estimator);
  }
  bool keeps_pilot() const override { return false; }
  Choice judge(std::vector<Pilot>& pilots) override {
    const std::vector<double> means = pooled_values(pilots);
    return choose_best(pilots, means, task_.floor(means), task_.weights, task_.name);
  }

  const DirectCost& direct_cost() const { return direct_cost_; }

 private:
  const RunContext& context_;
  BackwardTask& task_;
  std::shared_ptr<const std::vector<DirectIrradiance>> direct_;
  DirectCost direct_cost_;
};

}  // namespace

BackwardOutcome walk_backward(const RunContext& context, BackwardTask task) {
  BackwardMeasurement measurement(context, task);
  Driven driven = drive(context, measurement);
  const auto& work = static_cast<const BackwardWork&>(*driven.work);
  const OriginEstimates& found = work.estimates();
  if (found.rounds == 0) refuse_too_short();
  BackwardOutcome outcome{found, work.ranges(), std::move(driven.report)};
  measurement.direct_cost().add_to(outcome.report);
  outcome.report.rounds = outcome.estimates.rounds;
  outcome.report.photons_per_round = task.plan.forward;
  outcome.report.walks_per_round = task.plan.backward;
  finish_report(outcome.report, task.error(found));
  return outcome;
}

}  // namespace lichtmc
