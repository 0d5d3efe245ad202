#include "walk/next_event.hpp"

#include "walk/next_event_goal.hpp"

namespace lichtmc {

std::unique_ptr<NextEvent> make_next_event(const Room& room, const Scene& scene, const DirectLight& light,
                                           const Settings& settings, const RoundPlan& plan,
                                           const ReceiverReach* reach,
                                           const EmitterGroups* groups) {
  return next_event_with<false>(room, scene, light, settings, plan, reach, nullptr, groups);
}

}  // namespace lichtmc
