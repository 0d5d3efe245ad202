#include <cmath>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

TEST_CASE("a frame is orthonormal for every normal") {
  for (const glm::dvec3& raw :
       {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1e-9, 0, -1), glm::dvec3(0, 1e-17, -1),
        glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0.3, -0.5, 0.8), glm::dvec3(1, 1, -0.0)}) {
    const glm::dvec3 normal = glm::normalize(raw);
    const Frame frame = frame_about(normal);
    // Sums of three products of numbers up to 1: some roundings of 2⁻⁵³.
    constexpr double roundings = 8.0 * 0x1p-53;
    CHECK(std::abs(glm::dot(frame.tangent, frame.bitangent)) < roundings);
    CHECK(std::abs(glm::dot(frame.tangent, normal)) < roundings);
    CHECK(std::abs(glm::dot(frame.bitangent, normal)) < roundings);
    CHECK(std::abs(glm::length(frame.tangent) - 1.0) < roundings);
    CHECK(glm::length(glm::cross(frame.tangent, frame.bitangent) - normal) < roundings);
  }
}
