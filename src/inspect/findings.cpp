#include "inspect/findings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "base/message.hpp"
#include "inspect/guesses.hpp"
#include "room/emitter_shape.hpp"
#include "run/warnings.hpp"

namespace lichtmc {

namespace {

std::string percent(double share) {
  return short_number(100.0 * share) + " %";
}

std::string text_of(const glm::dvec3& p) {
  return "(" + short_number(p.x) + ", " + short_number(p.y) + ", " + short_number(p.z) + ")";
}

std::string size_text(const glm::dvec3& size) {
  return short_number(size.x) + " × " + short_number(size.y) + " × " + short_number(size.z) + " m";
}

// A list of names that shows the first few: "'a', 'b', 'c', 'd', 'e' and 4 more".
class Names {
 public:
  void add(const std::string& text) {
    if (count_++ < shown) text_ += (text_.empty() ? "" : ", ") + text;
  }
  std::size_t count() const { return count_; }
  std::string text() const {
    return count_ > shown ? text_ + " and " + std::to_string(count_ - shown) + " more" : text_;
  }

 private:
  static constexpr std::size_t shown = 5;
  std::size_t count_ = 0;
  std::string text_;
};

class FindingsCollector {
 public:
  FindingsCollector(const Room& room, Inspection& facts) : room_(room), facts_(facts) {}

  void report() {
    size();
    up_axis();
    emitters();
    receivers();
    not_modelled();
    openings();
    open_edges();
    seen_from_behind();
    duplicates();
    zero_area();
    reflectances();
    texture_coordinates();
    tiles();
    shape();
  }

 private:
  void add(Severity severity, const char* topic, std::string text, std::string advice) {
    facts_.findings.push_back({severity, topic, std::move(text), std::move(advice)});
  }

  void size();
  void up_axis();
  void emitters();
  void receivers();
  void not_modelled();
  void openings();
  void open_edges();
  void seen_from_behind();
  void duplicates();
  void zero_area();
  void reflectances();
  void texture_coordinates();
  void tiles();
  void shape();

  const Room& room_;
  Inspection& facts_;
};

void FindingsCollector::size() {
  const glm::dvec3 size = facts_.high - facts_.low;
  const std::string is = "The room is " + size_text(size) + " (x, height y, z)";
  if (const auto unit = guess_unit(size)) {
    add(Severity::warning, "size",
        is + ", which is not plausible. In " + unit->name + " it would be " + size_text(size * unit->metres) + ".",
        "If that is right, give --scale " + to_text(unit->metres) + ", or export the room in metres.");
    return;
  }
  constexpr double smallest_room = 1.0;
  if (std::max({size.x, size.y, size.z}) < smallest_room) {
    add(Severity::warning, "size", is + ", which is small for a room.",
        "If the file is not in metres, give --scale the length of its unit in metres: for a given power of the "
        "emitters, "
        "the irradiance is proportional to 1/length².");
    return;
  }
  add(Severity::note, "size", is + ".", "If that is wrong, give --scale the length of the file's unit in metres.");
}

void FindingsCollector::up_axis() {
  if (!facts_.probably_z_up) return;
  add(Severity::warning, "up-axis", "More area is perpendicular to Z than to Y: the room is probably Z-up.",
      "If it is, give --up z, or export the room with Y up.");
}

void FindingsCollector::emitters() {
  // Extends the advice of check_room() by a possible position.
  const auto fault = std::find_if(facts_.findings.begin(), facts_.findings.end(),
                                  [](const Finding& f) { return f.topic == "emitters"; });
  if (room_.emitters.empty() && fault != facts_.findings.end()) {
    fault->advice =
        "Add a point or spot light or an emissive material to the room, or give --light, for example at a point inside "
        "the room: --light point:" +
        short_number(facts_.inside.x) + "," + short_number(facts_.inside.y) + "," + short_number(facts_.inside.z) +
        ":1000lm.";
  }
  for (const OutsideEmitter& outside : emitters_outside(room_))
    add(Severity::warning, "emitters", outside.what, outside.advice);
  Names dark;
  for (const Emitter& emitter : room_.emitters) {
    if (emitter.power == 0.0) dark.add(in_quotes(emitter.name));
  }
  if (dark.count() > 0) {
    add(Severity::warning, "emitters", to_text(dark.count(), "emitter") + " with power 0: " + dark.text() + ".",
        "Set the intensity or strength, or the custom property 'power'; or remove the emitters.");
  }
  const glm::dvec3 size = facts_.high - facts_.low;
  const double power = total_power(room_);
  const double mean = power / (size.x * size.z);
  if (room_.quantity != Quantity::photometric || !(power > 0.0) || !std::isfinite(mean)) return;
  // Luminous flux per floor area in lm/m²: a night light to full daylight; offices have some 10³.
  constexpr double least = 1.0;
  constexpr double most = 1e5;
  if (mean >= least && mean <= most) return;
  add(Severity::warning, "emitters",
      "The total luminous flux of the emitters is " + short_number(power) + " lm, " + short_number(mean) +
          " lm for every square metre of floor; rooms usually have some hundreds.",
      "Check the emitters: glTF gives the intensity of lights in cd and the luminance of emissive materials in cd/m². "
      "The custom property 'power' gives the luminous flux in lm.");
}

void FindingsCollector::receivers() {
  if (room_.receivers.empty()) return;
  add(Severity::note, "receivers",
      to_text(room_.receivers.size(), "receiver") + ", the first is " + in_quotes(room_.receivers.front().name) + ".",
      "A run computes the irradiance of the tiles and at the receivers.");
}

void FindingsCollector::not_modelled() {
  for (const Ignored& thing : room_.ignored) {
    const bool matters = thing.effect == Effect::figures;
    add(matters ? Severity::warning : Severity::note, "not-modelled", thing.what,
        matters ? "This may change the figures: remove it from the room, or take it into account."
                : "Nothing to do: it has no influence on the figures.");
  }
}

void FindingsCollector::openings() {
  if (facts_.flights == 0) return;
  if (facts_.flights_that_left == 0) {
    add(Severity::note, "openings", "None of " + std::to_string(facts_.flights) + " flights of light left the room.",
        "Nothing to do. If the room has an open window or door, model the opening.");
    return;
  }
  const double share = static_cast<double>(facts_.flights_that_left) / static_cast<double>(facts_.flights);
  std::string where;
  for (const Opening& opening : facts_.openings) {
    where += (where.empty() ? "" : "; ") + percent(opening.share) + " of them through the side " + opening.side +
             ", the first at " + text_of(opening.place) + " m";
    if (!opening.from.empty()) where += " from " + in_quotes(opening.from);
  }
  add(Severity::warning, "openings",
      percent(share) + " of " + std::to_string(facts_.flights) + " flights of light leave the room: " + where + ".",
      "Light that leaves does not return. If there is no window, door or open side, close the room there.");
}

void FindingsCollector::open_edges() {
  if (facts_.open_edges == 0) return;
  Names places;
  for (const glm::dvec3& p : facts_.open_edge_places) places.add(text_of(p));
  const bool leaks = facts_.flights_that_left > 0;
  add(leaks ? Severity::warning : Severity::note, "open-edges",
      to_text(facts_.open_edges, "edge") + (facts_.open_edges == 1 ? " belongs" : " belong") +
          " to only one triangle, the first at " + places.text() + " m: borders of open meshes, holes, or T-junctions.",
      leaks ? "If light should not leave there, join the meshes (in Blender: Merge by Distance, Fill)."
            : "Nothing to do: no light left the room through them.");
}

void FindingsCollector::seen_from_behind() {
  constexpr double mostly = 0.5;
  Names away;
  for (const SurfaceFacts& surface : facts_.surfaces) {
    if (surface.sides == Sides::one && surface.seen_from_behind > mostly)
      away.add(in_quotes(surface.name) + " (" + percent(surface.seen_from_behind) + ")");
  }
  if (away.count() > 0) {
    add(Severity::note, "behind",
        to_text(away.count(), "surface") + " of " + std::to_string(facts_.surfaces.size()) +
            " receive most of their light on the back face: " + away.text() + ".",
        "Nothing to do: the side that is hit reflects. Other renderers may not show these faces; there, recalculate "
        "the "
        "normals.");
  }
  for (const Emitter& emitter : room_.emitters) {
    const std::optional<std::size_t> number = emitting_surface(emitter);
    if (!number || *number >= facts_.surfaces.size()) continue;
    const SurfaceFacts& surface = facts_.surfaces[*number];
    if (surface.sides != Sides::one || !(surface.seen_from_behind > mostly)) continue;
    add(Severity::warning, "behind",
        "The emissive surface " + in_quotes(surface.name) +
            " emits from its front face, but receives the light of the room on its back face: it probably emits away "
            "from the room.",
        "If that is wrong, flip its faces (in Blender: Mesh, Normals, Flip).");
  }
}

void FindingsCollector::duplicates() {
  if (facts_.duplicate_triangles == 0) return;
  add(Severity::warning, "duplicates",
      to_text(facts_.duplicate_triangles, "triangle") + (facts_.duplicate_triangles == 1 ? " has" : " have") +
          " the same corners as another. Rounding decides which of the two a photon hits.",
      "The tiles of both share the light: remove the copies (in Blender: Merge by Distance on each mesh), especially "
      "if "
      "their materials differ.");
}

void FindingsCollector::zero_area() {
  if (facts_.triangles_without_area == 0) return;
  add(Severity::note, "zero-area",
      to_text(facts_.triangles_without_area, "triangle") + " of " +
          std::to_string(facts_.triangles + facts_.triangles_without_area) + " have no area and are left out.",
      "Nothing to do: they receive no light.");
}

void FindingsCollector::reflectances() {
  constexpr double doubtful = 0.95;  // reflectance of fresh snow; white paint has 0.85
  std::map<std::string, double> high;
  for (const SurfaceFacts& surface : facts_.surfaces) {
    if (!(surface.highest_reflectance > doubtful)) continue;
    double& most = high[surface.material];
    most = std::max(most, surface.highest_reflectance);
  }
  if (high.empty()) return;
  Names names;
  for (const auto& [material, reflectance] : high)
    names.add(in_quotes(material) + " (" + short_number(reflectance) + ")");
  add(Severity::warning, "reflectance",
      to_text(high.size(), "material") + (high.size() == 1 ? " reflects" : " reflect") +
          " more than 95 % of the light, everywhere or in some places; hardly any real surface does: " + names.text() +
          ".",
      "Set the custom property 'reflectance', or give --reflectance MATERIAL=R or --max-reflectance 0.9. The "
      "irradiance is proportional to 1/(1 − ρ) if all surfaces have the reflectance ρ: from 0.9 to 0.99 it increases "
      "tenfold.");
}

void FindingsCollector::texture_coordinates() {
  // Grouped by the first words of the reason.
  std::map<std::string, Names> by_fault;
  for (const SurfaceFacts& surface : facts_.surfaces) {
    if (surface.chart != ChartSource::engine) continue;
    const std::string fault = surface.chart_reason.substr(0, surface.chart_reason.find(" ("));
    by_fault[fault].add(in_quotes(surface.name));
  }
  for (const auto& [fault, names] : by_fault) {
    add(Severity::note, "texture-coordinates",
        "Charts made by lichtmc for " + to_text(names.count(), "surface") + ": " + names.text() +
            ". Reason for each surface: " + fault + ".",
        "Nothing to do. For charts of your own, unwrap the meshes without overlaps into a second UV map.");
  }
}

void FindingsCollector::tiles() {
  if (facts_.tiles == 0) return;
  constexpr double large = 2e9;
  add(facts_.memory_bytes > large ? Severity::warning : Severity::note, "tiles",
      to_text(static_cast<std::size_t>(facts_.tiles), "tile") + ", about " + short_number(facts_.memory_bytes / 1e6) +
          " MB of memory per thread.",
      facts_.memory_bytes > large ? "Give --tile a greater length, or use fewer --threads."
                                  : "Nothing to do; --tile changes the edge of a tile.");
}

void FindingsCollector::shape() {
  if (facts_.cuboid) {
    add(Severity::note, "shape", "The room is an empty cuboid.", "Nothing to do: impacts have a closed form.");
    return;
  }
  const std::string closed =
      facts_.closed ? "The room is closed" : "The room is not closed, or not all emitters are inside";
  add(Severity::note, "shape", closed + "; it is " + (facts_.convex ? "convex (no shadows)." : "not convex."),
      "Nothing to do.");
}

}  // namespace

void add_findings(const Room& room, Inspection& facts) {
  FindingsCollector(room, facts).report();
}

void add_fault(const std::string& message, const std::string& topic, std::vector<Finding>& findings) {
  // The form of a message: "what is wrong (the value; allowed: …). What to do."
  const std::size_t allowed = message.find("(allowed");
  const std::size_t end = message.find(". ", allowed == std::string::npos ? 0 : allowed);
  const bool two_parts = end != std::string::npos;
  findings.push_back({Severity::fault, topic, two_parts ? message.substr(0, end + 1) : message,
                      two_parts ? message.substr(end + 2) : "Correct this."});
}

void add_non_absorbing_enclosure(std::vector<Finding>& findings) {
  findings.push_back(
      {Severity::fault, "trapped-light", "Light is enclosed by surfaces with reflectance 1: nothing absorbs it.",
       "Set reflectances below 1, for example with --max-reflectance 0.9; or limit the number of flights "
       "with --estimator weight --max-bounces N."});
}

}  // namespace lichtmc
