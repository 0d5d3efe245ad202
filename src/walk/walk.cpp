// The forward walk: photons start at the emitters and score on the tiles.
#include "walk/walk.hpp"

#include <algorithm>
#include <cassert>

#include "walk/choose_policy.hpp"
#include "walk/kernel.hpp"

namespace lichtmc {

namespace {

// If direct light is integrated, the first flight of a photon does not score: it only leads to the point of the first
// reflection. There the photon is split into this number of histories, which saves all but one of their first flights.
// More would save little, because their scores are correlated (docs/trade-off.md has the figures).
constexpr std::uint32_t splitting_factor = 8;

// Goal of the forward walk: photons score on the tiles.
template <class Policy>
class TileGoal : public GoalBase {
 public:
  TileGoal(const Scene& scene, const Stream& stream, Direct direct)
      : scene_(&scene),
        stream_(stream),
        first_scored_(direct == Direct::analytic ? 2 : 1),
        splitting_(direct == Direct::analytic ? splitting_factor : 1),
        tile_(batch_histories),
        tile_map_(batch_histories),
        units_(batch_histories),
        ended_tile_(batch_histories),
        ended_tile_map_(batch_histories) {}

  void begin(std::uint64_t first, Tally& tally) {
    first_history_ = first;
    tally_ = &tally;
  }

  // Photons start at the emitters, one for each `splitting_` histories.
  void start(Wave& wave, std::uint32_t n) {
    flight_ = 0;
    n_ = n;
    const std::uint32_t photons = (n + splitting_ - 1) / splitting_;
    wave.rays.size = photons;
    scene_->launcher->launch_all(stream_, first_history_, photons, wave.rays, wave.photon.data());
  }
  Misses misses() const { return scene_->misses; }
  TraceCount& traced() { return tally_->counts().traced; }
  Ends& ends() { return tally_->counts().ends; }

  // The light of a covered part of an area light is absorbed between it and the face that covers it: at its first
  // impact.
  void cover(const Wave& wave, std::size_t i) {
    const std::uint32_t photons = histories_of(wave.photon[i]);
    tally_->counts().impacts += photons;
    const int128 units = static_cast<int128>(Policy::units(wave.weight[i])) * photons;
    ends().absorbed += units;
    if (!scene_->has_reflectance_maps()) return;
    const SurfaceOptics& at = scene_->surfaces[scene_->surface_of[wave.rays.facet[i]]];
    tally_->absorb(at.map, units);  // area lights emit from their fronts
  }
  void escape(const Wave& wave, std::size_t i) {
    const std::uint32_t photons = flight_ == 0 ? histories_of(wave.photon[i]) : 1;
    const int128 units = static_cast<int128>(Policy::units(wave.weight[i])) * photons;
    if (scene_->misses == Misses::escape) {
      ends().escaped += units;
    } else {
      ends().lost += units;
      ends().lost_histories += photons;
    }
  }

  // After the first flight the photon is split: its histories continue independently.
  void split(Wave& wave) const {
    if (flight_ > 0 || splitting_ == 1) return;
    Rays& rays = wave.rays;
    std::size_t all = 0;
    for (std::size_t i = 0; i < rays.size; ++i) all += histories_of(wave.photon[i]);
    // From the last backwards: a position is read before it is overwritten.
    std::size_t to = all;
    for (std::size_t i = rays.size; i-- > 0;) {
      const std::uint32_t photon = wave.photon[i];
      for (std::uint32_t k = histories_of(photon); k-- > 0;) {
        rays.move_landing(i, --to);
        wave.photon[to] = photon * splitting_ + k;
      }
    }
    rays.size = all;
  }

  // Every impact is on a tile.
  void land(Wave& wave) {
    ++flight_;
    tally_->counts().impacts += wave.rays.size;
    scene_->tile_of_each(wave.rays, tile_.data(), tile_map_.data(), wave.surface.data());
    tally_->expect(tile_.data(), wave.rays.size);
  }

  // The first impact is direct light: it scores only if direct light is not integrated.
  void score(const Wave& wave) {
    if constexpr (Policy::scores_every_impact) {
      if (flight_ < first_scored_) return;
      const std::size_t n = wave.rays.size;
      if constexpr (Policy::law.hits == Hits::are_the_score) {
        tally_->score_each(tile_.data(), tile_map_.data(), n);
      } else {
        units_of_each(n, wave.weight.data(), units_.data());
        tally_->score_each(tile_.data(), tile_map_.data(), units_.data(), n);
      }
      score_from_behind(wave);
    }
  }

  static constexpr bool watches_absorption = !Policy::scores_every_impact;
  static constexpr bool in_lanes = Policy::chooses_in_lanes;
  void absorb(const Wave& wave, std::size_t i, double /*reflectance*/) {
    if constexpr (!Policy::scores_every_impact) {
      if (flight_ < first_scored_) return;
      const std::uint64_t units = Policy::units(wave.weight[i]);
      tally_->score(tile_[i], tile_map_[i], units);
      if (wave.rays.behind[i] != 0) tally_->score_behind(tile_map_[i], units);
    }
  }
  void absorb_all(const Wave& wave, const std::uint32_t* at, std::size_t n) {
    if (flight_ < first_scored_) return;
    for (std::size_t k = 0; k < n; ++k) {
      ended_tile_[k] = tile_[at[k]];
      ended_tile_map_[k] = tile_map_[at[k]];
      if (wave.rays.behind[at[k]] != 0) tally_->score_behind(tile_map_[at[k]], 1);
    }
    tally_->score_each(ended_tile_.data(), ended_tile_map_.data(), n);
  }
  static constexpr bool counts_absorption = true;
  // Of all flights, also of those whose direct light is integrated.
  void count_absorbed(std::size_t i, int128 units) { tally_->absorb(tile_map_[i], units); }
  // The weight that is cut off is the residual of the balance.
  void cut_off(const Wave& wave, std::size_t i) {
    ends().residual += static_cast<int128>(Policy::units(wave.weight[i]));
  }

 private:
  // The number of histories that a photon represents until it is split.
  std::uint32_t histories_of(std::uint32_t photon) const { return std::min(splitting_, n_ - photon * splitting_); }

  // In most rooms no photon hits a back side.
  void score_from_behind(const Wave& wave) {
    const Rays& rays = wave.rays;
    std::uint32_t any = 0;
    for (std::size_t i = 0; i < rays.size; ++i) any |= rays.behind[i];
    if (any == 0) return;
    for (std::size_t i = 0; i < rays.size; ++i) {
      if (rays.behind[i] != 0) tally_->score_behind(tile_map_[i], Policy::units(wave.weight[i]));
    }
  }

  const Scene* scene_;
  Stream stream_;
  std::uint32_t first_scored_;  // number of the first flight that scores
  std::uint32_t splitting_;     // histories that share their first flight
  std::uint32_t flight_ = 0;
  std::uint32_t n_ = 0;                  // histories of the batch
  std::vector<std::uint32_t> tile_;      // where the flight ended
  std::vector<std::uint32_t> tile_map_;  // of that tile
  std::vector<std::uint32_t> units_;
  std::vector<std::uint32_t> ended_tile_;
  std::vector<std::uint32_t> ended_tile_map_;
  Tally* tally_ = nullptr;
};

template <class Policy, class Reflectance>
class ForwardWalk final : public Walk {
 public:
  ForwardWalk(const Scene& scene, const Settings& settings, std::uint32_t max_flights)
      : goal_(scene, Stream(settings.seed), settings.direct), kernel_(scene, Stream(settings.seed), max_flights) {}

  bool simulate_batch(std::uint64_t first, std::uint32_t n, Tally& tally, const Abandon& abandon) override {
    goal_.begin(first, tally);
    const bool ended = kernel_.fly(n, goal_, abandon);
    tally.close_batch(n);
    assert(every_history_has_ended(tally));
    return ended;
  }

 private:
  // Emitted = absorbed + escaped + residual + lost, in integers.
  static bool every_history_has_ended(const Tally& tally) {
    const Counts& counts = tally.counts();
    const Ends& ends = counts.ends;
    const auto emitted = static_cast<int128>(counts.histories) * static_cast<int128>(Policy::units(1.0));
    return ends.absorbed + ends.escaped + ends.residual + ends.lost == emitted;
  }

  TileGoal<Policy> goal_;
  Kernel<Policy, Reflectance, TileGoal<Policy>> kernel_;
};

}  // namespace

std::unique_ptr<Walk> make_walk(const Scene& scene, const Settings& settings) {
  return choose_policy(settings.estimator, settings.max_bounces, scene.has_reflectance_maps(),
                       [&]<class Policy, class Reflectance>(std::uint32_t max_flights) -> std::unique_ptr<Walk> {
                         return std::make_unique<ForwardWalk<Policy, Reflectance>>(scene, settings, max_flights);
                       });
}

}  // namespace lichtmc
