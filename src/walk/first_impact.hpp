// The two ends of a path: how likely photons from the emitters, and walks from a receiver, are to make it.
//
// A path leads from a point x₀ of an emitter over the impacts x₁ … x_k to a receiver. Both walks draw the flights
// between impacts by Lambert's law; their densities are equal in both directions and cancel, as do reflectances, which
// are in the scores. So the balance heuristic (E. Veach, L. Guibas, Optimally Combining Sampling Techniques for Monte
// Carlo Rendering, SIGGRAPH 1995) needs the densities of the ends only:
//   forward   p_F = e/ΣΦ: e the irradiance at x₁ by the point emitter, without shadows; by an area light, per area at x₀
//   backward  p_r(x_k) · q_i for a point emitter: q_i is the probability that a light sample at x₁ chooses emitter i
//             p_r(x_k) · [q_i p_L(x₀) + p_hit(x₀)] for an area light: its point is sampled, or hit by a flight
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lichtmc/room.hpp"
#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"
#include "walk/direct_light.hpp"

namespace lichtmc {

// Where a photon starts on an area light.
struct StartOnFacet {
  std::uint32_t facet = no_facet;
  float s = 0.0F;
  float t = 0.0F;
};

class FirstImpact {
 public:
  // Room, tracer and light must outlive this.
  FirstImpact(const Room& room, const Tracer& tracer, const DirectLight& light);

  // [q_i] / p_F or [q_i p_L + p_hit] / p_F, in m², for flight i of a wave, the first of a photon of an emitter (an index
  // into Room::emitters), which started at `from` and has hit a surface.
  double backward_over_forward(std::size_t emitter, const StartOnFacet& from, const Rays& rays, std::size_t i) const;

 private:
  double of_area_light(const AreaLight& light, double q, const StartOnFacet& from, const FlightGeometry& flight,
                       double cosine_here) const;

  const Tracer* tracer_;
  const DirectLight* light_;
  double power_;  // ΣΦ, W or lm
};

}  // namespace lichtmc
