// Calculation areas of a room.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "aside.hpp"
#include "checked_call.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/lay_areas.hpp"
#include "named_values.hpp"
#include "room_parts.hpp"
#include "vectors.hpp"

namespace lichtmc::python {

namespace {

struct AreaOfRoom {
  KeptRoomPtr kept;
  std::size_t index = 0;

  const Area& area() const { return kept->room.areas[index]; }
};

constexpr const char* known_properties =
    "role, quantity, direction, spacing, margin, cells, target_lx, target_uniformity";

// What may be said about an area, by the names of the command line.
AreaProperties properties_of(const nb::kwargs& given) {
  AreaProperties properties;
  for (const auto& [key, value] : given) {
    const std::string name = nb::cast<std::string>(key);
    if (value.is_none()) continue;
    const std::string what = name + " of the area";
    if (name == "role") {
      properties.role = text_of(value, what);
    } else if (name == "quantity") {
      properties.quantity = named<AreaQuantity>(
          "quantity", text_of(value, what),
          {AreaQuantity::normal, AreaQuantity::horizontal, AreaQuantity::cylindrical, AreaQuantity::semicylindrical});
    } else if (name == "direction") {
      properties.direction = vec3_of(value, what);
    } else if (name == "spacing") {
      properties.spacing_m = number_of(value, what);
    } else if (name == "margin") {
      properties.margin_m = number_of(value, what);
    } else if (name == "cells") {
      properties.cells = flag_of(value, what);
    } else if (name == "target_lx") {
      properties.target_lx = number_of(value, what);
    } else if (name == "target_uniformity") {
      properties.target_uniformity = number_of(value, what);
    } else {
      throw InputError("The property '" + name + "' of a calculation area is not known (allowed: " + known_properties +
                       "). Give one of these.");
    }
  }
  return properties;
}

struct AddedAreas {
  std::vector<std::string> names;
  std::vector<std::string> omissions;  // see omission_of()
};

// What an area that was drawn, or lies on a surface, leaves out though nobody asked for that, with what to do; empty:
// nothing.
std::string omission_of(const Area& area) {
  const bool by_margin = is_cut_by_usual_margin(area);
  const bool misplaced = misplaced_points(area) > 0;
  if (!by_margin && !misplaced) return {};
  std::string text = description_of(area);
  if (by_margin)
    text += " Give role='task' or margin=0 for points up to the walls; or margin=" +
            std::string(nb::repr(nb::float_(area.margin_m)).c_str()) + " if that is meant.";
  if (misplaced) text += " Its figures are those of the points that are left: check its place and size.";
  return text;
}

// The areas that `lay` adds. Those of the room's file come before them, as on the command line.
AddedAreas add_areas(SharedRoom& room, const std::function<void(Room&)>& lay) {
  std::size_t before = 0;
  change_aside(room, [&](Room& changed) {
    lay_areas(changed);
    before = changed.areas.size();
    lay(changed);
  });
  AddedAreas added;
  const std::vector<Area>& areas = room.room().areas;
  for (std::size_t k = before; k < areas.size(); ++k) {
    added.names.push_back(areas[k].properties.name);
    if (std::string omission = omission_of(areas[k]); !omission.empty()) added.omissions.push_back(std::move(omission));
  }
  return added;
}

// With a warning of what they leave out.
std::vector<std::string> add_wanted_areas(SharedRoom& room, const std::function<void(Room&)>& lay) {
  AddedAreas added = add_areas(room, lay);
  for (const std::string& omission : added.omissions) warn_of_room(omission);
  return std::move(added.names);
}

// Signatures, for Python and for messages.
constexpr const char* add_area_signature =
    "def add_area(self, name: str, corner: numpy.typing.ArrayLike, u: numpy.typing.ArrayLike, v: "
    "numpy.typing.ArrayLike, **properties: typing.Any) -> str";
constexpr const char* add_working_plane_signature =
    "def add_working_plane(self, height: float, margin: float | None = None, *, name: str = 'plane', **properties: "
    "typing.Any) -> list[str]";
constexpr const char* add_area_on_signature =
    "def add_area_on(self, surface: str, *, name: str | None = None, **properties: typing.Any) -> list[str]";

std::string add_area(SharedRoom& room, nb::handle name, nb::handle corner, nb::handle u, nb::handle v,
                     const nb::kwargs& given) {
  check_call("add_area", add_area_signature, std::array<nb::handle, 5>{nb::handle(), name, corner, u, v}, nullptr);
  AreaRequest request;
  request.properties = properties_of(given);
  request.properties.name = text_of(name, "name of the area");
  const glm::dvec3 a = vec3_of(corner, "corner of the area");
  const glm::dvec3 along = vec3_of(u, "edge u of the area");
  const glm::dvec3 across = vec3_of(v, "edge v of the area");
  request.triangles = {{a, a + along, a + along + across}, {a, a + along + across, a + across}};
  return add_wanted_areas(room,
                          [&](Room& changed) {
                            changed.area_requests.push_back(request);
                            lay_areas(changed);
                          })
      .front();
}

std::vector<std::string> add_working_plane(SharedRoom& room, nb::handle height, nb::handle margin, nb::handle name,
                                           const nb::kwargs& given) {
  check_call("add_working_plane", add_working_plane_signature, std::array<nb::handle, 2>{nb::handle(), height},
             nullptr);
  AreaProperties properties = properties_of(given);
  properties.name = text_of(name, "name of the working plane");
  properties.margin_m = optional_number(margin, "margin of the working plane");
  const double height_m = number_of(height, "height of the working plane");
  return add_areas(room, [&](Room& changed) { lay_working_planes(changed, height_m, properties); }).names;
}

std::vector<std::string> add_area_on(SharedRoom& room, nb::handle surface, nb::handle name, const nb::kwargs& given) {
  check_call("add_area_on", add_area_on_signature, std::array<nb::handle, 2>{nb::handle(), surface}, nullptr);
  AreaProperties properties = properties_of(given);
  if (!name.is_none()) properties.name = text_of(name, "name of the area");
  const std::string which = text_of(surface, "surface of the area");
  return add_wanted_areas(room, [&](Room& changed) { lay_area_on(changed, which, properties); });
}

// The points, in the order of the receivers.
View<double> positions(const AreaOfRoom& of) {
  const Area& area = of.area();
  std::vector<double> values;
  for (std::size_t k = 0; k < area.cells.size(); ++k) {
    const glm::dvec3& at = of.kept->room.receivers[area.first_receiver + k].position;
    values.insert(values.end(), {at.x, at.y, at.z});
  }
  return owned<double, 2>(std::move(values), {area.cells.size(), 3});
}

void bind_area(nb::module_& module) {
  const auto property = [](auto AreaProperties::*member) {
    return [member](const AreaOfRoom& of) { return of.area().properties.*member; };
  };
  nb::class_<AreaOfRoom>(module, "Area",
                         "A calculation area with its grid of points, which are receivers of the room; it casts no "
                         "shadow and reflects nothing.")
      .def_prop_ro("name", property(&AreaProperties::name), "Its name, unique in the room.")
      .def_prop_ro("role", property(&AreaProperties::role),
                   "'task', 'surrounding', 'background', 'wall', 'ceiling' or another text; may be empty.")
      .def_prop_ro(
          "quantity", [](const AreaOfRoom& of) { return std::string(to_string(of.area().quantity)); },
          "'normal', 'horizontal', 'cylindrical' or 'semicylindrical': what is measured.")
      .def_prop_ro(
          "columns", [](const AreaOfRoom& of) { return of.area().columns; }, "Cells of the grid along u.")
      .def_prop_ro(
          "rows", [](const AreaOfRoom& of) { return of.area().rows; }, "Cells of the grid along v.")
      .def_prop_ro(
          "points", [](const AreaOfRoom& of) { return of.area().cells.size(); },
          "Number of points: cells that are not left out.")
      .def_prop_ro("position", &positions, has_owner, "Its points, m, float64 (points, 3).")
      .def_prop_ro(
          "receivers",
          [](const AreaOfRoom& of) {
            const std::size_t first = of.area().first_receiver;
            return nb::slice(nb::int_(first), nb::int_(first + of.area().cells.size()), nb::none());
          },
          "Its points among the receivers of the room, a slice: of arrays of receivers.")
      .def_prop_ro(
          "normal", [](const AreaOfRoom& of) { return array_of(of.area().normal); }, has_owner,
          "Of its plane, a unit vector, float64 (3,).")
      .def_prop_ro(
          "margin", [](const AreaOfRoom& of) { return of.area().margin_m; }, "As used, m.")
      .def_prop_ro("target_lx", property(&AreaProperties::target_lx), "Of the maintained mean, lx; None: none.")
      .def_prop_ro("target_uniformity", property(&AreaProperties::target_uniformity),
                   "Of the uniformity Emin/Em, 0 to 1; None: none.")
      .def_prop_ro(
          "left_out",
          [](const AreaOfRoom& of) {
            nb::dict left_out;
            for (const AreaLeftOut& one : of.area().left_out) left_out[nb::str(one.why.c_str())] = one.points;
            return left_out;
          },
          nb::sig("def left_out(self) -> dict[str, int]"),
          "Why cells have no point, and how many. What the margin leaves out of the grid as a whole is in notes.")
      .def_prop_ro(
          "notes", [](const AreaOfRoom& of) { return of.area().notes; },
          "What else to know, a sentence each: what the usual margin leaves out, points that lie on table tops.")
      .def_prop_ro(
          "text", [](const AreaOfRoom& of) { return description_of(of.area()); }, "The area in a sentence.")
      .def("__repr__", [](const AreaOfRoom& of) { return "<" + description_of(of.area()) + ">"; });
}

constexpr const char* properties_text = R"(
    properties: By keyword:
        role: "task", "surrounding", "background", "wall", "ceiling" or any text.
        quantity: "normal", "horizontal", "cylindrical" or "semicylindrical" illuminance. Default: horizontal where the
            area is level, else normal.
        direction: That a half cylinder faces, (x, y, z).
        spacing: Greatest distance of points, m. Default: by EN 12464-1.
        margin: Distance of points from walls (level areas) or from the edges, m. Default: 0 for the role "task" and on
            surfaces, else 0.5 m for level areas.
        cells: True: means over cells, not values at their centres.
        target_lx: Of the maintained mean Em, lx.
        target_uniformity: Of Emin/Em, 0 to 1.

Raises:
    InputError: A property is not valid, the name is taken, or no point is left.)";

constexpr const char* warns_text = R"(

Warns:
    RoomWarning: Points are left out, inside furniture or walls, outside the rooms, or by the margin if none was given.)";

}  // namespace

void bind_areas_of_room(nb::module_& module, RoomClass& room) {
  bind_area(module);
  static const std::string of_area = std::string(R"(Adds a calculation area, a parallelogram; returns its name.

A level area is measured from above, any other on the side of the normal u × v. Its points become receivers of the room,
laid out at once: add emitters first, because they tell which rooms are lit.

Args:
    name: Its name, which no other area has.
    corner: (x, y, z), m.
    u, v: Its edges from the corner, (x, y, z), m.)") +
                                     properties_text + warns_text;
  static const std::string of_plane =
      std::string(R"(Adds working planes above the floors, one for each room; returns their names.

Each follows the outline of its floor, and leaves out furniture. Add emitters first: they tell which rooms are lit.

Args:
    height: Above the floor, m.
    margin: Distance from walls, m. Default: 0.5.
    name: Its name; several planes are numbered.)") +
      properties_text;
  static const std::string on_surface =
      std::string(R"(Adds calculation areas on surfaces, on the side that light reaches; returns their names.

Args:
    surface: Name or pattern of a material or surface.
    name: Its name; several areas are numbered. Default: the name of the surface.)") +
      properties_text + warns_text;
  room.def("add_area", &add_area, required("name"), required("corner"), required("u"), required("v"),
           nb::arg("properties"), nb::sig(add_area_signature), of_area.c_str())
      .def("add_working_plane", &add_working_plane, required("height"), any_arg("margin") = nb::none(), nb::kw_only(),
           any_arg("name") = "plane", nb::arg("properties"), nb::sig(add_working_plane_signature), of_plane.c_str())
      .def("add_area_on", &add_area_on, required("surface"), nb::kw_only(), any_arg("name") = nb::none(),
           nb::arg("properties"), nb::sig(add_area_on_signature), on_surface.c_str())
      .def_prop_ro(
          "areas",
          [](SharedRoom& shared) {
            std::vector<AreaOfRoom> areas;
            const auto kept = with_areas(shared);
            for (std::size_t k = 0; k < kept->room.areas.size(); ++k) areas.push_back({kept, k});
            return areas;
          },
          "Its calculation areas, a list of :class:`Area`. Those of a file are laid out when they are first asked "
          "for.");
}

}  // namespace lichtmc::python
