// How a backward walk leaves its origin: see backward.hpp.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

struct OriginView {
  glm::vec3 normal{0.0F, 1.0F, 0.0F};  // world, length 1
  double least_cosine = 0.0;           // of the field of view, as in ReferencePoint
  std::optional<glm::vec3> way_out;    // as in ReferencePoint
  ReceiverLaw law = ReceiverLaw::planar;
  glm::vec3 facing{0.0F};       // as in ReferencePoint
  double least_height_m = 0.0;  // as in ReferencePoint

  double squared_sine() const { return (1.0 - least_cosine) * (1.0 + least_cosine); }
};

}  // namespace lichtmc
