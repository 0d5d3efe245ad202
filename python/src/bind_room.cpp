// Rooms: how they are read, made, changed and written.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "arguments.hpp"
#include "aside.hpp"
#include "bindings.hpp"
#include "checked_call.hpp"
#include "lichtmc/cuboid.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/overrides.hpp"
#include "named_values.hpp"
#include "room_parts.hpp"
#include "vectors.hpp"

namespace lichtmc::python {

namespace {

// How a file is read: the keywords that from_gltf() and from_bytes() share.
struct Reading {
  ReadOptions options;
  bool unit_given = false;
  std::vector<std::pair<std::string, double>> reflectances;
};

Reading reading_of(nb::handle scale, nb::handle up, nb::handle scene, nb::handle without, nb::handle unit,
                   nb::handle uv_set, nb::handle reflectance) {
  Reading reading;
  ReadOptions& options = reading.options;
  options.scale = number_of(scale, "scale");
  const std::string axis = text_of(up, "up axis");
  if (axis != "y" && axis != "z") refuse_value("up axis", up, "'y' or 'z'", "Give the axis that points up.");
  options.up = axis == "z" ? UpAxis::z : UpAxis::y;
  options.scene = text_of(scene, "name of the scene");
  options.without = texts_of(without, "list of what is left out (without)");
  reading.unit_given = !unit.is_none();
  if (reading.unit_given) options.quantity = unit_of(unit);
  if (!uv_set.is_none())
    options.uv_set = static_cast<int>(whole_number_of(uv_set, "UV set", 0, std::numeric_limits<int>::max()));
  if (reflectance.is_none()) return reading;
  if (!nb::isinstance<nb::dict>(reflectance))
    refuse_value("reflectance", reflectance, "a dict of names of materials or surfaces to numbers",
                 "Give for example {'Wall': 0.6}.");
  for (const auto& [name, value] : nb::borrow<nb::dict>(reflectance)) {
    options.numbered.push_back(text_of(name, "name in reflectance"));
    reading.reflectances.emplace_back(options.numbered.back(),
                                      number_of(value, "reflectance of " + options.numbered.back()));
  }
  return reading;
}

// What the command line does after reading.
Room with_overrides(Room room, const Reading& reading) {
  if (reading.unit_given)
    room.overrides.push_back("The powers of the file are interpreted in " +
                             std::string(power_unit(*reading.options.quantity)) + ".");
  for (const auto& [name, value] : reading.reflectances) set_reflectance(room, name, value);
  return room;
}

SharedRoom from_gltf(nb::handle path, nb::handle scale, nb::handle up, nb::handle scene, nb::handle without,
                     nb::handle unit, nb::handle uv_set, nb::handle reflectance, nb::handle follow_links) {
  const std::filesystem::path file = path_of(path, "file of the room");
  Reading reading = reading_of(scale, up, scene, without, unit, uv_set, reflectance);
  reading.options.follow_links = flag_of(follow_links, "flag follow_links");
  return SharedRoom(aside<Room>([&] { return with_overrides(read_gltf(file, reading.options), reading); }));
}

// The memory of a bytes object or the like, held until the end.
class Buffer {
 public:
  explicit Buffer(nb::handle data) {
    if (PyObject_GetBuffer(data.ptr(), &view_, PyBUF_SIMPLE) == 0) return;
    clear_error_of_value();
    throw InputError("The data of the room is of the type " + std::string(nb::type_name(data.type()).c_str()) +
                     " (allowed: bytes, bytearray or memoryview, the content of a .glb or .gltf file). For the name of "
                     "a file use Room.from_gltf().");
  }
  ~Buffer() { PyBuffer_Release(&view_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  std::string_view bytes() const { return {static_cast<const char*>(view_.buf), static_cast<std::size_t>(view_.len)}; }

 private:
  Py_buffer view_{};
};

SharedRoom from_bytes(nb::handle data, nb::handle name, nb::handle scale, nb::handle up, nb::handle scene,
                      nb::handle without, nb::handle unit, nb::handle uv_set, nb::handle reflectance) {
  const Buffer buffer(data);
  const std::string source = text_of(name, "name of the room");
  const Reading reading = reading_of(scale, up, scene, without, unit, uv_set, reflectance);
  return SharedRoom(
      aside<Room>([&] { return with_overrides(parse_gltf(buffer.bytes(), source, reading.options), reading); }));
}

SharedRoom cuboid(nb::handle size, nb::handle reflectance, nb::handle floor, nb::handle ceiling, nb::handle walls,
                  nb::handle x0, nb::handle x1, nb::handle z0, nb::handle z1) {
  const auto value = [](nb::handle own, double otherwise, const char* of) {
    return own.is_none() ? otherwise : number_of(own, std::string("reflectance of the ") + of);
  };
  const double all = number_of(reflectance, "reflectance");
  const double of_walls = value(walls, all, "walls");
  return SharedRoom(
      make_cuboid(vec3_of(size, "size of the cuboid"),
                  {value(floor, all, "floor"), value(ceiling, all, "ceiling"), value(x0, of_walls, "wall x0"),
                   value(x1, of_walls, "wall x1"), value(z0, of_walls, "wall z0"), value(z1, of_walls, "wall z1")}));
}

std::string counted(std::size_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

std::string description(const SharedRoom& shared) {
  const Room& room = shared.room();
  std::string text = "<Room " + std::string(nb::repr(text_of_file_name(room.source)).c_str()) + ": " +
                     counted(room.surfaces.size(), "surface") + ", " + counted(room.emitters.size(), "emitter");
  if (!room.emitters.empty()) {
    const nb::object power = nb::str("{:.6g}").attr("format")(total_power(room));
    text += " (" + nb::cast<std::string>(power) + " " + std::string(power_unit(room.quantity)) + ")";
  }
  text += ", " + counted(room.receivers.size(), "receiver");
  const std::size_t areas = room.areas.size() + room.area_requests.size();
  if (areas > 0) text += ", " + counted(areas, "area");
  return text + ">";
}

// Signatures, for Python and for messages.
constexpr const char* from_gltf_signature =
    "def from_gltf(path: str | os.PathLike[str], *, scale: float = 1.0, up: str = 'y', scene: str = '', without: str | "
    "collections.abc.Sequence[str] = (), unit: str | None = None, uv_set: int | None = None, reflectance: dict[str, "
    "float] | None = None, follow_links: bool = False) -> Room";
constexpr const char* from_bytes_signature =
    "def from_bytes(data: bytes | bytearray | memoryview, *, name: str = 'bytes', scale: float = 1.0, up: str = 'y', "
    "scene: str = '', without: str | collections.abc.Sequence[str] = (), unit: str | None = None, uv_set: int | None = "
    "None, reflectance: dict[str, float] | None = None) -> Room";
constexpr const char* cuboid_signature =
    "def cuboid(size: numpy.typing.ArrayLike, reflectance: float = 0.5, *, floor: float | None = None, ceiling: float "
    "| None = None, walls: float | None = None, x0: float | None = None, x1: float | None = None, z0: float | None = "
    "None, z1: float | None = None) -> Room";

void def_making(RoomClass& room) {
  room.def(
          "__init__",
          [](SharedRoom* self, nb::handle source) {
            Room empty;
            empty.source = text_of(source, "source of the room");
            new (self) SharedRoom(std::move(empty));
          },
          any_arg("source") = "room", nb::sig("def __init__(self, source: str = 'room') -> None"),
          "A room without surfaces, for :meth:`add_surface`. `source` is its name in messages and reports.")
      .def_static("from_gltf", checked("Room.from_gltf", from_gltf_signature, &from_gltf), required("path"),
                  nb::kw_only(), any_arg("scale") = 1.0, any_arg("up") = "y", any_arg("scene") = "",
                  any_arg("without") = nb::make_tuple(), any_arg("unit") = nb::none(), any_arg("uv_set") = nb::none(),
                  any_arg("reflectance") = nb::none(), any_arg("follow_links") = false, other_keywords(),
                  nb::sig(from_gltf_signature),
                  R"(Reads a room from a .gltf or .glb file.

Args:
    path: The file.
    scale: Length of the file's unit, m: 0.01 for centimetres.
    up: "y", as in glTF, or "z": the vertical axis of the file.
    scene: Name of the scene; empty: the file's default scene.
    without: Names or patterns ("*", "?") of nodes (with all below them), meshes, materials or surfaces to leave out.
    unit: "lm" or "W", in which the file's powers are taken. Default: as stated in the file, else lm.
    uv_set: n of TEXCOORD_n for the tiles. Default: 1 if present, else 0.
    reflectance: New reflectances of materials or surfaces by name or pattern, as by :meth:`set_reflectance`; their
        textures may be missing.
    follow_links: Whether buffers and images may be symbolic links that lead out of the file's folder.

Raises:
    InputError: The file cannot be read or is not valid.)")
      .def_static("from_bytes", checked("Room.from_bytes", from_bytes_signature, &from_bytes), required("data"),
                  nb::kw_only(), any_arg("name") = "bytes", any_arg("scale") = 1.0, any_arg("up") = "y",
                  any_arg("scene") = "", any_arg("without") = nb::make_tuple(), any_arg("unit") = nb::none(),
                  any_arg("uv_set") = nb::none(), any_arg("reflectance") = nb::none(), other_keywords(),
                  nb::sig(from_bytes_signature),
                  R"(Reads a room from the content of a .glb file, or of a .gltf file with all its data embedded.

Files that the content names are refused: in memory there is no folder for them. `name` stands for the room in
messages and reports; the other arguments are those of :meth:`from_gltf`.)")
      .def_static("cuboid", checked("Room.cuboid", cuboid_signature, &cuboid), required("size"),
                  any_arg("reflectance") = 0.5, nb::kw_only(), any_arg("floor") = nb::none(),
                  any_arg("ceiling") = nb::none(), any_arg("walls") = nb::none(), any_arg("x0") = nb::none(),
                  any_arg("x1") = nb::none(), any_arg("z0") = nb::none(), any_arg("z1") = nb::none(), other_keywords(),
                  nb::sig(cuboid_signature),
                  R"(An empty cuboid from the origin to size = (x, y, z), m, y upwards.

Its six surfaces are "floor", "ceiling", "wall_x0", "wall_x1", "wall_z0" and "wall_z1" (x0: at x = 0; x1: opposite).

Args:
    size: Edges along x, y (height) and z, m.
    reflectance: Share of the light that is reflected, 0 to 1, of surfaces without a value of their own.
    floor, ceiling: Their reflectances.
    walls: That of the four walls.
    x0, x1, z0, z1: Those of single walls.)");
}

void def_content(RoomClass& room) {
  room.def_prop_ro(
          "source", [](const SharedRoom& shared) { return text_of_file_name(shared.room().source); },
          nb::sig("def source(self) -> str"), "Origin of the room: the name of its file, 'cuboid', …")
      .def_prop_ro(
          "unit", [](const SharedRoom& shared) { return std::string(power_unit(shared.room().quantity)); },
          "'lm' or 'W': the unit of the powers of its emitters.")
      .def_prop_ro(
          "irradiance_unit",
          [](const SharedRoom& shared) { return std::string(irradiance_unit(shared.room().quantity)); },
          "'lx' or 'W/m^2'.")
      .def_prop_ro(
          "ignored", [](const SharedRoom& shared) { return texts_of(shared.room().ignored); },
          "What the file contains and the room does not model: a sentence or two each.")
      .def_prop_ro(
          "overrides", [](const SharedRoom& shared) { return shared.room().overrides; },
          "Changes made to the room after reading: one sentence each.")
      .def(
          "copy", [](const SharedRoom& shared) { return SharedRoom(shared.kept()); },
          "A room of its own with the same content; memory is shared until one of both changes.")
      .def("__copy__", [](const SharedRoom& shared) { return SharedRoom(shared.kept()); })
      .def(
          "__deepcopy__", [](const SharedRoom& shared, nb::handle) { return SharedRoom(shared.kept()); },
          nb::arg("memo"))
      .def("__repr__", &description)
      .def(
          "write_gltf",
          [](const SharedRoom& shared, nb::handle path) {
            const std::filesystem::path file = path_of(path, "file to write");
            const auto kept = shared.kept();
            aside<bool>([&] {
              write_gltf(kept->room, file);
              return true;
            });
          },
          any_arg("path"), nb::sig("def write_gltf(self, path: str | os.PathLike[str]) -> None"),
          R"(Writes the room as a .glb (binary) or .gltf (JSON, data embedded) file.

:meth:`from_gltf` returns the same room, except that coordinates are rounded to float32 and reflectance maps to images
of 8 bits. Points of calculation areas are written as receivers.

Raises:
    InputError: The name ends in neither .glb nor .gltf.
    RuntimeError: The file cannot be written.)");
}

void def_overrides(RoomClass& room) {
  room.def(
          "set_reflectance",
          [](SharedRoom& shared, nb::handle name, nb::handle value) {
            const std::string which = text_of(name, "name of a material or surface");
            const double reflectance = number_of(value, "reflectance");
            shared.change([&](Room& changed) { set_reflectance(changed, which, reflectance); });
          },
          any_arg("name"), any_arg("value"), nb::sig("def set_reflectance(self, name: str, value: float) -> None"),
          R"(Sets the reflectance (0 to 1) of surfaces; it replaces textures.

Args:
    name: Of a material, which means all its surfaces, or of a surface; or a pattern with "*", "?" and "[…]".
        "material:NAME" and "surface:NAME" mean only one of both.
    value: Share of the light that is reflected.)")
      .def(
          "limit_reflectance",
          [](SharedRoom& shared, nb::handle highest) {
            const double limit = number_of(highest, "highest reflectance");
            shared.change([&](Room& changed) { limit_reflectance(changed, limit); });
          },
          any_arg("highest"), nb::sig("def limit_reflectance(self, highest: float) -> None"),
          "Lowers every reflectance above `highest` (0 to 1) to it, in textures too.")
      .def(
          "measure_only",
          [](SharedRoom& shared, nb::handle names) {
            const std::vector<std::string> which = texts_of(names, "names of the surfaces that are measured");
            if (which.empty())
              throw InputError(
                  "The list of the names of the surfaces that are measured is empty (allowed: one name or more). Give "
                  "names or patterns of materials or surfaces.");
            Room changed = shared.room();
            measure_only(changed, which);
            shared.replace(std::move(changed));
          },
          any_arg("names"), nb::sig("def measure_only(self, names: str | collections.abc.Sequence[str]) -> None"),
          "Measures only the surfaces of these names or patterns (of materials or surfaces); the others only reflect "
          "and have no tiles in the results.")
      .def(
          "set_delay",
          [](SharedRoom& shared, nb::handle name, nb::handle seconds) {
            const std::string which = text_of(name, "name of an emitter");
            const double delay = number_of(seconds, "delay");
            shared.change([&](Room& changed) { set_delay(changed, which, delay); });
          },
          any_arg("name"), any_arg("seconds"), nb::sig("def set_delay(self, name: str, seconds: float) -> None"),
          "Sets the delay, s (0 or more), of the light of the emitters of this name or pattern behind the signal, for "
          "impulse responses.")
      .def(
          "set_maintenance_factor",
          [](SharedRoom& shared, nb::handle factor) {
            const double share = number_of(factor, "maintenance factor");
            shared.change([&](Room& changed) { set_maintenance_factor(changed, share); });
          },
          any_arg("factor"), nb::sig("def set_maintenance_factor(self, factor: float) -> None"),
          R"(Sets the share of their new power (above 0, up to 1) that the emitters of the room keep.

Their powers are multiplied by it: results are maintained values. Emitters with a factor of their own keep it; emitters
that are added later have none: call it last.)");
}

}  // namespace

void bind_room(nb::module_& module) {
  RoomClass room(module, "Room",
                 "A room: diffusely reflecting surfaces, emitters, receivers, calculation areas.\n\n"
                 "Metres, right-handed, Y up as in glTF. A Result keeps the room that it was made of: later changes do "
                 "not touch it.");
  def_making(room);
  def_content(room);
  def_overrides(room);
  bind_surfaces_of_room(module, room);
  bind_emitters_of_room(module, room);
  bind_receivers_of_room(module, room);
  bind_areas_of_room(module, room);
  bind_check(module, room);
  bind_paths(module, room);
}

}  // namespace lichtmc::python
