#include "walk/emitter_groups.hpp"

#include <algorithm>
#include <utility>

namespace lichtmc {

namespace {

// Emitters of the same name, as far as names count, and the same maintenance factor, as far as that counts.
EmitterGroups groups_by(const Room& room, bool by_name, bool by_maintenance) {
  EmitterGroups groups;
  std::vector<std::pair<std::string, double>> keys;
  for (const Emitter& emitter : room.emitters) {
    const std::pair<std::string, double> key(by_name ? emitter.name : "all",
                                             by_maintenance ? emitter.maintenance_factor : 1.0);
    const auto found = std::find(keys.begin(), keys.end(), key);
    groups.of_emitter.push_back(static_cast<std::uint32_t>(found - keys.begin()));
    if (found != keys.end()) continue;
    keys.push_back(key);
    groups.names.push_back(key.first);
  }
  return groups;
}

}  // namespace

EmitterGroups one_group(const Room& room) {
  return groups_by(room, false, false);
}

EmitterGroups groups_by_name(const Room& room) {
  return groups_by(room, true, false);
}

EmitterGroups groups_of_parts(const Room& room, const Settings& settings) {
  if (settings.channel.wanted()) return one_group(room);
  return groups_by(room, settings.per_emitter, true);
}

bool wants_parts(const Room& room, const Settings& settings) {
  return settings.per_emitter || !room.areas.empty();
}

}  // namespace lichtmc
