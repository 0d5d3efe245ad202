#include "inspect/topics.hpp"

#include <cmath>
#include <optional>

#include "base/message.hpp"
#include "inspect/finding_text.hpp"
#include "room/emitter_shape.hpp"
#include "run/cover_warnings.hpp"
#include "run/warnings.hpp"

namespace lichtmc {

namespace {

// Whether most light arrives on the back of a one-sided surface. Of n impacts, half fall on the back with a standard
// deviation of √n/2 if both sides receive the same; four of them are exceeded once in 30 000 surfaces. Small surfaces
// with few impacts are not judged.
bool receives_from_behind(const SurfaceFacts& surface) {
  const auto n = static_cast<double>(surface.impacts);
  return surface.sides == Sides::one && surface.seen_from_behind * n > 0.5 * n + 2.0 * std::sqrt(n);
}

}  // namespace

void find_seen_from_behind(const Room& room, Inspection& facts) {
  Names away;
  for (const SurfaceFacts& surface : facts.surfaces) {
    if (receives_from_behind(surface))
      away.add(in_quotes(surface.name) + " (" + in_percent(surface.seen_from_behind) + ")");
  }
  if (away.count() > 0) {
    add(facts, Severity::note, "behind",
        to_text(away.count(), "surface") + " of " + std::to_string(facts.surfaces.size()) +
            (away.count() == 1 ? " receives most of its light on the back face: "
                               : " receive most of their light on the back face: ") +
            away.text() + ".",
        "Nothing to do: the side that is hit reflects. Other renderers may not show these faces; there, recalculate "
        "the normals.");
  }
  for (const Emitter& emitter : room.emitters) {
    const std::optional<std::size_t> number = emitting_surface(emitter);
    if (!number || *number >= facts.surfaces.size()) continue;
    const SurfaceFacts& surface = facts.surfaces[*number];
    if (!receives_from_behind(surface)) continue;
    add(facts, Severity::warning, "behind",
        "The emissive surface " + in_quotes(surface.name) +
            " emits from its front face, but receives the light of the room on its back face: it probably emits away "
            "from the room.",
        "If that is wrong, flip its faces (in Blender: Mesh, Normals, Flip).");
  }
}

void find_faces_in_one_plane(const Room& room, Inspection& facts) {
  for (const CoverWarning& covered : covered_emitters(room, facts.covers))
    add(facts, Severity::warning, "one-plane", covered.what, covered.advice);
  const auto ties = undecided_covers(room, facts.covers, facts.undecided_flights, facts.flights);
  for (const CoverWarning& tie : ties) add(facts, Severity::warning, "one-plane", tie.what, tie.advice);
  constexpr std::size_t most = 5;
  const std::string covers = text_of_covers(room, facts.covers, most, false);
  if (!covers.empty()) {
    add(facts, Severity::note, "one-plane", "Surfaces in the plane of others: " + covers + ".",
        "Nothing to do: the smaller one lies on top, and covered parts receive no light.");
  }
  Names pairs;
  for (const Cover& pair : facts.opposites) {
    pairs.add(in_quotes(room.surfaces[pair.over].name) + " and " + in_quotes(room.surfaces[pair.under].name) + " (" +
              short_number(pair.area_m2) + " m²)");
  }
  if (pairs.count() > 0) {
    add(facts, Severity::note, "one-plane", "Faces back to back in one place: " + pairs.text() + ".",
        "Nothing to do: on each side the face counts that looks to it.");
  }
}

void find_zero_area(const Room& /*room*/, Inspection& facts) {
  if (facts.triangles_without_area == 0) return;
  add(facts, Severity::note, "zero-area",
      to_text(facts.triangles_without_area, "triangle") + " of " +
          std::to_string(facts.triangles + facts.triangles_without_area) + " have no area and are left out.",
      "Nothing to do: they receive no light.");
}

void find_reflectances(const Room& room, Inspection& facts) {
  if (const std::optional<Advised> high = high_reflectances(room))
    add(facts, Severity::warning, "reflectance", high->what, high->advice);
}

}  // namespace lichtmc
