#include "inspect/topics.hpp"

#include <algorithm>
#include <cmath>

#include "base/message.hpp"
#include "inspect/finding_text.hpp"
#include "run/warnings.hpp"

namespace lichtmc {

namespace {

// A lamp, in the coordinates that the room has with the other options that are proposed.
std::string lamp_proposal(const Room& room, const Inspection& facts) {
  glm::dvec3 place = facts.inside;
  std::string options;
  if (facts.suggested_scale != 1.0) options += " --scale " + to_text(facts.suggested_scale);
  if (facts.probably_z_up) {
    place = {place.x, place.z, -place.y};
    options += " --up z";
  }
  const std::string light = "--light point:" + coordinates(facts.suggested_scale * place, ",") + ":1000lm";
  if (options.empty()) return ", for example at a point inside the room: " + light + ".";
  return ", for example, together with the unit and axis that are proposed below: lichtmc run " + room.source +
         options + " " + light + ".";
}

}  // namespace

void find_emitters(const Room& room, const Enclosure& enclosure, Inspection& facts) {
  // Extends the advice of check_room() by a possible position.
  const auto fault = std::find_if(facts.findings.begin(), facts.findings.end(),
                                  [](const Finding& f) { return f.topic == "emitters"; });
  if (room.emitters.empty() && fault != facts.findings.end()) {
    fault->advice = "Add a point or spot light or an emissive material to the room, or give --light" +
                    (facts.inside_is_sure ? lamp_proposal(room, facts)
                                          : " with a point inside the room: --light point:X,Y,Z:1000lm. The geometry "
                                            "does not tell where the inside is.");
  }
  for (const Advised& outside : emitters_outside(room, &enclosure))
    add(facts, Severity::warning, "emitters", outside.what, outside.advice);
  Names dark;
  for (const Emitter& emitter : room.emitters) {
    if (emitter.power == 0.0) dark.add(in_quotes(emitter.name));
  }
  if (dark.count() > 0) {
    add(facts, Severity::warning, "emitters", to_text(dark.count(), "emitter") + " with power 0: " + dark.text() + ".",
        "Set the intensity or strength, or the custom property 'power'; or remove the emitters.");
  }
  const glm::dvec3 size = facts.high - facts.low;
  const double power = total_power(room);
  const double mean = power / (size.x * size.z);
  if (room.quantity != Quantity::photometric || !(power > 0.0) || !std::isfinite(mean)) return;
  // Luminous flux per floor area in lm/m²: a night light to full daylight; offices have some 10³.
  constexpr double least = 1.0;
  constexpr double most = 1e5;
  if (mean >= least && mean <= most) return;
  add(facts, Severity::warning, "emitters",
      "The total luminous flux of the emitters is " + short_number(power) + " lm, " + short_number(mean) +
          " lm for every square metre of floor; rooms usually have some hundreds.",
      "Check the emitters: glTF gives the intensity of lights in cd and the luminance of emissive materials in cd/m². "
      "The custom property 'power' gives the luminous flux in lm.");
}

void find_maintenance(const Room& room, Inspection& facts) {
  Names without;
  for (const Emitter& emitter : room.emitters) {
    if (!emitter.own_maintenance && emitter.maintenance_factor == 1.0) without.add(in_quotes(emitter.name));
  }
  const std::size_t with = room.emitters.size() - without.count();
  if (with == 0 || without.count() == 0) return;
  add(facts, Severity::warning, "maintenance",
      to_text(with, "emitter") + (with == 1 ? " has" : " have") + " a maintenance factor, " +
          to_text(without.count(), "emitter") + (without.count() == 1 ? " has" : " have") +
          " none, so that the figures are neither maintained nor initial values: " + without.text() + ".",
      "Set the custom property 'maintenance_factor' of the others too, 1 if they lose nothing, or give "
      "--maintenance-factor for them.");
}

void find_receivers(const Room& room, const Enclosure& enclosure, Inspection& facts) {
  if (room.receivers.empty()) return;
  add(facts, Severity::note, "receivers",
      to_text(room.receivers.size(), "receiver") + ", the first is " + in_quotes(room.receivers.front().name) + ".",
      "A run computes the " + std::string(irradiance_word(room.quantity)) + " of the tiles and at the receivers.");
  for (const Advised& outside : receivers_outside(room, &enclosure))
    add(facts, Severity::warning, "receivers", outside.what, outside.advice);
}

}  // namespace lichtmc
