// The names of the values of settings and results.
#include <cmath>

#include "lichtmc/result.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

std::string_view to_string(Estimator estimator) {
  switch (estimator) {
    case Estimator::weight:
      return "weight";
    case Estimator::collision:
      return "collision";
    case Estimator::absorption:
      return "absorption";
    case Estimator::automatic:
      return "auto";
  }
  return "";
}

std::string_view to_string(Engine engine) {
  switch (engine) {
    case Engine::automatic:
      return "auto";
    case Engine::cuboid:
      return "cuboid";
    case Engine::embree:
      return "embree";
    case Engine::embree_fast:
      return "embree-fast";
  }
  return "";
}

std::string_view to_string(Measured measured) {
  switch (measured) {
    case Measured::all:
      return "all";
    case Measured::tiles:
      return "tiles";
    case Measured::receivers:
      return "receivers";
  }
  return "";
}

std::string_view to_string(ReceiverWalk walk) {
  switch (walk) {
    case ReceiverWalk::automatic:
      return "auto";
    case ReceiverWalk::two_way:
      return "two-way";
    case ReceiverWalk::next_event:
      return "next-event";
    case ReceiverWalk::backward:
      return "backward";
  }
  return "";
}

std::string_view to_string(Direct direct) {
  return direct == Direct::sampled ? "sampled" : "analytic";
}

std::string_view to_string(WalkDirection direction) {
  return direction == WalkDirection::forward ? "forward" : "backward";
}

std::string_view to_string(StopReason reason) {
  switch (reason) {
    case StopReason::photons:
      return "photons";
    case StopReason::target_error:
      return "target-error";
    case StopReason::max_time:
      return "max-time";
    case StopReason::interrupt:
      return "interrupt";
  }
  return "";
}

bool direct_is_apart(const Result& result) {
  return !result.tiles.empty() && !std::isnan(result.tiles.front().direct);
}

}  // namespace lichtmc
