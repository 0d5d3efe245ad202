// The histories of a round: a unit of work whose score is one sample of the statistics, for every origin.
#pragma once

#include <cstdint>

#include "base/fields.hpp"

namespace lichtmc {

// forward: histories from the emitters, which serve all origins; backward: walks from every origin. At least one of the
// two is above 0. Where both are, their contributions are combined by the balance heuristic.
struct RoundPlan {
  std::uint32_t forward = 0;
  std::uint32_t backward = 1;

  std::uint64_t histories(std::uint64_t origins) const { return forward + backward * origins; }
  bool two_way() const { return forward > 0 && backward > 0; }
  // Forward histories for each walk from an origin.
  double forward_per_walk() const { return static_cast<double>(forward) / backward; }
};

template <class F, AllOf<RoundPlan>... Things>
void visit_fields(const F& f, Things&... plan) {
  f(Field{"forward", FieldRole::same}, plan.forward...);
  f(Field{"backward", FieldRole::same}, plan.backward...);
}

}  // namespace lichtmc
