#include "lichtmc/room.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "room/emission.hpp"
#include "room/emitter_shape.hpp"
#include "room/room_check.hpp"

namespace lichtmc {

namespace {

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

using lichtmc::to_text;

std::string to_text(const glm::dvec3& v) {
  return "(" + to_text(v.x) + ", " + to_text(v.y) + ", " + to_text(v.z) + ")";
}

// Reports an invalid value of a room: "The reflectance of surface 'x' in room.glb is 2 (allowed: 0 to 1). Do this."
[[noreturn]] void refuse(const Room& room, const std::string& what, const std::string& value,
                         const std::string& allowed, const std::string& remedy) {
  throw InputError("The " + what + " in " + room.source + " is " + value + " (allowed: " + allowed + "). " + remedy);
}

void require(bool valid, const Room& room, const std::string& what, double value, const std::string& allowed,
             const std::string& remedy) {
  if (!valid) refuse(room, what, to_text(value), allowed, remedy);
}

void check_size(const Room& room, const TextureMap& map, const std::string& of) {
  const std::size_t pixels = std::size_t{map.columns} * map.rows;
  if (pixels == 0 || map.values.size() != pixels || (!map.colours.empty() && map.colours.size() != pixels)) {
    const std::size_t number = map.values.size() != pixels ? map.values.size() : map.colours.size();
    refuse(room, "number of values " + of, std::to_string(number),
           "columns times rows, " + std::to_string(map.columns) + " × " + std::to_string(map.rows) + ", at least one",
           "Give one for each place.");
  }
}

void check_fraction(const Room& room, double value, const std::string& of) {
  require(value >= 0.0 && value <= 1.0, room, "value " + of, value, "0 to 1",
          "Give the fraction of the flux that is reflected.");
}

void check_reflectance_map(const Room& room, const ReflectanceMap& map) {
  const std::string of = "of the reflectance map " + in_quotes(map.name);
  check_size(room, map, of);
  for (const float value : map.values) {
    if (!(value >= 0.0F && value <= 1.0F)) check_fraction(room, double{value}, of);
  }
  for (const glm::vec3& colour : map.colours) {
    for (int k = 0; k < 3; ++k) {
      if (!(colour[k] >= 0.0F && colour[k] <= 1.0F)) check_fraction(room, double{colour[k]}, of);
    }
  }
}

void check_emission_map(const Room& room, const EmissionMap& map) {
  const std::string of = "of the emission map " + in_quotes(map.name);
  check_size(room, map, of);
  for (const float value : map.values) {
    if (!(value >= 0.0F) || !std::isfinite(value))
      refuse(room, "value " + of, to_text(double{value}), "finite numbers, 0 or more", "Give luminances.");
  }
}

// map: index of a map of which the room has `count`; kind: "reflectance" or "emission".
void check_use_of_map(const Room& room, std::size_t map, std::size_t count, const std::vector<glm::dvec2>& uvs,
                      const Surface& surface, const std::string& kind) {
  const std::string of = "of surface " + in_quotes(surface.name);
  if (map >= count) {
    refuse(room, "number of the " + kind + " map " + of, std::to_string(map), "below " + std::to_string(count),
           "Give the index of " + std::string(kind == "emission" ? "an " : "a ") + kind + " map.");
  }
  if (uvs.size() != surface.positions.size()) {
    refuse(room, "number of coordinates on its " + kind + " map " + of, std::to_string(uvs.size()),
           std::to_string(surface.positions.size()) + ", one per position", "Give one for each position.");
  }
  for (const glm::dvec2& uv : uvs) {
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
      refuse(room, "coordinate on its " + kind + " map " + of, "(" + to_text(uv.x) + ", " + to_text(uv.y) + ")",
             "finite numbers", "Unwrap the mesh again.");
    }
  }
}

void check_vertex_colours(const Room& room, const Surface& surface, const std::string& of) {
  if (surface.vertex_colours.empty()) return;
  if (surface.vertex_colours.size() != surface.positions.size()) {
    refuse(room, "number of vertex colours " + of, std::to_string(surface.vertex_colours.size()),
           std::to_string(surface.positions.size()) + ", one per position, or none", "Give one for each position.");
  }
  for (const glm::dvec3& colour : surface.vertex_colours) {
    for (int k = 0; k < 3; ++k) {
      require(colour[k] >= 0.0 && colour[k] <= 1.0, room, "vertex colour " + of, colour[k], "0 to 1",
              "Give the fraction of the flux that is reflected.");
    }
  }
  require(surface.highest_reflectance >= 0.0 && surface.highest_reflectance <= 1.0, room, "highest reflectance " + of,
          surface.highest_reflectance, "0 to 1", "Give the fraction of the incident flux that it reflects at most.");
}

void check_surface(const Room& room, const Surface& surface) {
  const std::string of = "of surface " + in_quotes(surface.name);
  require(surface.reflectance >= 0.0 && surface.reflectance <= 1.0, room,
          "reflectance " + of + " (material " + in_quotes(surface.material) + ")", surface.reflectance, "0 to 1",
          "Give the fraction of the incident flux that it reflects.");
  if (!surface.uvs.empty() && surface.uvs.size() != surface.positions.size()) {
    refuse(room, "number of texture coordinates " + of, std::to_string(surface.uvs.size()),
           std::to_string(surface.positions.size()) + ", one per position, or none", "Give one for each position.");
  }
  if (surface.reflectance_map) {
    check_use_of_map(room, *surface.reflectance_map, room.reflectance_maps.size(), surface.reflectance_uvs, surface,
                     "reflectance");
  }
  check_vertex_colours(room, surface, of);
  for (const glm::uvec3& triangle : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      if (triangle[k] >= surface.positions.size()) {
        refuse(room, "index of a triangle " + of, std::to_string(triangle[k]),
               "below " + std::to_string(surface.positions.size()), "Give the index of a position of the surface.");
      }
      const glm::dvec3& position = surface.positions[triangle[k]];
      if (!finite(position))
        refuse(room, "position of a corner " + of, to_text(position), "finite numbers", "Export the mesh again.");
    }
  }
}

void check_position(const Room& room, const glm::dvec3& position, const std::string& of) {
  if (!finite(position)) refuse(room, "position " + of, to_text(position), "finite numbers", "Place it in the room.");
}

void check_axis(const Room& room, const glm::dvec3& axis, const std::string& of) {
  if (!finite(axis) || axis == glm::dvec3(0.0))
    refuse(room, "direction " + of, to_text(axis), "finite numbers, not all 0", "Give it a direction.");
}

// Of a luminaire: unit vectors at right angles, to the rounding of rotations in float.
void check_axes(const Room& room, const MeasuredEmitter& shape, const std::string& of) {
  constexpr double rounding = 1e-5;
  for (const auto* axis : {&shape.axis, &shape.c0, &shape.c90}) {
    check_axis(room, *axis, of);
    require(std::abs(glm::length(*axis) - 1.0) < rounding, room, "length of an axis " + of, glm::length(*axis), "1",
            "Give unit vectors.");
  }
  for (const auto& [a, b] : {std::pair{&shape.axis, &shape.c0}, {&shape.axis, &shape.c90}, {&shape.c0, &shape.c90}}) {
    require(std::abs(glm::dot(*a, *b)) < rounding, room, "cosine of the angle between two axes " + of, glm::dot(*a, *b),
            "0", "Give axes at right angles to each other.");
  }
}

void check_opening(const Room& room, const LuminousOpening& opening, const std::string& of) {
  const bool valid = finite(opening.size_m) &&
                     std::min({opening.size_m.x, opening.size_m.y, opening.size_m.z}) >= 0.0 &&
                     opening.largest_m() > 0.0;
  if (!valid)
    refuse(room, "size in m of the opening " + of, to_text(opening.size_m), "finite numbers, 0 or more, not all 0",
           "Give its size, or no opening.");
}

void check_law(const Room& room, const std::optional<LawFault>& fault, const std::string& of) {
  if (fault) refuse(room, fault->what + " " + of, to_text(fault->value), fault->allowed, fault->remedy);
}

template <PointShape Shape>
void check_shape(const Room& room, const Shape& shape, const std::string& of) {
  check_position(room, shape.position, of);
  if constexpr (requires { shape.axis; }) check_axis(room, shape.axis, of);
  if constexpr (requires { shape.c90; }) check_axes(room, shape, of);
  if (const LuminousOpening* opening = opening_of(shape)) check_opening(room, *opening, of);
  check_law(room, shape.law().fault(), of);
}

template <SurfaceShape Shape>
void check_shape(const Room& room, const Shape& shape, const std::string& of) {
  if (shape.surface >= room.surfaces.size()) {
    refuse(room, "number of the surface " + of, std::to_string(shape.surface),
           "below " + std::to_string(room.surfaces.size()), "Give the index of a surface.");
  }
  require(surface_area(room.surfaces[shape.surface]) > 0.0, room,
          "area in m² of the emitting surface " + in_quotes(room.surfaces[shape.surface].name) + " " + of, 0.0,
          "above 0", "Give it triangles that have an area, or remove the emitter.");
  check_law(room, shape.law().fault(), of);
  if (!shape.emission_map) return;
  check_use_of_map(room, *shape.emission_map, room.emission_maps.size(), shape.emission_uvs,
                   room.surfaces[shape.surface], "emission");
  const EmissionMap& map = room.emission_maps[*shape.emission_map];
  require(emits(room.surfaces[shape.surface], map, shape.emission_uvs), room,
          "mean of the emission map " + in_quotes(map.name) + " " + of, 0.0, "above 0",
          "Give the surface coordinates on a part of the map that is not black, or remove the emitter.");
}

// Its edges span a part of the plane at right angles to the normal.
void check_cell(const Room& room, const Receiver& receiver) {
  if (!receiver.is_cell()) return;
  const glm::dvec3 across = glm::cross(receiver.cell_u, receiver.cell_v);
  const double sides = glm::length(receiver.cell_u) * glm::length(receiver.cell_v);
  constexpr double parallel = 1e-6;  // sine of the angle between the edges
  constexpr double tilted = 1e-6;    // sine of the angle of their plane to that of the receiver
  const double sine = glm::length(across) / sides;
  require(std::isfinite(sides) && sine > parallel, room,
          "sine of the angle between the edges of the cell of receiver " + in_quotes(receiver.name), sine,
          "above 1e-6, with two edges of finite length", "Give two edges in different directions.");
  const double tilt = glm::length(glm::cross(glm::normalize(across), glm::normalize(receiver.normal)));
  require(tilt < tilted, room,
          "sine of the angle between the normal of receiver " + in_quotes(receiver.name) + " and that of its cell",
          tilt, "below 1e-6", "Give edges at right angles to the normal.");
}

// Of a cylinder or half cylinder.
void check_law(const Room& room, const Receiver& receiver) {
  const bool is_half = receiver.law == ReceiverLaw::semicylindrical;
  const std::string of =
      "of the " + std::string(is_half ? "semicylindrical" : "cylindrical") + " receiver " + in_quotes(receiver.name);
  require(receiver.half_angle_deg == 90.0, room, "field of view (half angle in degrees) " + of, receiver.half_angle_deg,
          "90, which stands for all directions", "Leave it out.");
  require(!receiver.is_cell(), room, "greatest edge in m of the cell " + of,
          std::max(glm::length(receiver.cell_u), glm::length(receiver.cell_v)), "0: it has no cell",
          "Measure at points.");
  require(!receiver.concentrator_index, room, "refractive index of the concentrator " + of,
          receiver.concentrator_index.value_or(0.0), "none, which is for planar receivers", "Leave it out.");
  if (!is_half) return;
  check_axis(room, receiver.facing, "faced " + of);
  constexpr double parallel = 1e-6;
  const double sine = glm::length(glm::cross(glm::normalize(receiver.facing), glm::normalize(receiver.normal)));
  require(sine > parallel, room, "sine of the angle between the axis and the direction faced " + of, sine, "above 1e-6",
          "Give a direction to the side of the axis; of a vertical half cylinder a level one.");
}

void check_receiver(const Room& room, const Receiver& receiver) {
  const std::string of = "of receiver " + in_quotes(receiver.name);
  check_position(room, receiver.position, of);
  check_axis(room, receiver.normal, of);
  require(receiver.half_angle_deg >= 0.0 && receiver.half_angle_deg <= 90.0, room,
          "field of view (half angle in degrees) " + of, receiver.half_angle_deg, "0 to 90",
          "Give the half angle; 90 is the whole hemisphere.");
  check_cell(room, receiver);
  if (receiver.law != ReceiverLaw::planar) check_law(room, receiver);
  require(receiver.area_m2 >= 0.0 && std::isfinite(receiver.area_m2), room, "area in m² " + of, receiver.area_m2,
          "a finite number, 0 or more", "Give its sensitive area.");
  const double index = receiver.concentrator_index.value_or(1.0);
  require(index >= 1.0 && std::isfinite(index), room, "refractive index of the concentrator " + of, index,
          "a finite number, 1 or more", "Give the index of its material, for example 1.5.");
  require(receiver.filter_gain >= 0.0 && std::isfinite(receiver.filter_gain), room, "gain of the filter " + of,
          receiver.filter_gain, "a finite number, 0 or more", "Give the share of the light that it lets through.");
}

}  // namespace

void check_surfaces(const Room& room) {
  for (const ReflectanceMap& map : room.reflectance_maps) check_reflectance_map(room, map);
  for (const EmissionMap& map : room.emission_maps) check_emission_map(room, map);
  std::set<std::string> names;
  for (const Surface& surface : room.surfaces) {
    check_surface(room, surface);
    if (!names.insert(surface.name).second) {
      throw InputError("There are two surfaces with the name " + in_quotes(surface.name) + " in " + room.source +
                       " (allowed: one of each name). Rename one.");
    }
  }
  const bool solid = std::any_of(room.surfaces.begin(), room.surfaces.end(),
                                 [](const Surface& surface) { return surface_area(surface) > 0.0; });
  if (!solid) {
    throw InputError("There is no triangle with an area in " + room.source +
                     " (allowed: at least one). Export the room's meshes with it, as triangles.");
  }
}

void check_emitters(const Room& room) {
  if (room.emitters.empty()) {
    throw InputError("There is no emitter in " + room.source +
                     " (allowed: at least one). Add a point or spot light or an emissive material to the room, or give "
                     "one with --light, for "
                     "example --light point:0,2,0:1000lm.");
  }
  for (const Emitter& emitter : room.emitters) {
    const std::string of = "of emitter " + in_quotes(emitter.name);
    require(emitter.power >= 0.0 && std::isfinite(emitter.power), room,
            "power in " + std::string(power_unit(room.quantity)) + " " + of, emitter.power,
            "a finite number, 0 or more", "Give its power.");
    require(emitter.delay_s >= 0.0 && std::isfinite(emitter.delay_s), room, "delay in s " + of, emitter.delay_s,
            "a finite number, 0 or more", "Count the delays of all emitters from the earliest one.");
    require(emitter.maintenance_factor > 0.0 && emitter.maintenance_factor <= 1.0, room, "maintenance factor " + of,
            emitter.maintenance_factor, "above 0 and up to 1",
            "Give the share of its new power that it keeps, for example 0.8; 1 if it loses none.");
    std::visit([&](const auto& shape) { check_shape(room, shape, of); }, emitter.shape);
  }
  const double power = total_power(room);
  require(power > 0.0 && std::isfinite(power), room,
          "sum of the emitters' powers in " + std::string(power_unit(room.quantity)), power, "a finite number above 0",
          "Give an emitter a power.");
}

void check_room(const Room& room) {
  check_surfaces(room);
  check_emitters(room);
  for (const Receiver& receiver : room.receivers) check_receiver(room, receiver);
  check_areas(room);
}

double surface_area(const Surface& surface) {
  double twice = 0.0;
  for (const glm::uvec3& triangle : surface.triangles) {
    const glm::dvec3& a = surface.positions[triangle.x];
    twice += glm::length(glm::cross(surface.positions[triangle.y] - a, surface.positions[triangle.z] - a));
  }
  return 0.5 * twice;
}

double Receiver::optical_gain() const {
  if (!concentrator_index) return filter_gain;
  const double sine = std::sin(half_angle_deg * std::numbers::pi / 180.0);
  return sine > 0.0 ? *concentrator_index * *concentrator_index / (sine * sine) * filter_gain : 0.0;
}

double total_power(const Room& room) {
  double sum = 0.0;
  for (const Emitter& emitter : room.emitters) sum += emitter.power;
  return sum;
}

}  // namespace lichtmc
