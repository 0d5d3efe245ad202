#include "inspect/topics.hpp"

#include <algorithm>

#include "base/message.hpp"
#include "inspect/finding_text.hpp"
#include "inspect/guesses.hpp"

namespace lichtmc {

glm::dvec3 upright(const Inspection& facts) {
  const glm::dvec3 size = facts.high - facts.low;
  return facts.probably_z_up ? glm::dvec3(size.x, size.z, size.y) : size;
}

void find_size(const Room& /*room*/, Inspection& facts) {
  const glm::dvec3 size = facts.high - facts.low;
  const std::string is = "The room is " + size_text(size) + " (x, height y, z)";
  if (const auto unit = guess_unit(upright(facts))) {
    add(facts, Severity::warning, "size",
        is + ", which is unusual. In " + unit->name + " it would be " + size_text(size * unit->metres) + ".",
        "If that is right, give --scale " + to_text(unit->metres) + ", or export the room in metres.");
    return;
  }
  constexpr double largest_building = 500e3;  // above it, the size of the Earth matters more than light does
  if (std::max({size.x, size.y, size.z}) > largest_building) {
    add(facts, Severity::warning, "size", is + ", which no building is.",
        "Give --scale the length of the file's unit in metres, or remove what lies far away from the room.");
    return;
  }
  constexpr double smallest_room = 1.0;
  if (std::max({size.x, size.y, size.z}) < smallest_room) {
    add(facts, Severity::warning, "size", is + ", which is small for a room.",
        "If the file is not in metres, give --scale the length of its unit in metres: for a given power of the "
        "emitters, the irradiance is proportional to 1/length².");
    return;
  }
  add(facts, Severity::note, "size", is + ".",
      "If that is wrong, give --scale the length of the file's unit in metres.");
}

void find_up_axis(const Room& /*room*/, Inspection& facts) {
  if (!facts.probably_z_up) return;
  add(facts, Severity::warning, "up-axis", "More area is perpendicular to Z than to Y: the room is probably Z-up.",
      "If it is, give --up z, or export the room with Y up.");
}

}  // namespace lichtmc
