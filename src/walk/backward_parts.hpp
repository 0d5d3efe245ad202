// The light that the photons of a backward wave collect, apart for groups of emitters.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "walk/direct_light.hpp"
#include "walk/emitter_groups.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

class BackwardParts {
 public:
  // groups: null if none are kept apart; then only kept() and size() are called. every_impact: light scores where it is
  // collected; else only that at the surface that a photon survived last (score_last()).
  BackwardParts(const DirectLight& light, const EmitterGroups* groups, bool every_impact)
      : size_(groups != nullptr ? groups->size() : 1), every_impact_(every_impact) {
    if (groups == nullptr) return;
    for (std::size_t k = 0; k < light.sources(); ++k) part_of_.push_back(groups->of_emitter[light.source(k).emitter]);
    found_.resize(std::size_t{batch_histories} * size_);
    if (!every_impact) last_.resize(found_.size());
  }

  bool kept() const { return !part_of_.empty(); }
  std::uint32_t size() const { return size_; }

  // n photons start.
  void start(std::uint32_t n) {
    std::fill_n(found_.begin(), std::size_t{n} * size_, 0.0);
    if (!every_impact_) leave(n);
  }
  // n photons leave their surfaces: what follows is the light there.
  void leave(std::size_t n) {
    if (!every_impact_) std::fill_n(last_.begin(), n * size_, 0.0);
  }
  // The light of a source at the surface that a photon, at position i of the wave, has left.
  void add(std::uint32_t photon, std::size_t i, std::size_t source, double weight, double irradiance) {
    if (every_impact_) {
      found_[std::size_t{photon} * size_ + part_of_[source]] += weight * irradiance;
    } else {
      last_[i * size_ + part_of_[source]] += irradiance;
    }
  }
  void score_last(std::uint32_t photon, std::size_t i, double absorptance) {
    for (std::uint32_t part = 0; part < size_; ++part)
      found_[std::size_t{photon} * size_ + part] += last_[i * size_ + part] / absorptance;
  }
  // A photon changes its position in the wave.
  void move(std::size_t from, std::size_t to) {
    if (!every_impact_) std::copy_n(&last_[from * size_], size_, &last_[to * size_]);
  }

  double found(std::uint32_t photon, std::uint32_t part) const { return found_[std::size_t{photon} * size_ + part]; }

 private:
  std::uint32_t size_;
  bool every_impact_;
  std::vector<std::uint32_t> part_of_;  // of each source of light
  std::vector<double> found_;           // [photon][part], W/m² or lx
  std::vector<double> last_;            // [position][part], at the surface that was left last
};

}  // namespace lichtmc
