#include <algorithm>

#include "base/message.hpp"
#include "inspect/finding_text.hpp"
#include "inspect/topics.hpp"

namespace lichtmc {

namespace {

// Luminaires let out 40 % to 95 % of the light of their lamps, hardly any less than a third.
constexpr double most_in_a_luminaire = 2.0 / 3.0;
// Light that a closed body holds back, but for the photons that are still in flight after the last one of the probe.
constexpr double all = 0.98;
// Light between a ceiling and what hangs close below it. A lamp that lights a ceiling of reflectance 0.5 from below
// loses half of its light there.
constexpr double nearly_all = 0.9;

// What happens to the light of an emitter that gets nowhere, as the end of a sentence that begins with its name; empty
// if it gets into the room.
std::string fate_of(const EmitterFacts& facts) {
  const std::string first = facts.first_surface.empty()
                                ? std::string()
                                : ", most of it on " + in_quotes(facts.first_surface) +
                                      (facts.first_behind > 0.5 ? ", on the back of its faces" : "");
  if (facts.absorbed_itself >= all)
    return "is shut in: " + in_percent(facts.absorbed_itself) +
           " of its light is absorbed by its own surface, which is " + "closed and shines into itself";
  if (facts.first_behind >= all && facts.absorbed_wide >= all && facts.absorbed_about < all)
    return "is shut in: " + in_percent(facts.absorbed_wide) + " of its light is absorbed within " +
           short_number(facts.wide_m) + " m" + first;
  if (facts.absorbed_about >= all)
    return "is shut in: " + in_percent(facts.absorbed_about) + " of its light is absorbed within " +
           short_number(facts.about_m) + " m" + first;
  if (facts.absorbed_near > most_in_a_luminaire)
    return "lights hardly more than what is next to it: " + in_percent(facts.absorbed_near) +
           " of its light is absorbed within " + short_number(facts.near_m) + " m" + first;
  if (facts.absorbed_level >= nearly_all)
    return "lights hardly more than a low gap: " + in_percent(facts.absorbed_level) +
           " of its light is absorbed no more than " + short_number(facts.level_m) + " m above or below it" + first;
  return {};
}

}  // namespace

void find_emitter_light(const Room& /*room*/, Inspection& facts) {
  const char* const advice =
      "If it should light the room, turn its faces over (in Blender: Mesh, Normals, Flip; a Plane looks up), move it "
      "away from that surface, or take away the body about it.";
  Names names;
  std::string first;
  for (const EmitterFacts& emitter : facts.emitters) {
    const std::string fate = fate_of(emitter);
    if (fate.empty()) continue;
    if (first.empty()) first = "Emitter " + in_quotes(emitter.name) + " " + fate;
    names.add(in_quotes(emitter.name));
  }
  if (names.count() == 0) return;
  const std::string others =
      names.count() > 1 ? " In all, " + to_text(names.count(), "emitter") + " do so: " + names.text() + "." : "";
  add(facts, Severity::warning, "emitter-light", first + "." + others, advice);
}

}  // namespace lichtmc
