#include "run/worker_threads.hpp"

#include <algorithm>
#include <utility>

#include "chance/moments.hpp"
#include "run/collectives.hpp"
#include "walk/choose_policy.hpp"

namespace lichtmc {

namespace {

// Length of a round: it bounds the latency of a stop and the time spent waiting for the slowest rank.
constexpr double round_seconds = 0.25;

}  // namespace

WorkerThreads::WorkerThreads(const Scene& scene, const Settings& settings, const Control& control, StopWatch& watch,
                             unsigned threads)
    : scene_(&scene),
      hits_(score_law(settings.estimator, scene.has_reflectance_maps()).hits),
      absorption_(scene.has_reflectance_maps() ? Absorption::counted : Absorption::by_reflectance),
      communicator_(control.communicator),
      watch_(&watch),
      reporter_(control, watch, Progress::Stage::tiles, settings.photons),
      range_{settings.first_history, settings.first_history},
      round_(std::uint64_t{4} * threads * size_of(communicator_)),
      whole_(std::make_shared<Totals>(scene.first_tile.back(), scene.first_tile.size() - 1, hits_, absorption_)) {
  for (unsigned k = 0; k < threads; ++k) {
    workers_.push_back({make_walk(scene, settings), std::nullopt});
  }
  broadcast(communicator_, round_);  // ranks may have different numbers of threads
}

void WorkerThreads::restore(std::vector<HistoryRange> ranges, std::shared_ptr<const Totals> totals) {
  whole_ = own(std::move(totals));
  before_ = std::move(ranges);
  range_ = before_.back();
  before_.pop_back();
  reporter_.set_before(histories());
}

void WorkerThreads::begin(RunRecord& record) {
  record_ = &record;
  const std::size_t bytes = whole_->tiles.size() * sizeof(Moments) + whole_->hits.size() * sizeof(std::uint64_t);
  record.expect(static_cast<double>(bytes));
  // If an earlier session ended within a batch, only its whole batches are used.
  range_.last -= (range_.last - range_.first) % batch_histories;
}

std::uint64_t WorkerThreads::histories() const {
  return range_.last - range_.first + ends_ + count_of(before_);
}

void WorkerThreads::simulate_towards(std::uint64_t count) {
  const std::uint64_t rest = count % batch_histories;
  const std::uint64_t end = range_.first + (count - rest);
  if (range_.last < end) return communicator_ == nullptr ? simulate_alone(end) : simulate_in_ranks(end);
  if (rest == 0 || ends_ > 0) return;
  collect();
  simulate_part({end, end + rest});
}

void WorkerThreads::simulate_ends() {
  collect();
  const std::uint64_t rest = (range_.last - range_.first) % batch_histories;
  if (rest == 0) return;
  range_.last -= rest;
  simulate_part({range_.last, range_.last + rest});
}

// Every rank does this itself: a batch takes less time than a broadcast of its result.
void WorkerThreads::simulate_part(HistoryRange range) {
  Worker& worker = workers_.front();
  worker.tally.emplace(scene_->first_tile, hits_, absorption_);
  const auto n = static_cast<std::uint32_t>(range.last - range.first);
  worker.abandoned |=
      !worker.walk->simulate_batch(range.first, n, *worker.tally, [this] { return watch_->should_stop(); });
  ends_ = n;
  reporter_.add(n, worker.tally->counts().impacts);
}

// Each thread makes its own tally: with many tiles this takes some time.
void WorkerThreads::make_tally(Worker& worker) const {
  if (worker.tally) return;
  const double began = watch_->seconds();
  worker.tally.emplace(scene_->first_tile, hits_, absorption_);
  worker.tally_seconds = watch_->seconds() - began;
}

// Adds the time to make new tallies to the cost of the checkpoint.
void WorkerThreads::count_tally_time() {
  double longest = 0.0;
  for (Worker& worker : workers_) longest = std::max(longest, std::exchange(worker.tally_seconds, 0.0));
  if (std::exchange(after_checkpoint_, false)) record_->add_cost(longest);
}

// Threads return early when a checkpoint is due; they complete the batches that have begun.
void WorkerThreads::simulate_alone(std::uint64_t end) {
  next_ = range_.last;
  watch_->run_on_threads(static_cast<unsigned>(workers_.size()), [&](unsigned k) { work(workers_[k], end, true); });
  range_.last = std::min(next_.load(), end);
  count_tally_time();
}

// A round: every rank always completes its part of the batches, so that there are no gaps.
void WorkerThreads::simulate_in_ranks(std::uint64_t end) {
  const double began = watch_->seconds();
  const std::uint64_t batches = std::min(round_, (end - range_.last) / batch_histories);
  const Part part = part_of(communicator_, batches);
  next_ = range_.last + part.first * batch_histories;
  const std::uint64_t my_end = range_.last + part.last * batch_histories;
  watch_->run_on_threads(static_cast<unsigned>(workers_.size()), [&](unsigned k) { work(workers_[k], my_end, false); });
  range_.last += batches * batch_histories;
  count_tally_time();
  // All ranks wait for the slowest here.
  std::uint64_t impacts = round_impacts_.exchange(0);
  communicator_->sum(std::span(&impacts, 1));
  reporter_.add(batches * batch_histories, impacts);
  watch_->agree();
  // The next round is adapted to round_seconds, but at most doubled.
  const double took = watch_->seconds() - began;
  const std::uint64_t fewest = std::uint64_t{2} * workers_.size() * size_of(communicator_);
  const double better = static_cast<double>(round_) * std::min(2.0, round_seconds / std::max(took, 1e-6));
  round_ = std::max(fewest, static_cast<std::uint64_t>(better));
  broadcast(communicator_, round_);
}

void WorkerThreads::work(Worker& worker, std::uint64_t end, bool may_pause) {
  make_tally(worker);
  std::uint64_t reported = worker.tally->counts().impacts;
  const auto report = [&](std::uint64_t histories) {
    const std::uint64_t impacts = worker.tally->counts().impacts - reported;
    reported += impacts;
    if (communicator_ == nullptr) {
      reporter_.add(histories, impacts);
    } else {
      round_impacts_ += impacts;
    }
  };
  while (!watch_->should_stop() && !(may_pause && record_ != nullptr && record_->due())) {
    const std::uint64_t first = next_.fetch_add(batch_histories);
    if (first >= end) break;
    worker.abandoned |= !worker.walk->simulate_batch(first, batch_histories, *worker.tally, [&] {
      report(0);
      return watch_->should_stop();
    });
    report(batch_histories);
  }
}

bool WorkerThreads::abandoned() const {
  return std::any_of(workers_.begin(), workers_.end(), [](const Worker& worker) { return worker.abandoned; });
}

// Adds whole batches from the threads' tallies to the sum. Abandoned batches are not added: the work has ended.
void WorkerThreads::collect() {
  if (ends_ > 0 || abandoned()) return;
  whole_ = own<Totals>(std::move(whole_));
  const auto add_tallies = [this](Totals& sum) {
    for (Worker& worker : workers_) {
      if (worker.tally) worker.tally->add_to(sum);
      worker.tally.reset();
    }
  };
  if (communicator_ == nullptr) return add_tallies(*whole_);
  Totals of_all_ranks(whole_->tiles.size(), whole_->tile_maps.size(), hits_, absorption_);
  add_tallies(of_all_ranks);
  reduce(communicator_, of_all_ranks);
  whole_->add(of_all_ranks);
}

const Totals& WorkerThreads::totals() {
  collect();
  if (ends_ == 0 && !abandoned()) return *whole_;
  if (sum_ == nullptr) {
    sum_ = std::make_unique<Totals>(*whole_);
    for (Worker& worker : workers_) {
      if (worker.tally) worker.tally->add_to(*sum_);
      worker.tally.reset();
    }
  }
  return *sum_;
}

Counted WorkerThreads::state() {
  collect();
  Counted counted;
  counted.ranges = before_;
  HistoryRange range = range_;
  // If the last step was abandoned: the sums collected before it, whose number of histories they contain.
  if (abandoned()) range.last = range.first + (whole_->histories - count_of(before_));
  range.last += ends_;
  counted.ranges.push_back(range);
  counted.totals = whole_;
  return counted;
}

}  // namespace lichtmc
