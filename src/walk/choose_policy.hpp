// The choice of an estimator, in one place: from settings to the policies that the kernel is compiled with.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>

#include "lichtmc/settings.hpp"
#include "walk/estimators.hpp"
#include "walk/kernel.hpp"

namespace lichtmc {

// Calls make.operator()<Policy, Reflectance>(max_flights) for an estimator (not Estimator::automatic, which is resolved
// before) and returns what that returns. max_bounces: flights after which a history of the weight estimator ends; none:
// Russian roulette. max_flights 0: no limit. mapped: the room has reflectance maps.
template <class Make>
auto choose_policy(Estimator estimator, std::optional<std::uint32_t> max_bounces, bool mapped, const Make& make) {
  const auto with = [&]<class Policy, class MappedPolicy>(std::uint32_t max_flights) {
    return mapped ? make.template operator()<MappedPolicy, MappedReflectance>(max_flights)
                  : make.template operator()<Policy, SurfaceReflectance>(max_flights);
  };
  assert(estimator != Estimator::automatic);
  switch (estimator) {
    case Estimator::collision:
      return with.template operator()<CollisionPolicy, CollisionPolicy>(0);
    case Estimator::absorption:
      return with.template operator()<AbsorptionPolicy, MappedAbsorptionPolicy>(0);
    case Estimator::weight:
    case Estimator::automatic:
      break;
  }
  if (max_bounces) return with.template operator()<TruncatedWeightPolicy, TruncatedWeightPolicy>(*max_bounces);
  return with.template operator()<RouletteWeightPolicy, RouletteWeightPolicy>(0);
}

// The interpretation of the scores of an estimator.
inline ScoreLaw score_law(Estimator estimator, bool mapped) {
  return choose_policy(estimator, std::nullopt, mapped,
                       []<class Policy, class Reflectance>(std::uint32_t /*max_flights*/) { return Policy::law; });
}

}  // namespace lichtmc
