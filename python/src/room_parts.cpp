#include "room_parts.hpp"

namespace lichtmc::python {

Room room_for_checks(const Room& like) {
  Room room;
  room.source = like.source;
  room.quantity = like.quantity;
  Surface triangle;
  triangle.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  triangle.triangles = {{0, 1, 2}};
  room.surfaces.push_back(std::move(triangle));
  room.emitters.push_back({"", 1.0, IsotropicEmitter{}});
  return room;
}

std::vector<std::string> texts_of(const std::vector<Ignored>& ignored) {
  std::vector<std::string> texts;
  for (const Ignored& one : ignored) texts.push_back(one.what);
  return texts;
}

}  // namespace lichtmc::python
