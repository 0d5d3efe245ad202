// The histories of a round: a unit of work whose score is one sample of the statistics, for every origin.
#pragma once

#include <cstdint>

#include "base/fields.hpp"

namespace lichtmc {

// forward: histories from the emitters, which serve all origins, a power of two or 0; backward: walks from every origin.
// At least one of the two is above 0. Where both are, their contributions are combined by the balance heuristic.
struct RoundPlan {
  std::uint32_t forward = 0;
  std::uint32_t backward = 1;

  // Every origin has them all.
  std::uint64_t histories(std::uint64_t origins) const { return (forward + backward) * origins; }
  bool operator==(const RoundPlan&) const = default;
  bool two_way() const { return forward > 0 && backward > 0; }
  // Forward histories for each walk from an origin.
  double forward_per_walk() const { return static_cast<double>(forward) / backward; }
};

// The largest rounds of receivers.
inline constexpr std::uint32_t most_forward = 1024;  // photons of a wave
inline constexpr std::uint32_t most_backward = 1024;

constexpr bool is_receiver_plan(const RoundPlan& plan) {
  return plan.forward <= most_forward && (plan.forward & (plan.forward - 1)) == 0 && plan.backward <= most_backward &&
         plan.forward + plan.backward > 0;
}

template <class F, AllOf<RoundPlan>... Things>
void visit_fields(const F& f, Things&... plan) {
  f(Field{"forward", FieldRole::same}, plan.forward...);
  f(Field{"backward", FieldRole::same}, plan.backward...);
}

}  // namespace lichtmc
