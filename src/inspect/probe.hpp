// Light sent through a room to see where it gets: never absorbed, and not measured.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/inspect.hpp"
#include "lichtmc/room.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

struct ProbeResult {
  std::uint64_t flights = 0;
  std::uint64_t left = 0;       // flights that met no surface
  std::uint64_t undecided = 0;  // flights that ended where no rule decides between faces in one plane
  std::vector<Opening> openings;
  std::vector<std::uint64_t> impacts;      // per surface
  std::vector<std::uint64_t> behind;       // per surface, those that came from behind
  std::vector<EmitterFacts> emitters;      // as Inspection::emitters
  std::vector<LuminaireFacts> luminaires;  // as Inspection::luminaires
};

// Follows light from the scene's emitters over some reflections.
ProbeResult probe(const Room& room, const Scene& scene, const glm::dvec3& low, const glm::dvec3& high);

}  // namespace lichtmc
