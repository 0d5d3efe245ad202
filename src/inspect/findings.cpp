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

// "'a', 'b', 'c' and 4 more": names of which a few are enough.
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

class ProgressReporter {
 public:
  ProgressReporter(const Room& room, Inspection& facts) : room_(room), facts_(facts) {}

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

void ProgressReporter::size() {
  const glm::dvec3 size = facts_.high - facts_.low;
  const std::string is = "The room is " + size_text(size) + " (x, height y, z)";
  if (const auto unit = guess_unit(size)) {
    add(Severity::warning, "size",
        is + ", which no room is. In " + unit->name + " it would be " + size_text(size * unit->metres) + ".",
        "Give --scale " + to_text(unit->metres) + " where that is what it is, or export it in metres.");
    return;
  }
  constexpr double smallest_room = 1.0;
  if (std::max({size.x, size.y, size.z}) < smallest_room) {
    add(Severity::warning, "size", is + ", which is less than any room.",
        "Where it is a model, give --scale the length of its unit in metres; the illuminance that lamps of a given "
        "power make goes with 1/length².");
    return;
  }
  add(Severity::note, "size", is + ".", "Where it is not, give --scale the length of the file's unit in metres.");
}

void ProgressReporter::up_axis() {
  if (!facts_.looks_z_up) return;
  add(Severity::warning, "up-axis",
      "Most of what is flat lies across Z, not across Y: the room seems to lie on its side.",
      "Give --up z where Z is up in the program it comes from, or export it with Y up.");
}

void ProgressReporter::emitters() {
  // What check_room() said of it, with a place for a lamp.
  const auto fault = std::find_if(facts_.findings.begin(), facts_.findings.end(),
                                  [](const Finding& f) { return f.topic == "emitters"; });
  if (room_.emitters.empty() && fault != facts_.findings.end()) {
    fault->advice =
        "Add a point or spot light or an emissive material to the room, or give one with --light, for example inside "
        "it: --light point:" +
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
    add(Severity::warning, "emitters", to_text(dark.count(), "emitter") + " without power: " + dark.text() + ".",
        "Set their strength, or the custom property 'power'; or remove them.");
  }
  const glm::dvec3 size = facts_.high - facts_.low;
  const double power = total_power(room_);
  const double mean = power / (size.x * size.z);
  if (room_.quantity != Quantity::photometric || !(power > 0.0) || !std::isfinite(mean)) return;
  // Night light to full daylight, over the floor; offices have some 10³.
  constexpr double least = 1.0;
  constexpr double most = 1e5;
  if (mean >= least && mean <= most) return;
  add(Severity::warning, "emitters",
      "The emitters have " + short_number(power) + " lm together, " + short_number(mean) +
          " lm for every square metre of floor; rooms have some hundreds.",
      "Check the lamps' strengths: lights in glTF are in candela, emissive strength is in cd/m². The custom property "
      "'power' says it in lm.");
}

void ProgressReporter::receivers() {
  if (room_.receivers.empty()) return;
  add(Severity::note, "receivers",
      to_text(room_.receivers.size(), "receiver") + ", the first " + in_quotes(room_.receivers.front().name) + ".",
      "A run measures the tiles and at the receivers.");
}

void ProgressReporter::not_modelled() {
  for (const Ignored& thing : room_.ignored) {
    const bool matters = thing.effect == Effect::figures;
    add(matters ? Severity::warning : Severity::note, "not-modelled", thing.what,
        matters ? "Figures may differ for it: remove it from the room, or take it into account."
                : "Nothing to do: figures are the same without it.");
  }
}

void ProgressReporter::openings() {
  if (facts_.flights == 0) return;
  if (facts_.flights_that_left == 0) {
    add(Severity::note, "openings", "None of " + std::to_string(facts_.flights) + " flights of light left the room.",
        "Nothing to do; where it should have a window or a door, cut one.");
    return;
  }
  const double share = static_cast<double>(facts_.flights_that_left) / static_cast<double>(facts_.flights);
  std::string where;
  for (const Opening& opening : facts_.openings) {
    where += (where.empty() ? "" : "; ") + percent(opening.share) + " of it through the side " + opening.side +
             ", first at " + text_of(opening.place) + " m";
    if (!opening.from.empty()) where += " from " + in_quotes(opening.from);
  }
  add(Severity::warning, "openings",
      percent(share) + " of " + std::to_string(facts_.flights) + " flights of light leave the room: " + where + ".",
      "Light that leaves does not come back. Where that is no window, door or open side, close the room there.");
}

void ProgressReporter::open_edges() {
  if (facts_.open_edges == 0) return;
  Names places;
  for (const glm::dvec3& p : facts_.open_edge_places) places.add(text_of(p));
  const bool leaks = facts_.flights_that_left > 0;
  add(leaks ? Severity::warning : Severity::note, "open-edges",
      to_text(facts_.open_edges, "edge") + " of the meshes belong to one triangle only, the first at " + places.text() +
          " m: rims of sheets, holes, or edges that meet others in their middle.",
      leaks ? "Where light should not leave, join the meshes there (in Blender: Merge by Distance, Fill)."
            : "Nothing to do: no light left the room through them.");
}

void ProgressReporter::seen_from_behind() {
  constexpr double mostly = 0.5;
  Names away;
  for (const SurfaceFacts& surface : facts_.surfaces) {
    if (surface.sides == Sides::one && surface.seen_from_behind > mostly)
      away.add(in_quotes(surface.name) + " (" + percent(surface.seen_from_behind) + ")");
  }
  if (away.count() > 0) {
    add(Severity::note, "behind",
        to_text(away.count(), "surface") + " of " + std::to_string(facts_.surfaces.size()) +
            " get most of their light from behind, their faces look away from it: " + away.text() + ".",
        "Nothing to do: surfaces reflect on the side that is hit. Renderers may not show them; recalculate their "
        "normals there.");
  }
  for (const Emitter& emitter : room_.emitters) {
    const std::optional<std::size_t> number = emitting_surface(emitter);
    if (!number || *number >= facts_.surfaces.size()) continue;
    const SurfaceFacts& surface = facts_.surfaces[*number];
    if (surface.sides != Sides::one || !(surface.seen_from_behind > mostly)) continue;
    add(Severity::warning, "behind",
        "The shining surface " + in_quotes(surface.name) +
            " shines from its front, but light of the room falls on its back: it seems to shine away from the room.",
        "Turn its faces over (in Blender: Mesh, Normals, Flip) where that is not meant.");
  }
}

void ProgressReporter::duplicates() {
  if (facts_.duplicate_triangles == 0) return;
  add(Severity::warning, "duplicates",
      to_text(facts_.duplicate_triangles, "triangle") +
          " lie exactly on others. Light falls on either of the two, which one is left to rounding.",
      "Their tiles share the light between them: remove the copies (in Blender: Merge by Distance on each mesh), above "
      "all where they have different materials.");
}

void ProgressReporter::zero_area() {
  if (facts_.triangles_without_area == 0) return;
  add(Severity::note, "zero-area",
      to_text(facts_.triangles_without_area, "triangle") + " of " +
          std::to_string(facts_.triangles + facts_.triangles_without_area) + " have no area and are left out.",
      "Nothing to do: no light can fall on them.");
}

void ProgressReporter::reflectances() {
  constexpr double doubtful = 0.95;  // fresh snow; white paint has 0.85
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
          " more than 95 % of the light, as a whole or in places, which hardly any real surface does: " + names.text() +
          ".",
      "Set the custom property 'reflectance', or give --reflectance MATERIAL=R or --max-reflectance 0.9. Light grows "
      "with 1/(1 − ρ): from 0.9 to 0.99 tenfold.");
}

void ProgressReporter::texture_coordinates() {
  // By what is wrong with them: the first words of the reason.
  std::map<std::string, Names> by_fault;
  for (const SurfaceFacts& surface : facts_.surfaces) {
    if (surface.chart != ChartSource::engine) continue;
    const std::string fault = surface.chart_reason.substr(0, surface.chart_reason.find(" ("));
    by_fault[fault].add(in_quotes(surface.name));
  }
  for (const auto& [fault, names] : by_fault) {
    add(Severity::note, "texture-coordinates",
        to_text(names.count(), "surface") + ": " + fault + " (" + names.text() + "). Tiles are laid out anew there.",
        "Nothing to do; for a layout of your own unwrap them without overlaps into a second UV map.");
  }
}

void ProgressReporter::tiles() {
  if (facts_.tiles == 0) return;
  constexpr double large = 2e9;
  add(facts_.memory_bytes > large ? Severity::warning : Severity::note, "tiles",
      to_text(static_cast<std::size_t>(facts_.tiles), "tile") + ", about " + short_number(facts_.memory_bytes / 1e6) +
          " MB of memory for each thread.",
      facts_.memory_bytes > large ? "Give --tile a greater length, or fewer --threads."
                                  : "Give --tile another length for more or fewer of them.");
}

void ProgressReporter::shape() {
  const std::string closed = facts_.closed ? "It is closed" : "It is not closed, or not all light starts inside";
  if (facts_.cuboid) {
    add(Severity::note, "shape", "The room is an empty cuboid.", "Nothing to do: flights have a closed form.");
  } else {
    add(Severity::note, "shape",
        closed + "; it is " +
            (facts_.convex ? "convex: nothing in it casts a shadow." : "not convex: it casts shadows."),
        "Nothing to do.");
  }
}

}  // namespace

void add_findings(const Room& room, Inspection& facts) {
  ProgressReporter(room, facts).report();
}

void add_fault(const std::string& message, const std::string& topic, std::vector<Finding>& findings) {
  // Messages read "what is wrong (the value; allowed: …). What to do."
  const std::size_t allowed = message.find("(allowed");
  const std::size_t end = message.find(". ", allowed == std::string::npos ? 0 : allowed);
  const bool two_parts = end != std::string::npos;
  findings.push_back({Severity::fault, topic, two_parts ? message.substr(0, end + 1) : message,
                      two_parts ? message.substr(end + 2) : "Set it right."});
}

void add_trap(std::vector<Finding>& findings) {
  findings.push_back({Severity::fault, "trapped-light",
                      "Light is shut in by surfaces whose reflectance is 1: it would grow without end.",
                      "Give materials a reflectance below 1, for example with --max-reflectance 0.9; or cut the walk "
                      "off with --estimator weight --max-bounces N."});
}

}  // namespace lichtmc
