// Points in the space of a room that light passes.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "walk/scene.hpp"

namespace lichtmc {

// A random point (m) of each of the first flights of some photons from the emitters that end on a surface; the photons
// are not absorbed. About a hundred thousand points, the same for the same scene.
std::vector<glm::dvec3> flight_points(const Scene& scene);

}  // namespace lichtmc
