#include "run/crew.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <system_error>
#include <thread>

#include "chance/moments.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

constexpr std::chrono::milliseconds report_interval{100};

}  // namespace

Crew::Crew(const Scene& scene, const Settings& settings, const Control& control, unsigned threads)
    : settings_(&settings),
      control_(&control),
      rms_relative_error_(std::numeric_limits<double>::quiet_NaN()),
      began_(Clock::now()),
      reported_(began_) {
  for (unsigned k = 0; k < threads; ++k) {
    workers_.push_back(std::make_unique<Worker>(
        Worker{Tally(scene.map_of_tile, scene.maps, score_law(settings.estimator, scene.has_maps()).hits),
               make_walk(scene, settings)}));
  }
}

void Crew::simulate_up_to(std::uint64_t end) {
  next_ = done_;
  {
    // Threads of the run's own, as many as were asked for; the calling thread is one of them.
    std::vector<std::jthread> helpers;
    try {
      for (std::size_t k = 1; k < workers_.size(); ++k)
        helpers.emplace_back([this, k, end] { work(*workers_[k], end); });
    } catch (const std::system_error& error) {
      stop_ = true;  // those that have started end after their batch
      throw RuntimeError("Cannot start " + std::to_string(workers_.size()) + " threads (" + error.what() +
                         "). Give --threads a smaller number.");
    }
    work(*workers_.front(), end);
  }
  if (failure_) std::rethrow_exception(failure_);
  done_ = end;
}

void Crew::work(Worker& worker, std::uint64_t end) {
  try {
    while (!should_stop()) {
      const std::uint64_t first = next_.fetch_add(batch_histories);
      if (first >= end) break;
      const auto n = static_cast<std::uint32_t>(std::min<std::uint64_t>(batch_histories, end - first));
      std::uint64_t told = worker.tally.totals().impacts;
      worker.walk->simulate_batch(first, n, worker.tally, [&] {
        report(worker.tally, told, 0);
        return should_stop();
      });
      report(worker.tally, told, n);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    stop_ = true;
  }
}

bool Crew::should_stop() {
  if (stop_) return true;
  std::optional<StopReason> reason;
  if (control_->stop.stop_requested()) reason = StopReason::interrupt;
  if (settings_->max_seconds && seconds() >= *settings_->max_seconds) reason = StopReason::max_time;
  if (!reason) return false;
  const std::lock_guard lock(mutex_);
  if (!stopped_) stopped_ = reason;
  stop_ = true;
  return true;
}

void Crew::report(const Tally& tally, std::uint64_t& told, std::uint32_t histories) {
  const std::lock_guard lock(mutex_);
  impacts_done_ += tally.totals().impacts - told;
  told = tally.totals().impacts;
  histories_done_ += histories;
  const Clock::time_point now = Clock::now();
  if (!control_->progress || now - reported_ < report_interval) return;
  reported_ = now;
  Progress progress;
  progress.histories = histories_done_;
  progress.target = settings_->photons;
  progress.impacts = impacts_done_;
  progress.seconds = seconds();
  progress.rms_relative_error = rms_relative_error_;
  control_->progress(progress);
}

Totals Crew::totals() const {
  Totals sum = workers_.front()->tally.totals();
  for (std::size_t k = 1; k < workers_.size(); ++k) sum.add(workers_[k]->tally.totals());
  return sum;
}

double Crew::seconds() const {
  return std::chrono::duration<double>(Clock::now() - began_).count();
}

}  // namespace lichtmc
