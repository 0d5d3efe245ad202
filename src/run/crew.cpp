#include "run/crew.hpp"

#include <algorithm>

#include "chance/moments.hpp"

namespace lichtmc {

Crew::Crew(const Scene& scene, const Settings& settings, const Control& control, StopWatch& watch, unsigned threads)
    : scene_(&scene),
      hits_(score_law(settings.estimator, scene.has_maps()).hits),
      watch_(&watch),
      reporter_(control, watch, Progress::Stage::tiles, settings.photons) {
  for (unsigned k = 0; k < threads; ++k) {
    workers_.push_back(std::make_unique<Worker>(Worker{Tally(scene.first_tile, hits_), make_walk(scene, settings)}));
  }
}

void Crew::simulate_up_to(std::uint64_t end) {
  next_ = done_;
  watch_->run_on_threads(static_cast<unsigned>(workers_.size()), [&](unsigned k) { work(*workers_[k], end); });
  done_ = end;
}

void Crew::work(Worker& worker, std::uint64_t end) {
  std::uint64_t told = worker.tally.counts().impacts;
  const auto tell = [&](std::uint64_t histories) {
    reporter_.add(histories, worker.tally.counts().impacts - told);
    told = worker.tally.counts().impacts;
  };
  while (!watch_->should_stop()) {
    const std::uint64_t first = next_.fetch_add(batch_histories);
    if (first >= end) break;
    const auto n = static_cast<std::uint32_t>(std::min<std::uint64_t>(batch_histories, end - first));
    worker.walk->simulate_batch(first, n, worker.tally, [&] {
      tell(0);
      return watch_->should_stop();
    });
    tell(n);
  }
}

Totals Crew::totals() const {
  Totals sum(scene_->first_tile.back(), scene_->first_tile.size() - 1, hits_);
  for (const auto& worker : workers_) worker->tally.add_to(sum);
  return sum;
}

}  // namespace lichtmc
