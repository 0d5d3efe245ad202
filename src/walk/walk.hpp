// The forward walk: a batch of histories from the emitters to their ends. The variant (estimator, textures or not)
// is chosen when the walk is made, once per run.
#pragma once

#include <cstdint>
#include <memory>

#include "chance/stream.hpp"
#include "lichtmc/settings.hpp"
#include "walk/kernel.hpp"
#include "walk/scene.hpp"
#include "walk/tally.hpp"

namespace lichtmc {

class Walk {
 public:
  virtual ~Walk() = default;

  // Simulates histories first … first + n − 1 (1 ≤ n ≤ batch_histories) and adds them to the tally as one batch.
  // Returns false if `abandon` ended them before their own ends (see Abandon).
  virtual bool simulate_batch(std::uint64_t first, std::uint32_t n, Tally& tally, const Abandon& abandon) = 0;

 protected:
  Walk() = default;
  Walk(const Walk&) = default;
  Walk& operator=(const Walk&) = default;
};

// A walk for one thread; the scene must outlive it.
std::unique_ptr<Walk> make_walk(const Scene& scene, const Settings& settings);

}  // namespace lichtmc
