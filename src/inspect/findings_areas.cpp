#include "base/message.hpp"
#include "inspect/finding_text.hpp"
#include "inspect/findings.hpp"
#include "inspect/topics.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/lay_areas.hpp"

namespace lichtmc {

namespace {

constexpr const char* areas_topic = "areas";

// Areas of a file that have no points yet, as if they were laid one by one: each with what is wrong with it.
void find_unlaid_areas(const Room& room, Inspection& facts) {
  Room one = room;
  for (const AreaRequest& request : room.area_requests) {
    one.area_requests = {request};
    try {
      lay_areas(one);
    } catch (const InputError& fault) {
      add_fault(fault.what(), areas_topic, facts.findings);
    }
  }
}

void find_in_area(const Area& area, Inspection& facts) {
  const std::string name = "The calculation area " + in_quotes(area.properties.name);
  constexpr double rounding_m = 1e-3;
  if (area.above_floor_m && *area.above_floor_m < -rounding_m) {
    facts.findings.push_back({Severity::warning, areas_topic,
                              name + " lies " + rounded(-*area.above_floor_m, 3) + " m below the floor.",
                              "Move it to its height above the floor."});
  }
  constexpr double greatest_m = 10.0;
  if (area.properties.spacing_m && *area.properties.spacing_m > greatest_m) {
    facts.findings.push_back(
        {Severity::warning, areas_topic,
         name + " has a spacing of " + to_text(*area.properties.spacing_m) + " m; EN 12464-1 allows at most 10 m.",
         "Give it a smaller spacing, or none for the grid of the standard."});
  }
  const std::uint64_t dark = misplaced_points(area);
  if (dark > area.cells.size()) {
    facts.findings.push_back({Severity::warning, areas_topic,
                              "Most points of the calculation area " + in_quotes(area.properties.name) +
                                  " are left out: " + to_text(static_cast<std::size_t>(dark), "point") +
                                  " inside furniture or walls, or outside the rooms.",
                              "Check its place and height: lengths are metres, Y is up."});
  }
}

}  // namespace

void find_areas(const Room& room, Inspection& facts) {
  for (const Area& area : room.areas) find_in_area(area, facts);
  if (!room.area_requests.empty()) find_unlaid_areas(room, facts);
}

}  // namespace lichtmc
