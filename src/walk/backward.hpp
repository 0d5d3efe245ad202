// The backward walk: from receivers to the surfaces that they see, and on, collecting direct light on the way.
//
// E(x₀) = E_d(x₀) + ρ₁[E_d(x₁) + ρ₂[E_d(x₂) + …]]: the first term is computed (see direct_light.hpp), the others are
// what a walk finds whose first flight leaves the receiver by Lambert's law. (H. Schulze, Lichtausbreitung in Räumen,
// 2021.)
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/wide.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "walk/direct_light.hpp"
#include "walk/kernel.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// What the histories of a receiver add up to: integers, so that the order does not matter. Scores are irradiances in
// units of ReceiverScale::unit.
struct ReceiverSums {
  uint128 sum = 0;
  uint128 squares = 0;

  void add(std::uint64_t score) {
    sum += score;
    squares += static_cast<uint128>(score) * score;
  }
  void add(const ReceiverSums& other) {
    sum += other.sum;
    squares += other.squares;
  }
};

// The unit of scores: 2⁻²⁴ of the irradiance that the emitters' power makes spread over all surfaces. A score is at
// most 2⁵⁰ units, 6·10⁷ times that; the sum of the squares of 2²⁸ of the largest stays below 2¹²⁸.
struct ReceiverScale {
  explicit ReceiverScale(const Room& room);
  double unit = 1.0;  // W/m² or lx
  std::uint64_t score(double irradiance) const;
};

// Which histories: every receiver from first to before last, samples from first_sample to before last_sample each.
struct ReceiverWork {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t first_sample = 0;
  std::uint64_t last_sample = 0;
};

class BackwardWalk {
 public:
  virtual ~BackwardWalk() = default;

  // Simulates histories; sums[k] belongs to receiver work.first + k.
  virtual void simulate(const ReceiverWork& work, std::vector<ReceiverSums>& sums, TraceCount& traced,
                        const Abandon& abandon) = 0;

 protected:
  BackwardWalk() = default;
  BackwardWalk(const BackwardWalk&) = default;
  BackwardWalk& operator=(const BackwardWalk&) = default;
};

// How a receiver looks at the room. Its field of view is a cone about the normal; what it sees at an angle of 0° has
// none.
Outlook outlook_of(const Receiver& receiver);

// A walk for one thread; scene, light and receivers must outlive it.
std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const std::vector<Receiver>& receivers, const ReceiverScale& scale,
                                                 const Settings& settings);

}  // namespace lichtmc
