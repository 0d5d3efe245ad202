#include "output/report_origin.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/overrides.hpp"
#include "lichtmc/units.hpp"
#include "lichtmc/version.hpp"
#include "output/html.hpp"
#include "output/json.hpp"
#include "output/luminaire_schedule.hpp"
#include "output/readable.hpp"
#include "room/emitter_place.hpp"
#include "room/settings_fields.hpp"

namespace lichtmc {

namespace {

std::string receiver_walk_text(const WalkReport& walk) {
  switch (walk.receiver_walk) {
    case ReceiverWalk::next_event:
      return "by photons from the emitters, whose impacts contribute to every receiver";
    case ReceiverWalk::backward:
      return "by backward walks from the receivers";
    default:
      break;
  }
  return "by photons from the emitters and backward walks from the receivers, " +
         std::to_string(walk.photons_per_round) + " : " + std::to_string(walk.walks_per_round);
}

// What was asked for, setting by setting.
std::string settings_table(const Settings& settings) {
  std::string rows;
  visit_fields(
      [&rows](const Field& field, const auto& value) {
        if (field.role == FieldRole::machine) return;
        std::string text = setting_text(value);
        if (*field.unit != '\0' && text != "none") text += std::string(" ") + field.unit;
        rows += "<tr>" + text_cell(field.label) + text_cell(text) + text_cell(field.option) + "</tr>\n";
      },
      settings);
  return text_element("p", "Settings as asked for:") +
         element("table", table_head({"setting", "value", "option"}) + element("tbody", rows), " id=\"settings\"");
}

// Emitters without a photometric file: the others are in the luminaire schedule.
std::string emitters_table(const Room& room) {
  const std::string unit(power_unit(room.quantity));
  const bool aged = !maintained_text(room).empty();
  std::string rows;
  for (const Emitter& e : room.emitters) {
    if (photometry_of(e) != nullptr) continue;
    rows += "<tr>" + text_cell(e.name) + text_cell(kind_of(e)) + flux_cell(e.power) +
            (aged ? number_cell(e.maintenance_factor) + flux_cell(e.power / e.maintenance_factor) : std::string()) +
            "</tr>\n";
  }
  const std::string power = std::string(power_word(room.quantity));
  const std::string heads =
      aged ? table_head({"emitter", "kind", power + ", " + unit, "maintenance factor", power + " when new, " + unit})
           : table_head({"emitter", "kind", power + ", " + unit});
  if (rows.empty()) return {};
  return heading(luminaire_schedule(room).empty() ? "Emitters" : "Emitters without a photometric file") +
         element("table", heads + element("tbody", rows), " class=\"sortable\" id=\"emitters\"");
}

}  // namespace

std::string settings_section(const Room& room, const Result& result, bool tile_images) {
  const Settings& s = result.settings;
  std::string rows;
  const auto row = [&rows](std::string_view name, const std::string& value) {
    rows += "<tr>" + text_cell(name) + text_cell(value) + "</tr>\n";
  };
  row("estimator",
      std::string(to_string(result.tiles.empty() ? result.receiver_walk.estimator : result.walk.estimator)));
  row("engine", std::string(to_string(result.engine)));
  if (!result.tiles.empty()) {
    row("tiles measured",
        s.tile_walk == WalkDirection::forward ? "by photons from the emitters" : "by backward walks from the tiles");
    row("direct light", direct_is_apart(result) ? "integrated" : "counted with all other light");
    row("photons", std::to_string(result.walk.histories));
    row("impacts", std::to_string(result.walk.impacts));
    row("ended by", std::string(to_string(result.walk.stopped_by)));
    if (!tile_images) row("tile maps as images", "not written, as asked for (--no-images)");
  }
  if (!result.receiver_results.empty()) {
    row("receivers measured", receiver_walk_text(result.receiver_walk));
    row("estimator (receivers)", std::string(to_string(result.receiver_walk.estimator)));
    row("histories (receivers)", std::to_string(result.receiver_walk.histories));
    row("ended by (receivers)", std::string(to_string(result.receiver_walk.stopped_by)));
  }
  row("threads", std::to_string(result.threads));
  std::string html = heading("What was simulated") + element("table", rows, " class=\"whole\"") + settings_table(s);
  if (!result.choices.empty()) html += list_of(result.choices);
  if (!result.overrides.empty()) html += text_element("p", "Changed after reading:") + list_of(result.overrides);
  return html + emitters_table(room);
}

std::string left_out_section(const Result& result) {
  std::vector<std::string> sentences;
  for (const Ignored& thing : result.ignored)
    sentences.push_back(thing.what + (thing.effect == Effect::figures ? " (may change figures)" : ""));
  if (sentences.empty()) return {};
  return heading("In the file, but not modelled") + list_of(sentences);
}

std::string reproduction_section(const Result& result, const std::string& command) {
  std::string html = heading("To reproduce this");
  if (!command.empty()) html += text_element("pre", command);
  std::vector<std::string> repeats;
  for (const Measured what : {Measured::tiles, Measured::receivers}) {
    if (std::string options = options_to_repeat(result, what); !options.empty()) repeats.push_back(std::move(options));
  }
  if (!repeats.empty()) {
    html += text_element("p",
                         "The clock ended this run, and clocks differ. To get the same figures to the last digit give, "
                         "in place of --photons, --target-error, --max-time and --estimator:") +
            list_of(repeats);
  }
  return html + text_element("p",
                             "lichtmc " + std::string(version()) +
                                 ". The same room, settings, seed and number of photons give the same figures to the "
                                 "last digit, for any number of threads.",
                             " class=\"muted\"");
}

}  // namespace lichtmc
