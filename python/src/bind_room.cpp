// Rooms: how they are made.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <string>

#include "bindings.hpp"
#include "lichtmc/cuboid.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/overrides.hpp"
#include "shared_room.hpp"
#include "vectors.hpp"

namespace lichtmc::python {

void bind_room(nb::module_& module) {
  nb::class_<SharedRoom>(module, "Room",
                         "A room: diffusely reflecting surfaces, emitters, receivers, calculation areas.\n\n"
                         "Metres, right-handed, Y up as in glTF. A Result keeps the room that it was made of: later "
                         "changes do not touch it.")
      .def_static(
          "from_gltf", [](const std::filesystem::path& path) { return SharedRoom(read_gltf(path)); }, nb::arg("path"),
          "Reads a room from a .gltf or .glb file.")
      .def_static(
          "cuboid",
          [](const ArrayLike& size, double reflectance) {
            return SharedRoom(make_cuboid(vec3_of(size, "size of the cuboid"), uniform_reflectance(reflectance)));
          },
          nb::arg("size"), nb::arg("reflectance") = 0.5,
          "An empty cuboid from the origin to size = (x, y, z) in m, y upwards, that reflects the same share of the "
          "light on all six walls.")
      .def(
          "add_emitter",
          [](SharedRoom& room, nb::handle position, nb::handle axis, double exponent, double power,
             const std::string& name) {
            Emitter emitter{name, power,
                            LambertEmitter{vec3_of(position, "position"), vec3_of(axis, "axis"), exponent}};
            room.change([&](Room& changed) { add_emitter(changed, emitter, Quantity::photometric); });
          },
          nb::arg("position"), nb::arg("axis"), nb::arg("exponent"), nb::arg("power"), nb::arg("name"));
}

}  // namespace lichtmc::python
