// The random words of launches: independent for every photon, or quasi-random for the photons of a set.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "chance/stream.hpp"

namespace lichtmc {

// Independent words, addressed by the number of the history.
class LaunchWords {
 public:
  explicit LaunchWords(const Stream& stream) : stream_(stream) {}
  virtual ~LaunchWords() = default;

  // The direction and the emitter of photons first … first + n − 1 (n ≤ batch_histories), as draw_many() gives them.
  virtual void draw_emission(std::uint64_t first, std::uint32_t n, std::uint32_t* polar, std::uint32_t* azimuth,
                             std::uint64_t* chance) const;
  // The place on an area light: words 0 and 1 choose a part of it, 2 and 3 the point there.
  virtual Words place(std::uint64_t history) const { return stream_.draw(history, 0, Purpose::place); }
  // Further words for it, k ≥ 1.
  Words further_place(std::uint64_t history, std::uint32_t k) const { return stream_.draw(history, k, Purpose::place); }

 protected:
  LaunchWords(const LaunchWords&) = default;
  LaunchWords& operator=(const LaunchWords&) = default;

  Stream stream_;
};

// Sets of `set` photons (a power of two, at most batch_histories) that are spread evenly over directions, emitters and
// places: Sobol's points with a random shift for each set, see chance/sobol.hpp. Set s is the histories s · set … .
class QuasiRandomWords final : public LaunchWords {
 public:
  QuasiRandomWords(const Stream& stream, std::uint32_t set);

  void draw_emission(std::uint64_t first, std::uint32_t n, std::uint32_t* polar, std::uint32_t* azimuth,
                     std::uint64_t* chance) const override;
  Words place(std::uint64_t history) const override;

 private:
  struct Point {
    std::uint32_t polar, azimuth, emitter;
    std::array<std::uint32_t, 3> place;
  };
  std::vector<Point> points_;  // of a set without shift
};

}  // namespace lichtmc
