// Checks of a room before a simulation.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "aside.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/inspect.hpp"
#include "room_parts.hpp"

namespace lichtmc::python {

namespace {

// What was found, with the room that it was found in.
struct InspectionOfRoom {
  KeptRoomPtr kept;
  std::shared_ptr<const Inspection> facts;
};

std::string word_of(Severity severity) {
  switch (severity) {
    case Severity::fault:
      return "fault";
    case Severity::warning:
      return "warning";
    case Severity::note:
      break;
  }
  return "note";
}

std::string text_of(const Finding& finding) {
  return word_of(finding.severity) + " (" + finding.topic + "): " + finding.text +
         (finding.advice.empty() ? "" : "\n    -> " + finding.advice);
}

std::vector<Finding> of_severity(const InspectionOfRoom& of, Severity severity) {
  std::vector<Finding> chosen;
  for (const Finding& finding : of.facts->findings) {
    if (finding.severity == severity) chosen.push_back(finding);
  }
  return chosen;
}

// The room, with the areas of its file if they can be laid out: what is wrong with them, the inspection says.
KeptRoomPtr with_possible_areas(SharedRoom& room) {
  try {
    return with_areas(room);
  } catch (const InputError&) {
    return room.kept();
  }
}

InspectionOfRoom check(SharedRoom& room, nb::handle tile) {
  const double tile_edge_m = number_of(tile, "edge of a tile");
  const auto kept = with_possible_areas(room);
  auto facts = aside<std::shared_ptr<const Inspection>>(
      [&] { return std::make_shared<const Inspection>(inspect(kept->room, tile_edge_m, kept->prepared(0))); });
  return {kept, std::move(facts)};
}

nb::object json_of(const InspectionOfRoom& of) {
  return nb::module_::import_("json").attr("loads")(inspection_json(of.kept->room, *of.facts));
}

std::string text_of(const InspectionOfRoom& of) {
  const Inspection& facts = *of.facts;
  const glm::dvec3 size = facts.high - facts.low;
  const nb::object head =
      nb::str(
          "{}\n  Size      {:.4g} x {:.4g} x {:.4g} m (x, height y, z)\n  Meshes    {} triangles in {} surfaces, {} "
          "tiles\n  Shape     {}{}, {}\n")
          .attr("format")(readable(of.kept->room.source), size.x, size.y, size.z, facts.triangles,
                          facts.surfaces.size(), facts.tiles, facts.cuboid ? "empty cuboid, " : "",
                          facts.convex ? "convex" : "not convex", facts.closed ? "closed" : "not closed");
  std::string text = nb::cast<std::string>(head);
  for (const Finding& finding : facts.findings) text += text_of(finding) + "\n";
  const std::size_t faults = facts.count(Severity::fault);
  const std::size_t warnings = facts.count(Severity::warning);
  return text + (faults > 0 ? "simulate() would reject this room: " : "simulate() accepts this room: ") +
         std::to_string(faults) + (faults == 1 ? " fault, " : " faults, ") + std::to_string(warnings) +
         (warnings == 1 ? " warning" : " warnings");
}

void bind_finding(nb::module_& module) {
  nb::class_<Finding>(module, "Finding", "One finding of a check.")
      .def_prop_ro(
          "severity", [](const Finding& finding) { return word_of(finding.severity); },
          "'fault': the room cannot be simulated; 'warning': figures may not have the meaning that is expected; "
          "'note'.")
      .def_ro("topic", &Finding::topic,
              "A stable word for programs: 'openings', 'reflectance', 'emitters', 'size', 'areas', …")
      .def_ro("text", &Finding::text, "What was found, and where.")
      .def_ro("advice", &Finding::advice, "What to do.")
      .def("__repr__", [](const Finding& finding) { return "<" + text_of(finding) + ">"; })
      .def("__str__", [](const Finding& finding) { return text_of(finding); });
}

void bind_inspection(nb::module_& module) {
  const auto fact = [](auto Inspection::*member) {
    return [member](const InspectionOfRoom& of) { return (*of.facts).*member; };
  };
  const auto point = [](glm::dvec3 Inspection::*member) {
    return [member](const InspectionOfRoom& of) { return array_of((*of.facts).*member); };
  };
  nb::class_<InspectionOfRoom>(module, "Inspection",
                               "What a check has found: print it, or read its findings. It does not change.")
      .def_prop_ro("findings", fact(&Inspection::findings), "All findings: faults, then warnings, then notes.")
      .def_prop_ro(
          "faults", [](const InspectionOfRoom& of) { return of_severity(of, Severity::fault); },
          "Findings for which the room cannot be simulated.")
      .def_prop_ro(
          "warnings", [](const InspectionOfRoom& of) { return of_severity(of, Severity::warning); },
          "Findings for which figures may not have the meaning that is expected.")
      .def_prop_ro("closed", fact(&Inspection::closed),
                   R"(Whether closed surfaces enclose every emitter, so that no light can leave the room.

It follows from the geometry alone. It is False also where an emitter lies in the plane of a wall, which is neither
inside nor outside, although no light may leave: the finding of the topic "openings" tells how much does.)")
      .def_prop_ro("convex", fact(&Inspection::convex), "Whether the room is convex.")
      .def_prop_ro("cuboid", fact(&Inspection::cuboid), "Whether the room is an empty cuboid.")
      .def_prop_ro("low", point(&Inspection::low), has_owner, "Bounding box of all surfaces, least x, y, z, m.")
      .def_prop_ro("high", point(&Inspection::high), has_owner, "Bounding box of all surfaces, greatest x, y, z, m.")
      .def_prop_ro("tiles", fact(&Inspection::tiles), "Number of tiles of a run with this tile edge.")
      .def_prop_ro("memory", fact(&Inspection::memory_bytes), "Estimate for a run with its report, bytes.")
      .def("to_json", &json_of, nb::sig("def to_json(self) -> dict[str, typing.Any]"),
           "All results, with emitters and receivers: the content of `lichtmc check --json` as a dict.")
      .def("__str__", [](const InspectionOfRoom& of) { return text_of(of); })
      .def("__repr__", [](const InspectionOfRoom& of) {
        return "<Inspection: " + std::to_string(of.facts->count(Severity::fault)) + " faults, " +
               std::to_string(of.facts->count(Severity::warning)) + " warnings, " +
               std::to_string(of.facts->count(Severity::note)) + " notes>";
      });
}

}  // namespace

void bind_check(nb::module_& module, RoomClass& room) {
  bind_finding(module);
  bind_inspection(module);
  room.def("check", &check, any_arg("tile") = 0.1, nb::sig("def check(self, tile: float = 0.1) -> Inspection"),
           R"(Checks the room: what will be modelled, what is probably wrong, what to do.

It follows some 10⁵ photons, which takes seconds in rooms of 10⁶ triangles. simulate() does not check by itself: call
this once for a new room.

Args:
    tile: Edge of a tile, m, of the run that is planned.

Raises:
    InputError: The surfaces are not valid.)");
}

}  // namespace lichtmc::python
