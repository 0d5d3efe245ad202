#include "inspect/topics.hpp"

#include <algorithm>
#include <cmath>

#include "base/message.hpp"
#include "inspect/finding_text.hpp"

namespace lichtmc {

namespace {

// Where the flights that left did so.
std::string places_of(const Inspection& facts) {
  std::string where;
  for (const Opening& opening : facts.openings) {
    where += (where.empty() ? "" : "; ") + in_percent(opening.share) + " of them through the side " + opening.side +
             ", the first at " + text_of(opening.place) + " m";
    if (!opening.from.empty()) where += " from " + in_quotes(opening.from);
  }
  return where;
}

// Area-weighted.
double mean_reflectance(const Inspection& facts) {
  double area = 0.0;
  double reflecting = 0.0;
  for (const SurfaceFacts& surface : facts.surfaces) {
    area += surface.area_m2;
    reflecting += surface.area_m2 * surface.reflectance;
  }
  return area > 0.0 ? reflecting / area : 0.0;
}

// Whether openings change the figures noticeably. If a flight leaves with probability s, the mean irradiance is
// 1 − ρ over 1 − ρ + s of that in a closed room, so s changes it by at most s/(1 − ρ). s is the lower end of the 95 %
// interval of Poisson's law for n flights, about n − 2√n and never above n: a few rays that slip through where corners
// of neighbouring meshes are rounded are not an opening.
bool light_leaves(const Inspection& facts) {
  constexpr double noticeable = 1e-3;  // a tenth of the standard error of 1 %
  const auto left = static_cast<double>(facts.flights_that_left);
  const double least = std::max(0.0, left - 2.0 * std::sqrt(left)) / static_cast<double>(facts.flights);
  return least > noticeable * (1.0 - mean_reflectance(facts));
}

}  // namespace

void find_openings(const Room& /*room*/, Inspection& facts) {
  if (facts.flights == 0) {
    if (!facts.inside_is_sure)
      add(facts, Severity::note, "openings", "Whether light leaves the room is not known.",
          "The geometry does not tell where the inside is: add an emitter, and check again.");
    return;
  }
  const std::string flights = to_text(facts.flights, "flight") + " of light";
  if (facts.flights_that_left == 0) {
    add(facts, Severity::note, "openings", "None of " + flights + " left the room.",
        "Nothing to do. If the room has an open window or door, model the opening.");
    return;
  }
  if (!light_leaves(facts)) {
    add(facts, Severity::note, "openings",
        std::to_string(facts.flights_that_left) + " of " + flights + " left the room: " + places_of(facts) + ".",
        facts.open_edges > 0
            ? "Nothing to do: the figures change by less than 0.1 %. Light leaves between meshes that do not quite "
              "meet."
            : "Nothing to do: the figures change by less than 0.1 %.");
    return;
  }
  const double share = static_cast<double>(facts.flights_that_left) / static_cast<double>(facts.flights);
  add(facts, Severity::warning, "openings",
      in_percent(share) + " of " + flights + " leave the room: " + places_of(facts) + ".",
      "Light that leaves does not return. If there is no window, door or open side, close the room there.");
}

void find_open_edges(const Room& /*room*/, Inspection& facts) {
  if (facts.open_edges == 0) return;
  Names places;
  for (const glm::dvec3& p : facts.open_edge_places) places.add(text_of(p));
  const bool leaks = facts.flights > 0 && light_leaves(facts);
  add(facts, leaks ? Severity::warning : Severity::note, "open-edges",
      to_text(facts.open_edges, "edge") + (facts.open_edges == 1 ? " belongs" : " belong") +
          " to only one triangle, the first at " + places.text() + " m: borders of open meshes, holes, or T-junctions.",
      leaks ? "If light should not leave there, join the meshes (in Blender: Merge by Distance, Fill)."
            : "Nothing to do: hardly any light left the room through them.");
}

void find_shape(const Room& /*room*/, Inspection& facts) {
  if (facts.cuboid) {
    add(facts, Severity::note, "shape", "The room is an empty cuboid.", "Nothing to do: impacts have a closed form.");
    return;
  }
  if (facts.flights == 0 && !facts.inside_is_sure) return;  // `closed` is not known
  const std::string closed =
      facts.closed ? "The room is closed" : "The room is not closed, or not all emitters are inside";
  add(facts, Severity::note, "shape", closed + "; it is " + (facts.convex ? "convex (no shadows)." : "not convex."),
      "Nothing to do.");
}

}  // namespace lichtmc
