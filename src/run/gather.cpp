#include "run/gather.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "run/collectives.hpp"
#include "run/forecast.hpp"
#include "run/pilot.hpp"
#include "run/progress_reporter.hpp"
#include "run/rounds.hpp"

namespace lichtmc {

namespace {

// Histories that a thread takes at a time: some waves, so that the lock that ends them costs nothing.
constexpr std::uint64_t histories_at_a_time = 8192;

[[noreturn]] void refuse_too_short() {
  throw StoppedTooSoon(
      "The run was stopped before its direct light and the first walks after it were done: there is no result, and "
      "what "
      "is in its folder stays as it was. Give it more time.");
}

class Gathering {
 public:
  // logbook: null for a pilot.
  Gathering(const GatherTask& task, const Settings& settings, const Control& control, StopWatch& watch,
            unsigned threads, RunRecord* record)
      : task_(task),
        settings_(settings),
        control_(control),
        watch_(watch),
        threads_(threads),
        together_(task.origins * task.group),
        range_(rounds_of(settings, together_)),
        record_(record),
        reporter_(control, watch, task.stage, histories_of(range_.last - range_.first)) {
    found_.sums = std::make_shared<std::vector<BackwardSums>>(task.origins);
    found_.group = task.group;
    found_.unit = task.unit;
    found_.estimator = settings.estimator;
  }

  // Why the estimator was chosen.
  void set_choice(const std::string& reason) { found_.choice = reason; }

  Gathered run();

 private:
  std::uint64_t histories_of(std::uint64_t rounds) const {
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    return rounds > most / together_ ? most : rounds * together_;
  }
  void go_on_from(const BackwardState& before);
  StopReason simulate();
  void simulate_up_to(std::uint64_t rounds);
  bool simulate_step(std::uint64_t rounds);
  void take_rounds(std::uint64_t first, std::uint64_t last, std::vector<BackwardSums>& step_sums,
                   BackwardCount& step_count);
  void write_down(StateData& data) const;

  const GatherTask& task_;
  const Settings& settings_;
  const Control& control_;
  StopWatch& watch_;
  unsigned threads_;
  std::uint64_t together_;  // walks in a round of all origins
  HistoryRange range_;      // of rounds, that there are to simulate
  RunRecord* record_;
  std::vector<HistoryRange> before_;  // earlier ranges than the one that grows
  std::uint64_t rounds_before_ = 0;   // in them
  ProgressReporter reporter_;
  Gathered found_;
  std::uint64_t step_ = 2;  // rounds of the next step
  std::atomic<std::uint64_t> next_{0};
  std::mutex mutex_;  // guards the sums and counts of a step
};

Gathered Gathering::run() {
  std::optional<BackwardState>* log = record_ == nullptr ? nullptr : &(record_->data().*task_.slot);
  const bool goes_on = log != nullptr && log->has_value();
  if (!goes_on) check_rounds(settings_, together_, task_.name);
  // Going on takes the direct light anew, however little time there is left: without it the walks would be lost.
  if (goes_on) watch_.suspend_limit();
  const double began = watch_.seconds();
  found_.direct = direct_light_of(task_.origins, task_.direct, control_, threads_, watch_, found_.count.traced);
  found_.direct_seconds = watch_.seconds() - began;
  if (goes_on) {
    watch_.restart_limit();
    go_on_from(**log);
  }
  found_.stopped_by = record_ != nullptr && record_->only_read() ? StopReason::photons : simulate();
  if (found_.rounds == 0) refuse_too_short();
  if (log != nullptr) write_down(record_->data());
  return std::move(found_);
}

void Gathering::go_on_from(const BackwardState& before) {
  if (before.sums->size() != task_.origins || before.group != task_.group) {
    throw InputError("The state has walks from " + std::to_string(before.sums->size()) + " origins, here are " +
                     std::to_string(task_.origins) +
                     " (allowed: as many). The state is not one of this room; run anew.");
  }
  if (!record_->only_read()) check_whole(settings_, together_, before, task_.name);
  found_.sums = before.sums.use_count() > 1 ? std::make_shared<std::vector<BackwardSums>>(*before.sums)
                                            : std::const_pointer_cast<std::vector<BackwardSums>>(before.sums);
  found_.count.traced.add(before.count.traced);
  found_.count.impacts += before.count.impacts;
  found_.choice = before.choice;
  found_.convergence = before.convergence;
  found_.rounds = before.size();
  before_ = before.ranges;
  range_.first = before_.back().first;
  range_.last = std::max(range_.last, before_.back().last);
  before_.pop_back();
  rounds_before_ = count_of(before_);
  reporter_.set_before(histories_of(found_.rounds));
}

void Gathering::write_down(StateData& data) const {
  std::optional<BackwardState>& slot = data.*task_.slot;
  BackwardState& log = slot ? *slot : slot.emplace();
  log.estimator = found_.estimator;
  log.choice = found_.choice;
  log.convergence = found_.convergence;
  log.group = task_.group;
  log.ranges = before_;
  log.ranges.push_back({range_.first, range_.first + found_.rounds - rounds_before_});
  log.count = found_.count;
  log.sums = found_.sums;
  log.seconds = watch_.seconds();
}

// As many rounds for every origin; the target error is looked at after numbers of them that depend on the settings
// alone.
StopReason Gathering::simulate() {
  const std::uint64_t last = range_.last - range_.first;
  const std::uint64_t first_look = std::max(2U, 256 / task_.group);  // an error from 256 walks is known to 4 %
  std::uint64_t look = std::min(first_look, last);
  const auto advance = [&look, last] {
    const std::uint64_t more = std::max<std::uint64_t>(1, look / 4);
    look = last - look > more ? look + more : last;
  };
  // What an earlier session has simulated it has looked at.
  while (look < found_.rounds && look < last) advance();
  Forecast forecast;
  for (;; advance()) {
    simulate_up_to(look);
    if (watch_.reason()) return *watch_.reason();
    const double error = task_.error(found_);
    forecast.look(histories_of(look), error);
    found_.convergence.push_back({histories_of(look), watch_.seconds(), error});
    if (settings_.target_error) found_.histories_to_target = forecast.histories_to(*settings_.target_error);
    reporter_.set_error(error, found_.histories_to_target);
    bool reached = settings_.target_error && error <= *settings_.target_error;
    broadcast(control_.communicator, reached);
    if (reached) return StopReason::target_error;
    if (look == last) return StopReason::photons;
  }
}

// In steps of some tenths of a second, after each of which the sums are whole.
void Gathering::simulate_up_to(std::uint64_t rounds) {
  constexpr double step_seconds = 0.5;
  while (found_.rounds < rounds) {
    const double began = watch_.seconds();
    const std::uint64_t step = std::min(step_, rounds - found_.rounds);
    if (!simulate_step(found_.rounds + step)) return;
    const double took = watch_.seconds() - began;
    if (step == step_ || took > step_seconds)
      step_ = std::max<std::uint64_t>(
          1,
          static_cast<std::uint64_t>(static_cast<double>(step) * std::min(4.0, step_seconds / std::max(took, 1e-6))));
    broadcast(control_.communicator, step_);
    bool due = record_ != nullptr && record_->due();
    broadcast(control_.communicator, due);
    if (due) {
      record_->checkpoint([this](StateData& data) { write_down(data); });
      (record_->data().*task_.slot)->sums.reset();  // or they would be copied before the next step is added
    }
  }
}

// What is simulated in part when a stop comes is thrown away: every origin has the same rounds. Whether it was whole.
// A team agrees behind each step.
bool Gathering::simulate_step(std::uint64_t rounds) {
  std::vector<BackwardSums> sums(task_.origins);
  BackwardCount count;
  next_ = 0;
  watch_.run_on_threads(threads_, [&](unsigned) { take_rounds(found_.rounds, rounds, sums, count); });
  watch_.agree();
  if (watch_.reason()) return false;
  reduce(control_.communicator, sums);
  reduce(control_.communicator, count);
  if (found_.sums.use_count() > 1) found_.sums = std::make_shared<std::vector<BackwardSums>>(*found_.sums);
  for (std::size_t k = 0; k < sums.size(); ++k) add_fields((*found_.sums)[k], sums[k]);
  add_fields(found_.count, count);
  found_.rounds = rounds;
  return true;
}

void Gathering::take_rounds(std::uint64_t first, std::uint64_t last, std::vector<BackwardSums>& step_sums,
                            BackwardCount& step_count) {
  const std::unique_ptr<BackwardWalk> walk = task_.make_walk(settings_);
  const std::uint64_t rounds = last - first;
  // Many origins with few rounds, or one origin with some of its rounds.
  const std::uint64_t rounds_at_a_time = histories_at_a_time / task_.group;
  const std::uint64_t together = std::max<std::uint64_t>(1, rounds_at_a_time / rounds);
  const std::uint64_t parts = together > 1 ? 1 : (rounds + rounds_at_a_time - 1) / rounds_at_a_time;
  // A member of a team takes its part of the pieces.
  const Part mine = part_of(control_.communicator, (task_.origins + together - 1) / together * parts);
  const std::uint64_t skipped = range_.first - rounds_before_;  // rounds are numbered from the run's first
  std::vector<BackwardSums> sums;
  while (!watch_.wants_to_stop()) {
    const std::uint64_t piece = mine.first + next_.fetch_add(1);
    if (piece >= mine.last) break;
    BackwardWork work;
    work.first = piece / parts * together;
    work.last = std::min<std::uint64_t>(task_.origins, work.first + together);
    work.first_sample = (skipped + first + rounds * (piece % parts) / parts) * task_.group;
    work.last_sample = (skipped + first + rounds * (piece % parts + 1) / parts) * task_.group;
    sums.assign(work.last - work.first, {});
    BackwardCount count;
    walk->simulate(work, sums, count, [this] {
      reporter_.add(0, 0);
      return watch_.wants_to_stop();
    });
    {
      const std::lock_guard lock(mutex_);
      for (std::size_t k = 0; k < sums.size(); ++k) add_fields(step_sums[work.first + k], sums[k]);
      add_fields(step_count, count);
    }
    const std::uint64_t walks = (work.last - work.first) * (work.last_sample - work.first_sample);
    const unsigned alike = size_of(control_.communicator);  // the others are as far as this member
    reporter_.add(walks * alike, count.traced.rays * alike);
  }
}

}  // namespace

std::vector<DirectIrradiance> direct_light_of(std::size_t origins, const DirectOf& direct, const Control& control,
                                              unsigned threads, StopWatch& watch, TraceCount& traced) {
  constexpr std::size_t at_a_time = 64;
  std::vector<DirectIrradiance> found(origins);
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  ProgressReporter reporter(control, watch, Progress::Stage::direct_light, origins);
  const Part mine = part_of(control.communicator, origins);
  next = mine.first;
  BackwardCount traced_here;
  watch.run_on_threads(threads, [&](unsigned) {
    TraceCount count;
    while (!watch.wants_to_stop()) {
      const std::size_t first = next.fetch_add(at_a_time);
      if (first >= mine.last) break;
      const std::size_t last = std::min<std::size_t>(mine.last, first + at_a_time);
      for (std::size_t k = first; k < last; ++k) found[k] = direct(k, count);
      reporter.add(last - first, 0);
    }
    const std::lock_guard lock(mutex);
    traced_here.traced.add(count);
  });
  watch.agree();
  if (watch.reason()) refuse_too_short();
  combine(control.communicator, found);
  reduce(control.communicator, traced_here);
  traced.add(traced_here.traced);
  return found;
}

double Gathered::indirect(std::size_t k) const {
  return static_cast<double>((*sums)[k].sum) / static_cast<double>(rounds * group) * unit;
}

// Rounds are independent: the variance of their mean from their own spread.
double Gathered::indirect_error(std::size_t k) const {
  if (rounds < 2) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<long double>(rounds);
  const auto sum = static_cast<long double>((*sums)[k].sum);
  const long double between = static_cast<long double>((*sums)[k].squares) - sum / n * sum;
  return static_cast<double>(std::sqrt(std::max(between, 0.0L) / (n - 1) / n)) / group * unit;
}

namespace {

Pilot outcome(const Gathered& found) {
  Pilot pilot;
  pilot.estimator = found.estimator;
  pilot.flights = static_cast<double>(found.count.traced.rays);
  for (std::size_t k = 0; k < found.sums->size(); ++k) {
    pilot.values.push_back(found.direct[k].value + found.indirect(k));
    pilot.errors.push_back(found.indirect_error(k));
  }
  return pilot;
}

// Pilots of all estimators; which did best, and why. What they have found is not used further, but where a stop comes:
// then the last of them is all that there is.
std::optional<Gathered> choose_by_pilots(const GatherTask& task, const Room& room, Settings& settings,
                                         const Control& control, StopWatch& watch, unsigned threads,
                                         std::string& reason) {
  GatherTask short_task = task;
  short_task.stage = Progress::Stage::pilot;
  Settings short_run = settings;
  short_run.target_error.reset();
  std::vector<Pilot> pilots;
  // Some walks from every origin, or there is nothing to compare.
  constexpr std::uint64_t fewest_rounds = 8;
  for (const Estimator estimator : candidates_for(room, settings)) {
    short_run.estimator = estimator;
    short_run.photons =
        std::max(pilot_histories(settings.photons, estimator), fewest_rounds * task.origins * task.group);
    Gathered found = Gathering(short_task, short_run, control, watch, threads, nullptr).run();
    if (watch.reason()) {
      found.choice = "The estimator '" + std::string(to_string(estimator)) + "' was taken for " + task.name +
                     ": the run ended before all were tried. To go on from there begins the walks anew.";
      return found;
    }
    pilots.push_back(outcome(found));
  }
  Choice choice = choose_best(pilots, pooled_values(pilots), task.weights, task.name);
  broadcast(control.communicator, choice.best);
  settings.estimator = pilots[choice.best].estimator;
  reason = choice.reason;
  return std::nullopt;
}

}  // namespace

Gathered gather(GatherTask task, const Room& room, Settings settings, const Control& control, StopWatch& watch,
                unsigned threads, RunRecord& record) {
  const std::optional<BackwardState>& log = record.data().*task.slot;
  if (log) settings.estimator = log->estimator;
  if (settings.estimator != Estimator::automatic)
    return Gathering(task, settings, control, watch, threads, &record).run();
  // Direct light is the same for all.
  TraceCount traced;
  const std::vector<DirectIrradiance> direct =
      direct_light_of(task.origins, task.direct, control, threads, watch, traced);
  const double direct_seconds = watch.seconds();
  task.direct = [&direct](std::size_t k, TraceCount& /*count*/) { return direct[k]; };
  std::string reason;
  std::optional<Gathered> cut_short = choose_by_pilots(task, room, settings, control, watch, threads, reason);
  Gathered found;
  if (cut_short) {
    found = std::move(*cut_short);
  } else {
    Gathering gathering(task, settings, control, watch, threads, &record);
    gathering.set_choice(reason);
    found = gathering.run();
  }
  found.direct_seconds = direct_seconds;
  found.count.traced.add(traced);
  return found;
}

}  // namespace lichtmc
