#include <cassert>

#include "walk/backward_goal.hpp"

namespace lichtmc {

std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const CellOrigins& origins, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan,
                                                 const EmitterGroups* groups) {
  assert(plan.backward > 0);
  return walk_from<false>(scene, light, origins, scale, settings, plan, nullptr, groups);
}

std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light,
                                                 const ReceiverOrigins& origins, const BackwardScale& scale,
                                                 const Settings& settings, const RoundPlan& plan,
                                                 const EmitterGroups* groups) {
  assert(plan.backward > 0);
  return walk_from<false>(scene, light, origins, scale, settings, plan, nullptr, groups);
}

std::unique_ptr<BackwardWalk> make_backward_walk(const Scene& scene, const DirectLight& light, const TileFaces& origins,
                                                 const BackwardScale& scale, const Settings& settings) {
  return walk_from<false>(scene, light, origins, scale, settings, {.forward = 0, .backward = TileFaces::group});
}

}  // namespace lichtmc
