#include "lichtmc/overrides.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

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

// Whether the values of each map may be lowered: those of surfaces with vertex colours must not, because the limit
// applies to the product. A map that both kinds of surfaces use is copied for those without vertex colours.
std::vector<bool> separate_maps(Room& room) {
  std::vector<bool> of_colours(room.reflectance_maps.size(), false);
  for (const Surface& surface : room.surfaces) {
    if (surface.reflectance_map && !surface.vertex_colours.empty()) of_colours[*surface.reflectance_map] = true;
  }
  std::map<std::size_t, std::size_t> copies;
  for (Surface& surface : room.surfaces) {
    if (!surface.reflectance_map || !surface.vertex_colours.empty() || !of_colours[*surface.reflectance_map]) continue;
    const auto [copy, fresh] = copies.try_emplace(*surface.reflectance_map, room.reflectance_maps.size());
    if (fresh) room.reflectance_maps.push_back(ReflectanceMap(room.reflectance_maps[*surface.reflectance_map]));
    surface.reflectance_map = copy->second;
  }
  of_colours.resize(room.reflectance_maps.size(), false);
  of_colours.flip();
  return of_colours;
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
    surface.vertex_colours.clear();
    surface.highest_reflectance = 1.0;
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
  const std::vector<bool> lowered = separate_maps(room);
  // The float at or below the limit.
  const float limit = std::nextafter(static_cast<float>(highest), 0.0F);
  for (std::size_t k = 0; k < room.reflectance_maps.size(); ++k) {
    if (!lowered[k]) continue;
    for (float& value : room.reflectance_maps[k].values) {
      if (double{value} > highest) value = limit;
    }
  }
  for (Surface& surface : room.surfaces) {
    if (above.count(&surface) == 0) continue;
    if (!surface.vertex_colours.empty()) surface.highest_reflectance = std::min(surface.highest_reflectance, highest);
    surface.reflectance = has_varying_reflectance(surface) ? mean_reflectance(room, surface) : highest;
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
