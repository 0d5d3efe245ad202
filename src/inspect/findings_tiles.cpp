#include "inspect/topics.hpp"

#include <map>

#include "base/memory.hpp"
#include "base/message.hpp"
#include "inspect/finding_text.hpp"

namespace lichtmc {

void find_texture_coordinates(const Room& /*room*/, Inspection& facts) {
  // Grouped by the first words of the reason.
  std::map<std::string, Names> by_fault;
  for (const SurfaceFacts& surface : facts.surfaces) {
    if (surface.chart != ChartSource::engine) continue;
    const std::string fault = surface.chart_reason.substr(0, surface.chart_reason.find(" ("));
    by_fault[fault].add(in_quotes(surface.name));
  }
  for (const auto& [fault, names] : by_fault) {
    add(facts, Severity::note, "texture-coordinates",
        "Charts made by lichtmc for " + to_text(names.count(), "surface") + ": " + names.text() +
            ". Reason for each surface: " + fault + ".",
        "Nothing to do. For charts of your own, unwrap the meshes without overlaps into a second UV map.");
  }
}

void find_tiles(const Room& /*room*/, Inspection& facts) {
  if (facts.tiles == 0) return;
  constexpr double large = 2e9;
  const double available = memory_available();
  const bool too_much = facts.memory_bytes > available;
  const bool warn = too_much || facts.memory_bytes > large;
  std::string text = to_text(static_cast<std::size_t>(facts.tiles), "tile") + ", " +
                     to_text(facts.triangles, "triangle") + ": about " + short_number(facts.memory_bytes / 1e6) +
                     " MB of memory for a run of two threads with its report";
  if (too_much) text += "; only " + short_number(available / 1e6) + " MB are free";
  add(facts, warn ? Severity::warning : Severity::note, "tiles", text + ".",
      warn ? "Give --tile a greater length, or a mesh of fewer triangles. Each thread beyond two (--threads) needs up "
             "to "
             "a quarter more for the tiles."
           : "Nothing to do; --tile changes the edge of a tile.");
}

}  // namespace lichtmc
