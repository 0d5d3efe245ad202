// Backward walks from receivers of a furnished room: a living room with one isotropic lamp, and a grid of points.
#pragma once

#include <cstdint>
#include <memory>

#include "lichtmc/room.hpp"

namespace lichtmc::bench {

class BackwardStage {
 public:
  BackwardStage();
  BackwardStage(const BackwardStage&) = delete;
  BackwardStage& operator=(const BackwardStage&) = delete;
  ~BackwardStage();

  // One more round of walks from every receiver; returns the number of walks. plain_walk(): the same number by the
  // plain walk.
  double walk();
  double plain_walk();

  // The variance per walk, as a ratio to that of the plain walk: of the median receiver, and of the mean of the
  // relative variances, from about this number of walks each from every receiver.
  struct Variances {
    double median = 0.0;
    double mean = 0.0;
  };
  Variances compare_variances(std::uint64_t walks);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace lichtmc::bench
