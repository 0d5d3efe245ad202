#include "lichtmc/overrides.hpp"

#include <cmath>
#include <set>
#include <utility>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "room/reflectance.hpp"

namespace lichtmc {

namespace {

void check_reflectance(double reflectance, const std::string& what) {
  if (reflectance >= 0.0 && reflectance <= 1.0) return;
  throw InputError(what + " is " + to_text(reflectance) +
                   " (allowed: 0 to 1). Give the share of light that is reflected, for example 0.5.");
}

std::string materials_of(const Room& room) {
  std::set<std::string> names;
  for (const Surface& surface : room.surfaces) names.insert(in_quotes(surface.material));
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

void set_reflectance(Room& room, const std::string& material, double reflectance) {
  check_reflectance(reflectance, "The reflectance for material " + in_quotes(material));
  std::size_t changed = 0;
  for (Surface& surface : room.surfaces) {
    if (surface.material != material) continue;
    surface.reflectance = reflectance;
    surface.reflectance_source = ReflectanceSource::given;
    surface.reflectance_map.reset();
    surface.reflectance_uvs.clear();
    ++changed;
  }
  if (changed == 0) {
    throw InputError("There is no material " + in_quotes(material) + " in " + room.source + " (it has " +
                     materials_of(room) + "). Give one of these names.");
  }
  room.overrides.push_back("Material " + in_quotes(material) + ": reflectance set to " + to_text(reflectance) + " on " +
                           to_text(changed, "surface") + ".");
}

void limit_reflectance(Room& room, double highest) {
  check_reflectance(highest, "The highest reflectance");
  std::set<const Surface*> above;
  const HighestReflectance of_room(room);
  for (Surface& surface : room.surfaces) {
    if (of_room.of(surface) > highest) above.insert(&surface);
  }
  if (above.empty()) return;
  // The float at or below the limit.
  const float limit = std::nextafter(static_cast<float>(highest), 0.0F);
  for (ReflectanceMap& reflectance_map : room.reflectance_maps) {
    for (float& value : reflectance_map.values) {
      if (double{value} > highest) value = limit;
    }
  }
  for (Surface& surface : room.surfaces) {
    if (above.count(&surface) == 0) continue;
    surface.reflectance = surface.reflectance_map ? mean_reflectance(room, surface) : highest;
  }
  room.overrides.push_back("Reflectances above " + to_text(highest) + " lowered to it on " +
                           to_text(above.size(), "surface") + ".");
}

void add_emitter(Room& room, Emitter emitter, Quantity quantity) {
  if (room.emitters.empty()) room.quantity = quantity;
  if (room.quantity != quantity) {
    throw InputError("The light " + in_quotes(emitter.name) + " is in " + std::string(power_unit(quantity)) +
                     ", the emitters of " + room.source + " are in " + std::string(power_unit(room.quantity)) +
                     " (allowed: one unit for all). Give its power in " + std::string(power_unit(room.quantity)) + ".");
  }
  room.overrides.push_back("Emitter " + in_quotes(emitter.name) + " added: " + to_text(emitter.power) + " " +
                           std::string(power_unit(quantity)) + ".");
  room.emitters.push_back(std::move(emitter));
}

}  // namespace lichtmc
