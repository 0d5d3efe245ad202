#include "inspect/findings.hpp"

#include "base/message.hpp"
#include "inspect/topics.hpp"

namespace lichtmc {

// Those with the greatest influence on the figures first: findings of one severity appear in this order, and a run
// repeats the first of them.
void add_findings(const Room& room, const Enclosure& enclosure, Inspection& facts) {
  find_size(room, facts);
  find_up_axis(room, facts);
  find_emitters(room, enclosure, facts);
  find_emitter_light(room, facts);
  find_luminaires(room, facts);
  find_maintenance(room, facts);
  find_seen_from_behind(room, facts);
  find_not_modelled(room, facts);
  find_faces_in_one_plane(room, facts);
  find_openings(room, facts);
  find_reflectances(room, facts);
  find_open_edges(room, facts);
  find_receivers(room, enclosure, facts);
  find_areas(room, facts);
  find_area_lights(room, facts);
  find_zero_area(room, facts);
  find_texture_coordinates(room, facts);
  find_tiles(room, facts);
  find_shape(room, facts);
}

void add_fault(const std::string& message, const std::string& topic, std::vector<Finding>& findings) {
  // The form of a message: "what is wrong (the value; allowed: …). What to do."
  const std::size_t allowed = message.find("(allowed");
  const std::size_t end = message.find(". ", allowed == std::string::npos ? 0 : allowed);
  const bool two_parts = end != std::string::npos;
  findings.push_back({Severity::fault, topic, two_parts ? message.substr(0, end + 1) : message,
                      two_parts ? message.substr(end + 2) : "Correct this."});
}

void add_non_absorbing_enclosure(const std::string& emitter, const std::string& surface,
                                 std::vector<Finding>& findings) {
  findings.push_back(
      {Severity::fault, "trapped-light",
       (emitter.empty() ? std::string("Light") : "The light of emitter " + in_quotes(emitter)) +
           " is enclosed by surfaces with reflectance 1, among them " + in_quotes(surface) + ": nothing absorbs it.",
       "Set reflectances below 1, for example with --max-reflectance 0.9; or limit the number of flights "
       "with --estimator weight --max-bounces N. If a body about a lamp should let light through, leave it out of the "
       "room."});
}

}  // namespace lichtmc
