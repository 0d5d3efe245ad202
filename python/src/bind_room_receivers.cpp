// The receivers of a room.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "aside.hpp"
#include "checked_call.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/receiver_table.hpp"
#include "lichtmc/receivers.hpp"
#include "named_values.hpp"
#include "room_parts.hpp"
#include "vectors.hpp"

namespace lichtmc::python {

namespace {

struct ReceiversOfRoom {
  KeptRoomPtr kept;

  const std::vector<Receiver>& all() const { return kept->room.receivers; }
};

// Rows for `count` receivers: (n, 3), or (3,) for all.
std::vector<glm::dvec3> directions_of(nb::handle value, const std::string& what, std::size_t count) {
  std::vector<glm::dvec3> rows = rows_of_3(value, what);
  if (rows.size() == 1) rows.resize(count, rows.front());
  if (rows.size() == count) return rows;
  throw InputError("The " + what + " has " + std::to_string(rows.size()) + " rows (allowed: " + std::to_string(count) +
                   ", one for each receiver, or a single one for all). Give as many as there are positions.");
}

// The number of receivers that belong to no calculation area.
std::size_t free_receivers(const Room& room) {
  std::size_t of_areas = 0;
  for (const Area& area : room.areas) of_areas += area.cells.size();
  return room.receivers.size() - of_areas;
}

std::vector<std::string> names_of(nb::handle names, const Room& room, std::size_t count) {
  std::vector<std::string> texts;
  if (names.is_none()) {
    const std::size_t first = free_receivers(room) + 1;
    for (std::size_t k = 0; k < count; ++k) texts.push_back("receiver_" + std::to_string(first + k));
    return texts;
  }
  texts = texts_of(names, "list of the names of the receivers");
  if (texts.size() != count)
    throw InputError("The number of names is " + std::to_string(texts.size()) + " (allowed: " + std::to_string(count) +
                     ", one for each receiver). Give a name for each position.");
  return texts;
}

// Before the points of calculation areas, as on the command line: the order of receivers, and with it the random
// numbers, does not depend on what was added first.
std::vector<std::string> insert(SharedRoom& room, std::vector<Receiver> receivers) {
  Room check = room_for_checks(room.room());
  check.receivers.swap(receivers);
  check_room(check);
  receivers.swap(check.receivers);
  std::vector<std::string> names;
  for (const Receiver& receiver : receivers) names.push_back(receiver.name);
  return room.change([&](Room& changed) {
    std::size_t place = changed.receivers.size();
    for (const Area& area : changed.areas) place = std::min(place, area.first_receiver);
    changed.receivers.reserve(changed.receivers.size() + receivers.size());
    changed.receivers.insert(changed.receivers.begin() + static_cast<std::ptrdiff_t>(place),
                             std::make_move_iterator(receivers.begin()), std::make_move_iterator(receivers.end()));
    for (Area& area : changed.areas) area.first_receiver += receivers.size();
    return std::move(names);
  });
}

std::vector<std::string> add_receivers(SharedRoom& room, nb::handle positions, nb::handle normals, nb::handle names,
                                       nb::handle half_angle, nb::handle area, nb::handle concentrator_index,
                                       nb::handle filter_gain, nb::handle law, nb::handle facing, nb::handle cell_u,
                                       nb::handle cell_v) {
  const std::vector<glm::dvec3> places = rows_of_3(positions, "array of positions");
  const std::size_t count = places.size();
  const auto numbers = [&](nb::handle value, const char* what) { return numbers_of(value, what, count, "receiver"); };
  const auto directions = directions_of(normals, "array of normals", count);
  const auto faced = directions_of(facing, "array of directions faced (facing)", count);
  const auto edges = [&](nb::handle value, const char* what) {
    return value.is_none() ? std::vector<glm::dvec3>(count, glm::dvec3(0.0)) : directions_of(value, what, count);
  };
  const auto us = edges(cell_u, "array of edges of the cells (cell_u)");
  const auto vs = edges(cell_v, "array of edges of the cells (cell_v)");
  const auto half_angles = numbers(half_angle, "half angle of the field of view");
  const auto areas = numbers(area, "area of the receivers");
  const auto gains = numbers(filter_gain, "gain of the filter");
  const auto indices = concentrator_index.is_none()
                           ? std::vector<double>()
                           : numbers(concentrator_index, "refractive index of the concentrator");
  const auto weighting =
      named<ReceiverLaw>("law", text_of(law, "law of the receivers"),
                         {ReceiverLaw::planar, ReceiverLaw::cylindrical, ReceiverLaw::semicylindrical});
  const std::vector<std::string> texts = names_of(names, room.room(), count);
  std::vector<Receiver> receivers(count);
  for (std::size_t k = 0; k < count; ++k) {
    Receiver& one = receivers[k];
    one.name = texts[k];
    one.position = places[k];
    one.normal = directions[k];
    one.half_angle_deg = half_angles[k];
    one.area_m2 = areas[k];
    if (!indices.empty()) one.concentrator_index = indices[k];
    one.filter_gain = gains[k];
    one.law = weighting;
    one.facing = faced[k];
    one.cell_u = us[k];
    one.cell_v = vs[k];
  }
  return insert(room, std::move(receivers));
}

std::vector<std::string> add_grid(SharedRoom& room, nb::handle height, nb::handle spacing) {
  const double height_m = number_of(height, "height of the grid");
  const double spacing_m = number_of(spacing, "spacing of the grid");
  auto kept = room.kept();
  auto receivers = aside<std::vector<Receiver>>([&] { return receiver_grid(kept->room, height_m, spacing_m); });
  kept.reset();  // so that the room is changed in place
  return insert(room, std::move(receivers));
}

// Python's texts are Unicode.
void check_is_unicode(const std::string& name, std::size_t number, const std::filesystem::path& file) {
  const auto size = static_cast<Py_ssize_t>(name.size());
  if (nb::steal(PyUnicode_DecodeUTF8(name.data(), size, nullptr)).is_valid()) return;
  clear_error_of_value();
  throw InputError("The name of receiver " + std::to_string(number) + " of " + file.string() + " is " + readable(name) +
                   ", which is not UTF-8 (allowed: UTF-8). Save the table as CSV in UTF-8.");
}

std::vector<std::string> read_receivers(SharedRoom& room, nb::handle path) {
  const std::filesystem::path file = path_of(path, "table of receivers");
  std::vector<Receiver> receivers = read_receiver_table(file).receivers;
  for (std::size_t k = 0; k < receivers.size(); ++k) check_is_unicode(receivers[k].name, k + 1, file);
  return insert(room, std::move(receivers));
}

View<double> concentrators(const ReceiversOfRoom& of) {
  std::vector<double> values;
  for (const Receiver& one : of.all())
    values.push_back(one.concentrator_index.value_or(std::numeric_limits<double>::quiet_NaN()));
  const std::size_t count = values.size();
  return owned<double, 1>(std::move(values), {count});
}

void bind_receivers(nb::module_& module) {
  const auto view = [](auto Receiver::*member) {
    return [member](const ReceiversOfRoom& of) { return column(of.kept, of.all(), member); };
  };
  nb::class_<ReceiversOfRoom>(
      module, "RoomReceivers",
      "The receivers of a room, one value each, as they were when they were asked for: those that were read or added, "
      "then the points of calculation areas. Arrays are read-only.")
      .def("__len__", [](const ReceiversOfRoom& of) { return of.all().size(); })
      .def_prop_ro(
          "names",
          [](const ReceiversOfRoom& of) {
            std::vector<std::string> names;
            for (const Receiver& one : of.all()) names.push_back(one.name);
            return names;
          },
          "Their names, a list.")
      .def_prop_ro("position", view(&Receiver::position), has_owner, "m, float64 (n, 3).")
      .def_prop_ro("normal", view(&Receiver::normal), has_owner,
                   "Axes of their fields of view, float64 (n, 3), of any length but 0.")
      .def_prop_ro("half_angle", view(&Receiver::half_angle_deg), has_owner,
                   "Half angle of the field of view, degrees, float64 (n,).")
      .def_prop_ro("area", view(&Receiver::area_m2), has_owner, "For their gain, m², float64 (n,).")
      .def_prop_ro("concentrator_index", &concentrators, has_owner,
                   "Refractive index of an ideal concentrator, float64 (n,); NaN: none.")
      .def_prop_ro("filter_gain", view(&Receiver::filter_gain), has_owner, "Of an optical filter, float64 (n,).")
      .def_prop_ro(
          "law",
          [](const ReceiversOfRoom& of) {
            std::vector<std::string> laws;
            for (const Receiver& one : of.all()) laws.emplace_back(to_string(one.law));
            return laws;
          },
          "'planar', 'cylindrical' or 'semicylindrical' each, a list.")
      .def("__repr__",
           [](const ReceiversOfRoom& of) { return "<RoomReceivers: " + std::to_string(of.all().size()) + ">"; });
}

// Signatures, for Python and for messages.
constexpr const char* add_receivers_signature =
    "def add_receivers(self, positions: numpy.typing.ArrayLike, normals: numpy.typing.ArrayLike = (0, 1, 0), *, names: "
    "str | collections.abc.Sequence[str] | None = None, half_angle: numpy.typing.ArrayLike = 90.0, area: "
    "numpy.typing.ArrayLike = 1.0, concentrator_index: numpy.typing.ArrayLike | None = None, filter_gain: "
    "numpy.typing.ArrayLike = 1.0, law: str = 'planar', facing: numpy.typing.ArrayLike = (1, 0, 0), cell_u: "
    "numpy.typing.ArrayLike | None = None, cell_v: numpy.typing.ArrayLike | None = None) -> list[str]";
constexpr const char* add_receiver_grid_signature =
    "def add_receiver_grid(self, height: float, spacing: float = 0.5) -> list[str]";

}  // namespace

void bind_receivers_of_room(nb::module_& module, RoomClass& room) {
  bind_receivers(module);
  room.def("add_receivers", checked("add_receivers", add_receivers_signature, &add_receivers), required("positions"),
           any_arg("normals") = nb::make_tuple(0, 1, 0), nb::kw_only(), any_arg("names") = nb::none(),
           any_arg("half_angle") = 90.0, any_arg("area") = 1.0, any_arg("concentrator_index") = nb::none(),
           any_arg("filter_gain") = 1.0, any_arg("law") = "planar", any_arg("facing") = nb::make_tuple(1, 0, 0),
           any_arg("cell_u") = nb::none(), any_arg("cell_v") = nb::none(), other_keywords(),
           nb::sig(add_receivers_signature),
           R"(Adds receivers, points at which irradiance is computed; returns their names.

Each argument is one value for all receivers, or an array with one for each.

Args:
    positions: m, (n, 3), or (3,) for one receiver.
    normals: Axes of their fields of view, of any length but 0.
    names: n texts. Default: "receiver_1", …
    half_angle: Half angle of the field of view, degrees, 0 to 90.
    area: Sensitive area, m²: for the gain H = E·A/Φ only.
    concentrator_index: Refractive index, 1 or more, of an ideal concentrator. Default: none.
    filter_gain: Gain of an optical filter, 0 or more.
    law: "planar" (irradiance), "cylindrical" or "semicylindrical"; the normal is the axis of the cylinder.
    facing: Direction that a half cylinder faces.
    cell_u, cell_v: Edges, m, of a parallelogram about the position: the mean over it is computed. Default: the point.

Raises:
    InputError: A shape does not fit, or a value is out of its range.)")
      .def("add_receiver_grid", checked("add_receiver_grid", add_receiver_grid_signature, &add_grid),
           required("height"), any_arg("spacing") = 0.5, other_keywords(), nb::sig(add_receiver_grid_signature),
           R"(Adds a grid of receivers above all floors that light reaches, looking up; returns their names.

Points inside furniture and walls are left out. Add emitters first: they tell which rooms are lit.

Args:
    height: Above the floors, m.
    spacing: Of the receivers along x and z, m.)")
      .def("read_receivers", &read_receivers, any_arg("path"),
           nb::sig("def read_receivers(self, path: str | os.PathLike[str]) -> list[str]"),
           R"(Adds the receivers of a table (CSV); returns their names.

Columns by a heading: x, y, z (m), nx, ny, nz (normal) and, if wanted, name, area (m²), fov (half angle, degrees),
concentrator_index, filter_gain.)")
      .def_prop_ro(
          "receivers", [](SharedRoom& shared) { return ReceiversOfRoom{with_areas(shared)}; },
          "Its receivers, a :class:`RoomReceivers`.");
}

}  // namespace lichtmc::python
