// The parts of the class Room, and what they share.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "shared_room.hpp"
#include "views.hpp"

namespace lichtmc::python {

using RoomClass = nb::class_<SharedRoom>;

void bind_surfaces_of_room(nb::module_& module, RoomClass& room);
void bind_emitter_shapes(nb::module_& module);
void bind_emitters_of_room(nb::module_& module, RoomClass& room);
void bind_receivers_of_room(nb::module_& module, RoomClass& room);
void bind_areas_of_room(nb::module_& module, RoomClass& room);
void bind_check(nb::module_& module, RoomClass& room);
void bind_paths(nb::module_& module, RoomClass& room);

// Issues a lichtmc.RoomWarning, as of the line that called the function. Throws nb::python_error if warnings are
// errors.
void warn_of_room(const std::string& text);

using KeptRoomPtr = std::shared_ptr<const KeptRoom>;

// A room of this source and quantity that is valid, with nothing in it but a triangle and an emitter: parts are put
// into it to be checked with the library's messages before they enter the room.
Room room_for_checks(const Room& like);

// What the sources contain and the rooms do not model, as sentences.
std::vector<std::string> texts_of(const std::vector<Ignored>& ignored);

// Three numbers as a new array, shape (3,).
inline View<double> array_of(const glm::dvec3& v) {
  return owned<double, 1>({v.x, v.y, v.z}, {3});
}

// Views (n, 2) or (n, 3) of points.
template <class Kept, class Point>
View<double> points_view(const std::shared_ptr<Kept>& kept, const std::vector<Point>& points) {
  static constexpr Point none{};
  const std::size_t shape[2] = {points.size(), static_cast<std::size_t>(Point::length())};
  return View<double>(points.empty() ? &none.x : &points.front().x, 2, shape, keep(kept));
}

}  // namespace lichtmc::python
