#include "lichtmc/overrides.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/decimal_shift.hpp"
#include "base/message.hpp"
#include "base/names.hpp"
#include "lichtmc/error.hpp"
#include "room/reflectance.hpp"
#include "room/surface_choice.hpp"

namespace lichtmc {

namespace {

void check_reflectance(double reflectance, const std::string& what) {
  if (reflectance >= 0.0 && reflectance <= 1.0) return;
  throw InputError(what + " is " + to_text(reflectance) +
                   " (allowed: 0 to 1). Give the share of light that is reflected, for example 0.5.");
}

// Throws if a name without prefix means a material and also a surface that has another material.
void check_one_meaning(const Room& room, const SurfaceChoice& choice) {
  const auto has = [&](auto fits) { return std::find_if(room.surfaces.begin(), room.surfaces.end(), fits); };
  const auto by_material = has([&](const Surface& s) { return choice.by_material(s.material); });
  const auto by_name_only =
      has([&](const Surface& s) { return choice.by_name(s.name) && !choice.by_material(s.material); });
  if (by_material == room.surfaces.end() || by_name_only == room.surfaces.end()) return;
  throw InputError("The name " + in_quotes(choice.name) + " of --reflectance means the material " +
                   in_quotes(by_material->material) + " and also the surface " + in_quotes(by_name_only->name) +
                   ", which has another material (allowed: one of both). Give --reflectance 'material:" + choice.name +
                   "=R' or --reflectance 'surface:" + choice.name + "=R'.");
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

void set_reflectance(Room& room, const std::string& name, double reflectance) {
  const SurfaceChoice choice(name);
  check_reflectance(reflectance, "The reflectance for " + in_quotes(choice.name));
  check_one_meaning(room, choice);
  std::size_t changed = 0;
  bool by_material = false;
  for (Surface& surface : room.surfaces) {
    const bool fits = choice.by_material(surface.material);
    if (!fits && !choice.by_name(surface.name)) continue;
    by_material = by_material || fits;
    surface.reflectance = reflectance;
    surface.reflectance_source = ReflectanceSource::given;
    surface.reflectance_map.reset();
    surface.reflectance_uvs.clear();
    surface.vertex_colours.clear();
    surface.highest_reflectance = 1.0;
    ++changed;
  }
  if (changed == 0) refuse_unknown(room, choice);
  room.overrides.push_back((by_material ? "Material " : "Surface ") + in_quotes(choice.name) + ": reflectance set to " +
                           to_text(reflectance) + " on " + to_text(changed, "surface") + ".");
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

void measure_only(Room& room, const std::vector<std::string>& names) {
  for (Surface& surface : room.surfaces) surface.measured = false;
  for (const std::string& name : names) {
    const SurfaceChoice choice(name);
    bool found = false;
    for (Surface& surface : room.surfaces) {
      if (!choice.by_material(surface.material) && !choice.by_name(surface.name)) continue;
      surface.measured = true;
      found = true;
    }
    if (!found) refuse_unknown(room, choice);
  }
  const auto measured = static_cast<std::size_t>(std::count_if(
      room.surfaces.begin(), room.surfaces.end(), [](const Surface& surface) { return surface.measured; }));
  room.overrides.push_back("Only " + std::to_string(measured) + " of " + to_text(room.surfaces.size(), "surface") +
                           (measured == 1 ? " is" : " are") + " measured; the others only reflect.");
}

namespace {

// Calls change(Emitter&) for the emitters of a name or pattern; returns how many they are, 1 or more.
template <class Change>
std::size_t change_emitters(Room& room, const std::string& name, const Change& change) {
  std::size_t changed = 0;
  for (Emitter& emitter : room.emitters) {
    if (!matches_pattern(name, emitter.name)) continue;
    change(emitter);
    ++changed;
  }
  if (changed > 0) return changed;
  std::vector<std::string> names;
  for (const Emitter& emitter : room.emitters) names.push_back(emitter.name);
  throw InputError("There is no emitter " + in_quotes(name) + " in " + room.source +
                   (names.empty() ? " (allowed: none, it has no emitters). Add one first."
                                  : " (allowed, among others: " + nearest_names(name, std::move(names)) +
                                        "). Give the name of an emitter of the room, or a pattern."));
}

std::string changed_emitters(std::size_t changed, const std::string& name) {
  return (changed == 1 ? "Emitter " : to_text(changed, "emitter") + " ") + in_quotes(name);
}

}  // namespace

void set_delay(Room& room, const std::string& name, double delay_s) {
  if (!(delay_s >= 0.0) || !std::isfinite(delay_s))
    throw InputError("The delay of " + in_quotes(name) + " is " + to_text(delay_s) +
                     " s (allowed: a finite number, 0 or more). Count the delays of all emitters from the earliest "
                     "one.");
  const std::size_t changed = change_emitters(room, name, [&](Emitter& emitter) { emitter.delay_s = delay_s; });
  room.overrides.push_back(changed_emitters(changed, name) + ": delay set to " + to_text(shift_decimals(delay_s, 9)) +
                           " ns.");
}

void set_power(Room& room, const std::string& name, double power) {
  const std::string unit(power_unit(room.quantity));
  if (!(power >= 0.0) || !std::isfinite(power))
    throw InputError("The power of " + in_quotes(name) + " is " + to_text(power) + " " + unit +
                     " (allowed: a finite number, 0 or more). Give the power of one emitter when new.");
  const std::size_t changed =
      change_emitters(room, name, [&](Emitter& emitter) { emitter.power = power * emitter.maintenance_factor; });
  room.overrides.push_back(changed_emitters(changed, name) + ": power set to " + to_text(power) + " " + unit +
                           (changed == 1 ? "." : " each."));
}

std::size_t remove_emitters(Room& room, const std::string& name) {
  const std::size_t removed = change_emitters(room, name, [](Emitter&) {});
  std::erase_if(room.emitters, [&](const Emitter& emitter) { return matches_pattern(name, emitter.name); });
  room.overrides.push_back(changed_emitters(removed, name) + " removed.");
  return removed;
}

void set_maintenance_factor(Room& room, double factor) {
  if (!(factor > 0.0 && factor <= 1.0))
    throw InputError("The maintenance factor is " + to_text(factor) +
                     " (allowed: above 0 and up to 1). Give the share of the new power that the emitters keep, for "
                     "example 0.8.");
  std::size_t changed = 0;
  for (Emitter& emitter : room.emitters) {
    if (emitter.own_maintenance) continue;
    emitter.power *= factor / emitter.maintenance_factor;
    emitter.maintenance_factor = factor;
    ++changed;
  }
  if (factor == 1.0) return;
  const std::size_t own = room.emitters.size() - changed;
  const auto emitters_have = [](std::size_t n) { return to_text(n, "emitter") + (n == 1 ? " has" : " have"); };
  room.overrides.push_back("Maintenance factor " + to_text(factor) + ": " + emitters_have(changed) +
                           " this share of the new power" +
                           (own > 0 ? "; " + emitters_have(own) + " a factor of the file." : "."));
}

namespace {

struct FactorRange {
  double least = 1.0;
  double greatest = 1.0;
};

// Of emitters with a power.
FactorRange maintenance_factors(const Room& room) {
  std::optional<FactorRange> range;
  for (const Emitter& emitter : room.emitters) {
    if (!(emitter.power > 0.0)) continue;
    const double factor = emitter.maintenance_factor;
    range = range ? FactorRange{std::min(range->least, factor), std::max(range->greatest, factor)}
                  : FactorRange{factor, factor};
  }
  return range.value_or(FactorRange{});
}

}  // namespace

std::optional<double> common_maintenance_factor(const Room& room) {
  const FactorRange range = maintenance_factors(room);
  if (range.least < range.greatest) return std::nullopt;
  return range.least;
}

std::string maintained_text(const Room& room) {
  const FactorRange range = maintenance_factors(room);
  if (range.least == 1.0) return "";
  const std::string meaning = std::string(", the part of the ") +
                              (room.quantity == Quantity::photometric ? "luminous" : "radiant") +
                              " flux when new that remains";
  if (range.least == range.greatest)
    return "Maintained values: maintenance factor " + to_text(range.least) + meaning + "; initial values are " +
           short_number(1.0 / range.least) + " times as high";
  return "Maintained values: maintenance factors " + to_text(range.least) + " to " + to_text(range.greatest) + meaning;
}

namespace {

// The flux of a photometric file is an integral; nobody has given its 16 digits.
double nine_digits(double value) {
  std::array<char, 32> text{};
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 8).ptr;
  std::from_chars(text.data(), end, value);
  return value;
}

}  // namespace

void add_emitter(Room& room, Emitter emitter, Quantity quantity) {
  if (room.emitters.empty()) room.quantity = quantity;
  if (room.quantity != quantity) {
    throw InputError("The light " + in_quotes(emitter.name) + " is in " + std::string(power_unit(quantity)) +
                     ", the emitters of " + room.source + " are in " + std::string(power_unit(room.quantity)) +
                     " (allowed: one unit for all). Give its power in " + std::string(power_unit(room.quantity)) + ".");
  }
  room.overrides.push_back("Emitter " + in_quotes(emitter.name) + " added: " + to_text(nine_digits(emitter.power)) +
                           " " + std::string(power_unit(quantity)) + ".");
  room.emitters.push_back(std::move(emitter));
}

}  // namespace lichtmc
