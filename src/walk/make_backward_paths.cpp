#include <cassert>

#include "walk/backward_goal.hpp"

namespace lichtmc {

std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const ReceiverOrigins& origins, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan,
                                                 const FacetPlanes& planes) {
  assert(plan.backward > 0);
  return walk_from<true>(scene, light, origins, scale, settings, plan, &planes);
}

}  // namespace lichtmc
