// The backward walk without lanes, as a reference for measurements: a wave whose light is sampled photon by photon,
// with single shadow rays and independent random numbers. Estimator weight; point lights; receivers with whole
// hemispheres.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "walk/direct_light.hpp"
#include "walk/reference_point.hpp"
#include "walk/scene.hpp"

namespace lichtmc::bench {

class PlainBackward {
 public:
  // All must outlive this.
  PlainBackward(const Scene& scene, const DirectLight& light, const std::vector<ReferencePoint>& receivers);
  PlainBackward(const PlainBackward&) = delete;
  PlainBackward& operator=(const PlainBackward&) = delete;
  ~PlainBackward();

  // Walks first … first + n − 1 of every receiver; adds their irradiances to sums and the squares of these to squares.
  void walk(std::uint64_t first, std::uint64_t n, std::vector<double>& sums, std::vector<double>& squares);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace lichtmc::bench
