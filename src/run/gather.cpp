#include "run/gather.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "run/forecast.hpp"
#include "run/pilot.hpp"
#include "run/reporter.hpp"

namespace lichtmc {

namespace {

// Histories that a thread takes at a time: some waves, so that the lock that ends them costs nothing.
constexpr std::uint64_t histories_at_a_time = 8192;

[[noreturn]] void refuse_too_short() {
  throw RuntimeError(
      "The run was stopped before the direct light and the first walks back to it were done: there is no result. Give "
      "it more time.");
}

class Gathering {
 public:
  Gathering(const GatherTask& task, const Settings& settings, const Control& control, StopWatch& watch,
            unsigned threads)
      : task_(task),
        settings_(settings),
        control_(control),
        watch_(watch),
        threads_(threads),
        last_(last_round()),
        reporter_(control, watch, task.stage, histories_of(last_)) {
    found_.sums.resize(task.origins);
    found_.group = task.group;
    found_.unit = task.unit;
    found_.estimator = settings.estimator;
  }

  Gathered run() {
    found_.direct = direct_light_of(task_.origins, task_.direct, control_, threads_, watch_, found_.count.traced);
    found_.direct_seconds = watch_.seconds();
    found_.stopped_by = simulate();
    if (found_.rounds == 0) refuse_too_short();
    return std::move(found_);
  }

 private:
  std::uint64_t last_round() const {
    const std::uint64_t together = task_.origins * task_.group;
    return std::max<std::uint64_t>(2, settings_.photons / together + (settings_.photons % together != 0));
  }
  std::uint64_t histories_of(std::uint64_t rounds) const {
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t together = task_.origins * task_.group;
    return rounds > most / together ? most : rounds * together;
  }
  StopReason simulate();
  void simulate_up_to(std::uint64_t rounds);
  void take_rounds(std::uint64_t first, std::uint64_t last);

  const GatherTask& task_;
  const Settings& settings_;
  const Control& control_;
  StopWatch& watch_;
  unsigned threads_;
  std::uint64_t last_;
  Reporter reporter_;
  Gathered found_;
  std::atomic<std::uint64_t> next_{0};
  std::mutex mutex_;  // guards the sums and counts
};

// As many rounds for every origin; the target error is looked at after numbers of them that depend on the settings
// alone.
StopReason Gathering::simulate() {
  const std::uint64_t first_look = std::max(2U, 256 / task_.group);  // an error from 256 walks is known to 4 %
  // Without a target error looks serve progress and the end by time: sums are whole at each.
  std::uint64_t look = std::min(first_look, last_);
  Forecast forecast;
  for (;;) {
    simulate_up_to(look);
    if (watch_.reason()) return *watch_.reason();
    found_.rounds = look;
    const double error = task_.error(found_);
    forecast.look(histories_of(look), error);
    found_.convergence.push_back({histories_of(look), watch_.seconds(), error});
    if (settings_.target_error) found_.histories_to_target = forecast.histories_to(*settings_.target_error);
    reporter_.set_error(error, found_.histories_to_target);
    if (settings_.target_error && error <= *settings_.target_error) return StopReason::target_error;
    if (look == last_) return StopReason::photons;
    const std::uint64_t more = std::max<std::uint64_t>(1, look / 4);
    look = last_ - look > more ? look + more : last_;
  }
}

void Gathering::simulate_up_to(std::uint64_t rounds) {
  // What is simulated in part when a stop comes is thrown away: every origin has the same rounds.
  const std::vector<ReceiverSums> before = found_.sums;
  next_ = 0;
  watch_.run_on_threads(threads_, [&](unsigned) { take_rounds(found_.rounds, rounds); });
  if (watch_.reason()) found_.sums = before;
}

void Gathering::take_rounds(std::uint64_t first, std::uint64_t last) {
  const std::unique_ptr<BackwardWalk> walk = task_.make_walk(settings_);
  const std::uint64_t rounds = last - first;
  // Many origins with few rounds, or one origin with some of its rounds.
  const std::uint64_t rounds_at_a_time = histories_at_a_time / task_.group;
  const std::uint64_t together = std::max<std::uint64_t>(1, rounds_at_a_time / rounds);
  const std::uint64_t parts = together > 1 ? 1 : (rounds + rounds_at_a_time - 1) / rounds_at_a_time;
  const std::uint64_t pieces = (task_.origins + together - 1) / together * parts;
  std::vector<ReceiverSums> sums;
  while (!watch_.should_stop()) {
    const std::uint64_t piece = next_.fetch_add(1);
    if (piece >= pieces) break;
    BackwardWork work;
    work.first = piece / parts * together;
    work.last = std::min<std::uint64_t>(task_.origins, work.first + together);
    work.first_sample = (first + rounds * (piece % parts) / parts) * task_.group;
    work.last_sample = (first + rounds * (piece % parts + 1) / parts) * task_.group;
    sums.assign(work.last - work.first, {});
    BackwardCount count;
    walk->simulate(work, sums, count, [this] {
      reporter_.add(0, 0);
      return watch_.should_stop();
    });
    {
      const std::lock_guard lock(mutex_);
      for (std::size_t k = 0; k < sums.size(); ++k) found_.sums[work.first + k].add(sums[k]);
      found_.count.add(count);
    }
    reporter_.add((work.last - work.first) * (work.last_sample - work.first_sample), count.traced.rays);
  }
}

}  // namespace

std::vector<DirectIrradiance> direct_light_of(std::size_t origins, const DirectOf& direct, const Control& control,
                                              unsigned threads, StopWatch& watch, TraceCount& traced) {
  constexpr std::size_t at_a_time = 64;
  std::vector<DirectIrradiance> found(origins);
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  Reporter reporter(control, watch, Progress::Stage::direct_light, origins);
  watch.run_on_threads(threads, [&](unsigned) {
    TraceCount count;
    while (!watch.should_stop()) {
      const std::size_t first = next.fetch_add(at_a_time);
      if (first >= origins) break;
      const std::size_t last = std::min(origins, first + at_a_time);
      for (std::size_t k = first; k < last; ++k) found[k] = direct(k, count);
      reporter.add(last - first, 0);
    }
    const std::lock_guard lock(mutex);
    traced.add(count);
  });
  if (watch.reason()) refuse_too_short();
  return found;
}

double Gathered::indirect(std::size_t k) const {
  return static_cast<double>(sums[k].sum) / static_cast<double>(rounds * group) * unit;
}

// Rounds are independent: the variance of their mean from their own spread.
double Gathered::indirect_error(std::size_t k) const {
  if (rounds < 2) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<long double>(rounds);
  const auto sum = static_cast<long double>(sums[k].sum);
  const long double between = static_cast<long double>(sums[k].squares) - sum / n * sum;
  return static_cast<double>(std::sqrt(std::max(between, 0.0L) / (n - 1) / n)) / group * unit;
}

namespace {

Pilot outcome(const Gathered& found) {
  Pilot pilot;
  pilot.estimator = found.estimator;
  pilot.flights = static_cast<double>(found.count.traced.rays);
  for (std::size_t k = 0; k < found.sums.size(); ++k) {
    pilot.values.push_back(found.direct[k].value + found.indirect(k));
    pilot.errors.push_back(found.indirect_error(k));
  }
  return pilot;
}

Gathered gather_with_best(GatherTask task, const Room& room, Settings settings, const Control& control,
                          StopWatch& watch, unsigned threads) {
  TraceCount traced;
  const std::vector<DirectIrradiance> direct =
      direct_light_of(task.origins, task.direct, control, threads, watch, traced);
  const double direct_seconds = watch.seconds();
  task.direct = [&direct](std::size_t k, TraceCount& /*count*/) { return direct[k]; };
  GatherTask short_task = task;
  short_task.stage = Progress::Stage::pilot;
  Settings short_run = settings;
  short_run.target_error.reset();
  // Some walks from every origin, or there is nothing to compare.
  constexpr std::uint64_t fewest_rounds = 8;
  std::vector<Pilot> pilots;
  for (const Estimator estimator : candidates_for(room, settings)) {
    short_run.estimator = estimator;
    short_run.photons =
        std::max(pilot_histories(settings.photons, estimator), fewest_rounds * task.origins * task.group);
    Gathered found = Gathering(short_task, short_run, control, watch, threads).run();
    if (watch.reason()) {
      found.choice = "The estimator '" + std::string(to_string(estimator)) + "' was taken for " + task.name +
                     ": the run ended before all were tried.";
      found.count.traced.add(traced);
      return found;
    }
    pilots.push_back(outcome(found));
  }
  const Choice choice = choose_best(pilots, pooled_values(pilots), task.weights, task.name);
  settings.estimator = pilots[choice.best].estimator;
  Gathered found = Gathering(task, settings, control, watch, threads).run();
  found.choice = choice.reason;
  found.direct_seconds = direct_seconds;
  found.count.traced.add(traced);
  return found;
}

}  // namespace

Gathered gather(const GatherTask& task, const Room& room, const Settings& settings, const Control& control,
                StopWatch& watch, unsigned threads) {
  if (settings.estimator == Estimator::automatic)
    return gather_with_best(task, room, settings, control, watch, threads);
  return Gathering(task, settings, control, watch, threads).run();
}

}  // namespace lichtmc
