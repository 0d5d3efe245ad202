// The backward walk: from receivers to the surfaces that they see, and on, collecting direct light on the way.
//
// E(x₀) = E_d(x₀) + ρ₁[E_d(x₁) + ρ₂[E_d(x₂) + …]]: the first term is computed (see direct_light.hpp), the others are
// what a walk finds whose first flight leaves the receiver by Lambert's law. For a tile it leaves a random point of it.
// (H. Schulze, Lichtausbreitung in Räumen,
// 2021.)
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/fields.hpp"
#include "base/wide.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "walk/direct_light.hpp"
#include "walk/kernel.hpp"
#include "walk/scene.hpp"
#include "walk/tile_faces.hpp"

namespace lichtmc {

// What the walks of a receiver, or of a face of a tile, add up to: integers, so that the order does not matter. Scores
// are irradiances in units of ReceiverScale::unit, or the sums of a round of walks (see make_backward_walk).
struct BackwardSums {
  uint128 sum = 0;
  uint128 squares = 0;

  void add(std::uint64_t score) {
    sum += score;
    squares += static_cast<uint128>(score) * score;
  }
};

template <class F, AllOf<BackwardSums>... Things>
void visit_fields(const F& f, Things&... sums) {
  f(Field{"sum"}, sums.sum...);
  f(Field{"squares"}, sums.squares...);
}
template <>
inline constexpr bool is_row<BackwardSums> = true;

// The unit of scores: 2⁻²⁴ of the irradiance that the emitters' power makes spread over all surfaces. A score is at
// most 2⁵⁰ units, 6·10⁷ times that; the sum of the squares of 2²⁴ rounds of four of the largest stays below 2¹²⁸.
struct BackwardScale {
  explicit BackwardScale(const Room& room);
  static constexpr std::uint64_t largest_score = std::uint64_t{1} << 50;

  double unit = 1.0;  // W/m² or lx
  std::uint64_t score(double irradiance) const;
};

// Which walks: of every origin from first to before last, samples from first_sample to before last_sample each, both
// whole rounds.
struct WalkBlock {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t first_sample = 0;
  std::uint64_t last_sample = 0;
};

struct BackwardCount {
  TraceCount traced;
  std::uint64_t impacts = 0;
};

template <class F, AllOf<BackwardCount>... Things>
void visit_fields(const F& f, Things&... count) {
  f(Field{"impacts"}, count.impacts...);
  f(Field{"traced"}, count.traced...);
}

class BackwardWalk {
 public:
  virtual ~BackwardWalk() = default;

  // Simulates histories; sums[k] belongs to origin work.first + k.
  virtual void simulate(const WalkBlock& work, std::vector<BackwardSums>& sums, BackwardCount& count,
                        const Abandon& abandon) = 0;

 protected:
  BackwardWalk() = default;
  BackwardWalk(const BackwardWalk&) = default;
  BackwardWalk& operator=(const BackwardWalk&) = default;
};

// Where backward walks come from. Origins are numbered; walks from one come in rounds of `group`, of which only the sum
// counts, so that a round may be spread evenly. start() sets where photon i starts and says how it looks at the room.
class ReceiverOrigins {
 public:
  ReceiverOrigins(const std::vector<Receiver>& receivers, const Tracer& tracer)
      : receivers_(&receivers), tracer_(&tracer) {}

  static constexpr std::uint32_t group = 1;
  std::size_t size() const { return receivers_->size(); }
  ReferencePoint start(std::uint64_t receiver, std::uint64_t sample, std::uint64_t id, const Stream& stream, Rays& rays,
                       std::size_t i) const;

 private:
  const std::vector<Receiver>* receivers_;
  const Tracer* tracer_;
};

// A walk for one thread, from receivers or from the faces of tiles; scene, light and origins must outlive it.
std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const ReceiverOrigins& origins, const BackwardScale& scale,
                                                 const Settings& settings);
std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light, const TileFaces& origins,
                                                 const BackwardScale& scale, const Settings& settings);

}  // namespace lichtmc
