// The backward walk: from receivers to the surfaces visible from them and on from surface to surface; it collects the
// direct light at each.
//
// E(x₀) = E_d(x₀) + ρ₁[E_d(x₁) + ρ₂[E_d(x₂) + …]]: the first term is computed (see direct_light.hpp); the others
// are estimated by a walk whose first flight leaves the receiver, or a random point of a tile, by Lambert's law.
// (H. Schulze, Lichtausbreitung in Räumen, 2021.)
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/fields.hpp"
#include "base/wide.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "walk/backward_sums.hpp"
#include "walk/direct_light.hpp"
#include "walk/kernel.hpp"
#include "walk/origin_view.hpp"
#include "walk/round_plan.hpp"
#include "walk/scene.hpp"
#include "walk/tile_faces.hpp"

namespace lichtmc {

class ChannelScores;
class FacetPlanes;
struct ChannelSums;
struct EmitterGroups;
struct PartSums;

// The unit of scores: 2⁻²⁴ of the emitters' power over the area of all surfaces. A score is at
// most 2⁵⁰ units, 6·10⁷ times that, and the sum of a round at most 2⁵²: the sum of the squares of 2²⁴ such rounds
// stays below 2¹²⁸.
struct BackwardScale {
  explicit BackwardScale(const Room& room);
  static constexpr std::uint64_t largest_score = std::uint64_t{1} << 50;
  static constexpr std::uint64_t largest_sum = std::uint64_t{1} << 52;

  double unit = 1.0;  // W/m² or lx
  // The emitters' power over the area of all surfaces.
  double mean_irradiance() const { return unit * 0x1p24; }
  std::uint64_t score(double irradiance) const;
};

// Walks to simulate: samples first_sample … last_sample − 1 of each of the origins first … last − 1, in whole rounds.
struct WalkBlock {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t first_sample = 0;
  std::uint64_t last_sample = 0;
};

struct BackwardCount {
  TraceCount traced;
  std::uint64_t impacts = 0;
  std::uint64_t connections = 0;  // of impacts of photons from the emitters with receivers (next_event.hpp)
  std::uint64_t capped = 0;       // scores beyond BackwardScale::largest_score
};

template <class F, AllOf<BackwardCount>... Things>
void visit_fields(const F& f, Things&... count) {
  f(Field{"impacts"}, count.impacts...);
  f(Field{"connections"}, count.connections...);
  f(Field{"capped"}, count.capped...);
  f(Field{"traced"}, count.traced...);
}

class BackwardWalk {
 public:
  virtual ~BackwardWalk() = default;

  // Simulates histories; sums[k], the sum over the rounds of origin work.first + k, is of scores in units of
  // BackwardScale::unit, or of the sums of a round of walks (see make_backward_walk).
  virtual void simulate(const WalkBlock& work, std::vector<BackwardSums>& sums, BackwardCount& count,
                        const Abandon& abandon) = 0;

  // The same; adds the mean over the walks of each round, in W/m² or lx and not rounded, to
  // irradiance[((r − first) · parts + group of emitters) · origins + k], for round r, of which `first` is the first of
  // the work, and origin work.first + k of its origins. parts is the number of groups of emitters that are kept apart.
  // scores: receives the light with its paths, of round r as r − first, if the walk keeps them; or null.
  virtual void collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& count,
                       const Abandon& abandon, ChannelScores* scores) = 0;
  void collect(const WalkBlock& work, std::vector<double>& irradiance, BackwardCount& count, const Abandon& abandon) {
    collect(work, irradiance, count, abandon, nullptr);
  }

  // Adds the impulse responses that were scored since the last call, if there are any.
  virtual void hand_over(ChannelSums& /*sums*/, BackwardCount& /*count*/) {}
  // The same for the parts of groups of emitters, if they are kept.
  virtual void hand_over(PartSums& /*sums*/) {}

 protected:
  BackwardWalk() = default;
  BackwardWalk(const BackwardWalk&) = default;
  BackwardWalk& operator=(const BackwardWalk&) = default;
};

// The origins of backward walks. Origins are numbered; walks from one are grouped in rounds, of which only the sum is
// recorded, so that the walks of a round may be spread evenly (first_flights.hpp): of `group` walks, unless a plan says
// otherwise. start() sets where photon i starts; origins that are extended have a place for each u, v in (0, 1).
// uncovered_share(): the share of an origin that receives light, from which its walks start.
class ReceiverOrigins {
 public:
  // receivers: see receiver_points.hpp.
  ReceiverOrigins(const std::vector<ReferencePoint>& receivers, const Tracer& tracer);

  static constexpr std::uint32_t group = 1;
  static constexpr bool is_extended = false;
  std::size_t size() const { return places_.size(); }
  static double uncovered_share(std::uint64_t /*receiver*/) { return 1.0; }
  OriginView start(std::uint64_t receiver, Rays& rays, std::size_t i) const {
    rays.facet[i] = no_facet;
    rays.set_start(i, places_[receiver].start);
    return places_[receiver].view;
  }
  const glm::dvec3& point(std::uint64_t receiver) const { return places_[receiver].point; }

 private:
  struct Place {
    glm::vec3 start;  // tracer's coordinates
    OriginView view;
    glm::dvec3 point;  // m, world
  };
  std::vector<Place> places_;
};

// The same if some of the receivers are cells: walks start at places in them.
class CellOrigins {
 public:
  CellOrigins(const std::vector<ReferencePoint>& receivers, const Tracer& tracer);

  static constexpr std::uint32_t group = 1;
  static constexpr bool is_extended = true;
  std::size_t size() const { return points_.size(); }
  static double uncovered_share(std::uint64_t /*receiver*/) { return 1.0; }
  OriginView start(std::uint64_t receiver, double u, double v, Rays& rays, std::size_t i) const;

 private:
  struct Edges {
    glm::vec3 u;  // tracer's coordinates
    glm::vec3 v;
  };
  ReceiverOrigins points_;
  std::vector<Edges> edges_;
};

// A walk for one thread, from receivers or from the faces of tiles; scene, light and origins must outlive it. plan: a
// round has plan.backward walks from each receiver; if it has histories from the emitters too, each light sample has
// its weight beside them (DirectLight::sample_light()). groups: of emitters whose light is kept apart, for collect();
// null: none.
std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const ReceiverOrigins& origins, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan,
                                                 const EmitterGroups* groups = nullptr);
std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const CellOrigins& origins, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan,
                                                 const EmitterGroups* groups = nullptr);
// The same with the paths of light, for collect(). planes: of the tracer's facets; must outlive it.
std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const ReceiverOrigins& origins, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan,
                                                 const FacetPlanes& planes);
std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light, const TileFaces& origins,
                                                 const BackwardScale& scale, const Settings& settings);

}  // namespace lichtmc
