// Next-event estimation: photons from the emitters, whose every impact contributes to every receiver.
//
// E(x) += Φ_w ρ/π · cos θ cos ψ/r² · V: Φ_w ρ the power that the impact reflects, θ and ψ the angles of the connection
// to the normals of impact and receiver, V its visibility (M. H. Kalos, On the Estimation of Flux at a Point by Monte
// Carlo, Nucl. Sci. Eng. 16 (1963) 111; F. J. López-Hernández et al., Opt. Eng. 39 (2000) 2775). One photon serves all
// receivers, and shadow rays from one impact are a coherent bundle. 1/r² is unbounded near surfaces: together with
// walks from the receivers, weighted by the balance heuristic, it is bounded.
//
// First flights follow a randomised quasi-Monte Carlo sequence, with a new shift for every round.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "walk/backward.hpp"
#include "walk/first_impact.hpp"
#include "walk/receiver_lanes.hpp"
#include "walk/round_plan.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

struct EmitterGroups;

class NextEvent {
 public:
  virtual ~NextEvent() = default;

  // Simulates the photons of rounds first … first + rounds − 1 and adds the mean irradiance of each round, in W/m² or
  // lx, to irradiance[(round · parts + group of emitters) · receivers.size() + number of the receiver]; parts is the number of
  // groups, 1 if none are kept apart. scores: if paths are kept, receives the light
  // with its paths; it opens and closes its rounds 0 … rounds − 1. Else null.
  virtual void simulate(const ReceiverLanes& receivers, std::uint64_t first, std::uint64_t rounds,
                        std::vector<double>& irradiance, BackwardCount& count, const Abandon& abandon,
                        ChannelScores* scores) = 0;

  // Rounds that fill a wave; at least 1.
  virtual std::uint32_t rounds_at_a_time() const = 0;

 protected:
  NextEvent() = default;
  NextEvent(const NextEvent&) = default;
  NextEvent& operator=(const NextEvent&) = default;
};

// What walks with paths need; both must outlive them.
struct ForwardPathParts {
  const FacetPlanes& planes;           // of the tracer's facets
  const std::vector<double>& delay_m;  // of Room::emitters, as a length
};

// For one thread. plan.forward: a power of two, at most batch_histories. reach: which receivers an impact serves; null:
// all. groups: of emitters that are kept apart; null: none. All references must outlive it.
std::unique_ptr<NextEvent> make_next_event(const Room& room, const Scene& scene, const DirectLight& light,
                                           const Settings& settings, const RoundPlan& plan, const ReceiverReach* reach,
                                           const EmitterGroups* groups = nullptr);
// The same with the paths of light.
std::unique_ptr<NextEvent> make_next_event(const Room& room, const Scene& scene, const DirectLight& light,
                                           const Settings& settings, const RoundPlan& plan, const ReceiverReach* reach,
                                           const ForwardPathParts& paths);

}  // namespace lichtmc
