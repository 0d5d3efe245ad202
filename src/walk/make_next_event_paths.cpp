#include "walk/next_event.hpp"
#include "walk/next_event_goal.hpp"

namespace lichtmc {

std::unique_ptr<NextEvent> make_next_event(const Room& room, const Scene& scene, const DirectLight& light,
                                           const Settings& settings, const RoundPlan& plan, const ReceiverReach* reach,
                                           const ForwardPathParts& paths) {
  return next_event_with<true>(room, scene, light, settings, plan, reach, &paths, nullptr);
}

}  // namespace lichtmc
