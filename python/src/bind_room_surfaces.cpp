// The surfaces of a room: made from arrays of triangles, and shown as arrays.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "arguments.hpp"
#include "checked_call.hpp"
#include "lichtmc/error.hpp"
#include "room_parts.hpp"
#include "vectors.hpp"

namespace lichtmc::python {

namespace {

// One surface of a room, as it was when it was asked for.
struct SurfaceOfRoom {
  KeptRoomPtr kept;
  std::size_t index = 0;

  const Surface& surface() const { return kept->room.surfaces[index]; }
};

// A mesh as given: checked, not yet divided into surfaces.
struct Mesh {
  std::vector<glm::dvec3> vertices;
  std::vector<glm::dvec2> uvs;  // one per vertex, or none
  std::vector<glm::uvec3> faces;
};

std::vector<glm::dvec2> uvs_of(nb::handle value, std::size_t vertices) {
  if (value.is_none()) return {};
  const DoubleArray array = doubles_of(value, "array of texture coordinates");
  if (array.ndim() != 2 || array.shape(0) != vertices || array.shape(1) != 2)
    throw InputError("The array of texture coordinates has the shape " + shape_text(array) + " (allowed: (" +
                     std::to_string(vertices) + ", 2), one row for each vertex). Give u, v in each row.");
  std::vector<glm::dvec2> uvs(vertices);
  for (std::size_t k = 0; k < vertices; ++k) uvs[k] = {array.data()[2 * k], array.data()[2 * k + 1]};
  return uvs;
}

std::vector<glm::uvec3> faces_of(nb::handle value, std::size_t vertices) {
  const WholeArray array = whole_numbers_of(value, "array of faces");
  if (array.ndim() != 2 || array.shape(1) != 3 || array.shape(0) == 0)
    throw InputError("The array of faces has the shape " + shape_text(array) +
                     " (allowed: (m, 3), at least one row). Give three indices of vertices in each row; divide faces "
                     "with more corners into triangles.");
  std::vector<glm::uvec3> faces(array.shape(0));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t index = array.data()[3 * f + k];
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
        throw InputError("An index in row " + std::to_string(f) + " of the array of faces is " + std::to_string(index) +
                         " (allowed: 0 to " + std::to_string(vertices - 1) +
                         ", rows of the array of vertices). Count vertices from 0.");
      faces[f][static_cast<int>(k)] = static_cast<std::uint32_t>(index);
    }
  }
  return faces;
}

Mesh mesh_of(nb::handle vertices, nb::handle faces, nb::handle uvs) {
  const DoubleArray array = doubles_of(vertices, "array of vertices");
  if (array.ndim() != 2 || array.shape(1) != 3 || array.shape(0) < 3)
    throw InputError("The array of vertices has the shape " + shape_text(array) +
                     " (allowed: (n, 3), at least three rows). Give x, y, z in each row, in m.");
  Mesh mesh;
  mesh.vertices = rows_of_3(vertices, "array of vertices");
  mesh.uvs = uvs_of(uvs, mesh.vertices.size());
  mesh.faces = faces_of(faces, mesh.vertices.size());
  return mesh;
}

// As for files: triangles whose corners lie on a line, but for rounding, are left out and counted.
bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double longest = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
  const double reach = std::max({glm::length(a), glm::length(b), glm::length(c)});
  const double area = glm::length(glm::cross(b - a, c - a));
  return area > 16.0 * 0x1p-53 * longest * (longest + reach) || std::isnan(area) || std::isinf(area);
}

constexpr std::uint32_t no_index = 0xFFFFFFFF;

// The surface of these faces, with the vertices that they use. local: no_index for each vertex, and so afterwards.
Surface surface_of(const Mesh& mesh, const std::vector<std::uint32_t>& chosen, std::vector<std::uint32_t>& local) {
  Surface surface;
  std::vector<std::uint32_t> used;
  for (const std::uint32_t f : chosen) {
    const glm::uvec3& face = mesh.faces[f];
    if (!has_area(mesh.vertices[face.x], mesh.vertices[face.y], mesh.vertices[face.z])) {
      ++surface.without_area;
      continue;
    }
    glm::uvec3 triangle;
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& index = local[face[k]];
      if (index == no_index) {
        index = static_cast<std::uint32_t>(used.size());
        used.push_back(face[k]);
      }
      triangle[k] = index;
    }
    surface.triangles.push_back(triangle);
  }
  surface.positions.reserve(used.size());
  for (const std::uint32_t n : used) {
    surface.positions.push_back(mesh.vertices[n]);
    if (!mesh.uvs.empty()) surface.uvs.push_back(mesh.uvs[n]);
    local[n] = no_index;
  }
  return surface;
}

// The faces of each surface. of_face: (m,) whole numbers 0 … k − 1, or None: all of one surface.
std::vector<std::vector<std::uint32_t>> faces_by_surface(nb::handle of_face, std::size_t faces) {
  std::vector<std::vector<std::uint32_t>> chosen(1);
  if (of_face.is_none()) {
    for (std::size_t f = 0; f < faces; ++f) chosen[0].push_back(static_cast<std::uint32_t>(f));
    return chosen;
  }
  const WholeArray array = whole_numbers_of(of_face, "array of the surfaces of the faces");
  if (array.ndim() != 1 || array.shape(0) != faces)
    throw InputError("The array of the surfaces of the faces has the shape " + shape_text(array) + " (allowed: (" +
                     std::to_string(faces) + ",), one number for each face). Give the number of its surface for each.");
  std::int64_t last = 0;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::int64_t number = array.data()[f];
    if (number < 0 || static_cast<std::uint64_t>(number) >= faces)
      throw InputError("The number of the surface of face " + std::to_string(f) + " is " + std::to_string(number) +
                       " (allowed: 0 to " + std::to_string(faces - 1) +
                       ": there are no more surfaces than faces). Number the surfaces from 0 on.");
    last = std::max(last, number);
  }
  chosen.resize(static_cast<std::size_t>(last) + 1);
  for (std::size_t f = 0; f < faces; ++f)
    chosen[static_cast<std::size_t>(array.data()[f])].push_back(static_cast<std::uint32_t>(f));
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (chosen[k].empty())
      throw InputError("Surface " + std::to_string(k) +
                       " has no faces (allowed: at least one for each number from 0 to " + std::to_string(last) +
                       "). Number the surfaces without gaps.");
  }
  return chosen;
}

std::vector<std::string> names_of(nb::handle names, std::size_t count) {
  std::vector<std::string> texts;
  if (names.is_none()) {
    for (std::size_t k = 0; k < count; ++k) texts.push_back("surface_" + std::to_string(k));
    return texts;
  }
  texts = texts_of(names, "list of the names of the surfaces");
  if (texts.size() != count)
    throw InputError("The number of names is " + std::to_string(texts.size()) + " (allowed: " + std::to_string(count) +
                     ", one for each surface). Give a name for each number of a surface.");
  return texts;
}

// Throws InputError if surfaces are not valid, alone or among themselves. like: of the room's source.
void check_surfaces(const Room& like, std::vector<Surface>& surfaces) {
  Room check = room_for_checks(like);
  check.surfaces.swap(surfaces);
  check_room(check);
  check.surfaces.swap(surfaces);
}

SharedRoom from_triangles(nb::handle vertices, nb::handle faces, nb::handle reflectance, nb::handle surfaces,
                          nb::handle names, nb::handle two_sided, nb::handle uvs, nb::handle source) {
  const Mesh mesh = mesh_of(vertices, faces, uvs);
  const auto chosen = faces_by_surface(surfaces, mesh.faces.size());
  const std::vector<std::string> texts = names_of(names, chosen.size());
  const std::vector<double> shares = numbers_of(reflectance, "reflectance", chosen.size(), "surface");
  const bool both = flag_of(two_sided, "flag two_sided");
  Room room;
  room.source = text_of(source, "source of the room");
  std::vector<std::uint32_t> local(mesh.vertices.size(), no_index);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    Surface surface = surface_of(mesh, chosen[k], local);
    surface.name = texts[k];
    surface.reflectance = shares[k];
    surface.sides = both ? Sides::both : Sides::one;
    room.surfaces.push_back(std::move(surface));
  }
  check_surfaces(room, room.surfaces);
  return SharedRoom(std::move(room));
}

void add_surface(SharedRoom& room, nb::handle name, nb::handle vertices, nb::handle faces, nb::handle reflectance,
                 nb::handle material, nb::handle two_sided, nb::handle uvs, nb::handle measured) {
  const Mesh mesh = mesh_of(vertices, faces, uvs);
  std::vector<std::uint32_t> local(mesh.vertices.size(), no_index);
  std::vector<Surface> added{surface_of(mesh, faces_by_surface(nb::none(), mesh.faces.size())[0], local)};
  Surface& surface = added.front();
  surface.name = text_of(name, "name of the surface");
  surface.material = text_of(material, "material");
  surface.reflectance = number_of(reflectance, "reflectance");
  surface.sides = flag_of(two_sided, "flag two_sided") ? Sides::both : Sides::one;
  surface.measured = flag_of(measured, "flag measured");
  check_surfaces(room.room(), added);
  for (const Surface& other : room.room().surfaces) {
    if (surface.name == other.name)
      throw InputError("There is already a surface with the name '" + surface.name + "' in " + room.room().source +
                       " (allowed: one of each name). Choose another name.");
  }
  room.change_surfaces([&](Room& changed) { changed.surfaces.push_back(std::move(surface)); });
}

View<std::uint32_t> faces_view(const SurfaceOfRoom& of) {
  static_assert(sizeof(glm::uvec3) == 3 * sizeof(std::uint32_t));
  static constexpr glm::uvec3 none{};
  const std::vector<glm::uvec3>& faces = of.surface().triangles;
  const std::size_t shape[2] = {faces.size(), 3};
  return View<std::uint32_t>(faces.empty() ? &none.x : &faces.front().x, 2, shape, keep(of.kept));
}

void bind_surface(nb::module_& module) {
  nb::class_<SurfaceOfRoom>(module, "Surface",
                            "A surface of a room: triangles with one reflectance, or one that varies by a texture.")
      .def_prop_ro(
          "name", [](const SurfaceOfRoom& of) { return of.surface().name; }, "Its name, unique in the room.")
      .def_prop_ro(
          "material", [](const SurfaceOfRoom& of) { return of.surface().material; },
          "Name of its material; may be empty.")
      .def_prop_ro(
          "reflectance", [](const SurfaceOfRoom& of) { return of.surface().reflectance; },
          "Share of the light that it reflects, 0 to 1; the mean if a texture varies it.")
      .def_prop_ro(
          "two_sided", [](const SurfaceOfRoom& of) { return of.surface().sides == Sides::both; },
          "Whether front and back have tiles of their own.")
      .def_prop_ro(
          "measured", [](const SurfaceOfRoom& of) { return of.surface().measured; },
          "Whether results contain it; other surfaces only reflect.")
      .def_prop_ro(
          "area", [](const SurfaceOfRoom& of) { return surface_area(of.surface()); }, "Its area, m², of one side.")
      .def_prop_ro(
          "vertices", [](const SurfaceOfRoom& of) { return points_view(of.kept, of.surface().positions); }, has_owner,
          "Positions of its vertices, m, float64 (n, 3).")
      .def_prop_ro("faces", &faces_view, has_owner,
                   "Its triangles, indices of vertices, uint32 (m, 3); counter-clockwise seen from the front.")
      .def_prop_ro(
          "uvs",
          [](const SurfaceOfRoom& of) -> std::optional<View<double>> {
            if (of.surface().uvs.empty()) return std::nullopt;
            return points_view(of.kept, of.surface().uvs);
          },
          has_owner, "Texture coordinates for the tiles, float64 (n, 2); None if it has none.")
      .def("__repr__", [](const SurfaceOfRoom& of) {
        const Surface& surface = of.surface();
        const nb::object text = nb::str("<Surface {!r}: {:.4g} m², reflectance {:.4g}, {} triangle{}>")
                                    .attr("format")(surface.name, surface_area(surface), surface.reflectance,
                                                    surface.triangles.size(), surface.triangles.size() == 1 ? "" : "s");
        return nb::cast<std::string>(text);
      });
}

// Signatures, for Python and for messages.
constexpr const char* from_triangles_signature =
    "def from_triangles(vertices: numpy.typing.ArrayLike, faces: numpy.typing.ArrayLike, reflectance: "
    "numpy.typing.ArrayLike = 0.5, *, surfaces: numpy.typing.ArrayLike | None = None, names: "
    "collections.abc.Sequence[str] | None = None, two_sided: bool = False, uvs: numpy.typing.ArrayLike | None = None, "
    "source: str = 'triangles') -> Room";
constexpr const char* add_surface_signature =
    "def add_surface(self, name: str, vertices: numpy.typing.ArrayLike, faces: numpy.typing.ArrayLike, reflectance: "
    "float = 0.5, *, material: str = '', two_sided: bool = False, uvs: numpy.typing.ArrayLike | None = None, measured: "
    "bool = True) -> None";

}  // namespace

void bind_surfaces_of_room(nb::module_& module, RoomClass& room) {
  bind_surface(module);
  room.def_static("from_triangles", checked("Room.from_triangles", from_triangles_signature, &from_triangles),
                  required("vertices"), required("faces"), any_arg("reflectance") = 0.5, nb::kw_only(),
                  any_arg("surfaces") = nb::none(), any_arg("names") = nb::none(), any_arg("two_sided") = false,
                  any_arg("uvs") = nb::none(), any_arg("source") = "triangles", other_keywords(),
                  nb::sig(from_triangles_signature),
                  R"(A room from the arrays of a mesh of triangles.

Surfaces reflect on both sides; the front, from which the corners of a face are seen counter-clockwise, should look
into the room. Faces whose corners lie on a line are left out.

Args:
    vertices: Positions, m, (n, 3).
    faces: Indices of vertices, whole numbers, (m, 3).
    reflectance: Share of the light that is reflected, 0 to 1: a number, or one for each surface, (k,).
    surfaces: The number of the surface of each face, 0 to k − 1, (m,). Default: one surface.
    names: Of the surfaces, k texts. Default: "surface_0", "surface_1", …
    two_sided: Whether front and back have tiles of their own.
    uvs: Texture coordinates for the tiles, (n, 2). Default: tiles are laid out by the geometry.
    source: Name of the room in messages and reports.

Raises:
    InputError: A shape, an index, a number or a name is not valid.)")
      .def("add_surface", checked("add_surface", add_surface_signature, &add_surface), required("name"),
           required("vertices"), required("faces"), any_arg("reflectance") = 0.5, nb::kw_only(),
           any_arg("material") = "", any_arg("two_sided") = false, any_arg("uvs") = nb::none(),
           any_arg("measured") = true, other_keywords(), nb::sig(add_surface_signature),
           R"(Adds a surface of triangles; arrays as in :meth:`from_triangles`.

Args:
    name: Its name, which no other surface has.
    vertices: Positions, m, (n, 3).
    faces: Indices of these vertices, whole numbers, (m, 3).
    reflectance: Share of the light that is reflected, 0 to 1.
    material: A name for the material.
    two_sided: Whether front and back have tiles of their own.
    uvs: Texture coordinates for the tiles, (n, 2).
    measured: Whether results contain it; else it only reflects.)")
      .def_prop_ro(
          "surfaces",
          [](const SharedRoom& shared) {
            std::vector<SurfaceOfRoom> surfaces;
            for (std::size_t k = 0; k < shared.room().surfaces.size(); ++k) surfaces.push_back({shared.kept(), k});
            return surfaces;
          },
          "Its surfaces, a list of :class:`Surface`.");
}

}  // namespace lichtmc::python
