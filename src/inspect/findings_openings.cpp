#include "inspect/topics.hpp"

#include "base/message.hpp"
#include "inspect/finding_text.hpp"

namespace lichtmc {

void find_openings(const Room& /*room*/, Inspection& facts) {
  if (facts.flights == 0) return;
  if (facts.flights_that_left == 0) {
    add(facts, Severity::note, "openings",
        "None of " + std::to_string(facts.flights) + " flights of light left the room.",
        "Nothing to do. If the room has an open window or door, model the opening.");
    return;
  }
  const double share = static_cast<double>(facts.flights_that_left) / static_cast<double>(facts.flights);
  std::string where;
  for (const Opening& opening : facts.openings) {
    where += (where.empty() ? "" : "; ") + in_percent(opening.share) + " of them through the side " + opening.side +
             ", the first at " + text_of(opening.place) + " m";
    if (!opening.from.empty()) where += " from " + in_quotes(opening.from);
  }
  add(facts, Severity::warning, "openings",
      in_percent(share) + " of " + std::to_string(facts.flights) + " flights of light leave the room: " + where + ".",
      "Light that leaves does not return. If there is no window, door or open side, close the room there.");
}

void find_open_edges(const Room& /*room*/, Inspection& facts) {
  if (facts.open_edges == 0) return;
  Names places;
  for (const glm::dvec3& p : facts.open_edge_places) places.add(text_of(p));
  const bool leaks = facts.flights_that_left > 0;
  add(facts, leaks ? Severity::warning : Severity::note, "open-edges",
      to_text(facts.open_edges, "edge") + (facts.open_edges == 1 ? " belongs" : " belong") +
          " to only one triangle, the first at " + places.text() + " m: borders of open meshes, holes, or T-junctions.",
      leaks ? "If light should not leave there, join the meshes (in Blender: Merge by Distance, Fill)."
            : "Nothing to do: no light left the room through them.");
}

void find_shape(const Room& /*room*/, Inspection& facts) {
  if (facts.cuboid) {
    add(facts, Severity::note, "shape", "The room is an empty cuboid.", "Nothing to do: impacts have a closed form.");
    return;
  }
  const std::string closed =
      facts.closed ? "The room is closed" : "The room is not closed, or not all emitters are inside";
  add(facts, Severity::note, "shape", closed + "; it is " + (facts.convex ? "convex (no shadows)." : "not convex."),
      "Nothing to do.");
}

}  // namespace lichtmc
