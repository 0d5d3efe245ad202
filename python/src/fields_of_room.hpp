// The members of a room, for archives (archive.hpp): all of each struct, in order.
//
// Structured bindings need the exact number of members, so that one more in a struct is a compile error here. Whoever
// adds it here raises the number of the layout in packed.cpp: older bytes are then refused.
#pragma once

#include <cereal/types/array.hpp>
#include <cereal/types/common.hpp>
#include <cereal/types/memory.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "archive.hpp"
#include "lichtmc/photometry.hpp"
#include "lichtmc/room.hpp"

namespace glm {

template <class Archive, length_t size, class Number, qualifier precision>
void serialize(Archive& archive, vec<size, Number, precision>& vector) {
  for (length_t k = 0; k < size; ++k) archive(vector[k]);
}

}  // namespace glm

namespace lichtmc {

template <class Archive>
void serialize(Archive& archive, TextureMap& map) {
  auto& [name, columns, rows, values, wrap_u, wrap_v, colours] = map;
  archive(name, columns, rows, values, wrap_u, wrap_v, colours);
}

template <class Archive>
void serialize(Archive& archive, Surface& surface) {
  auto& [name, material, reflectance, reflectance_source, sides, positions, uvs, triangles, reflectance_map,
         reflectance_uvs, vertex_colours, highest_reflectance, measured, without_area] = surface;
  archive(name, material, reflectance, reflectance_source, sides, positions, uvs, triangles, reflectance_map,
          reflectance_uvs, vertex_colours, highest_reflectance, measured, without_area);
}

template <class Archive>
void serialize(Archive& archive, IsotropicEmitter& shape) {
  auto& [position] = shape;
  archive(position);
}

template <class Archive>
void serialize(Archive& archive, LambertEmitter& shape) {
  auto& [position, axis, exponent] = shape;
  archive(position, axis, exponent);
}

template <class Archive>
void serialize(Archive& archive, SpotEmitter& shape) {
  auto& [position, axis, inner, outer] = shape;
  archive(position, axis, inner, outer);
}

template <class Archive>
void serialize(Archive& archive, SurfaceEmitter& shape) {
  auto& [surface, exponent, emission_map, emission_uvs] = shape;
  archive(surface, exponent, emission_map, emission_uvs);
}

template <class Archive>
void serialize(Archive& archive, LuminousOpening& opening) {
  auto& [form, size] = opening;
  archive(form, size);
}

template <class Archive>
void serialize(Archive& archive, LampSet& set) {
  auto& [lamps, flux, type, colour, rendering_index, watts] = set;
  archive(lamps, flux, type, colour, rendering_index, watts);
}

template <class Archive>
void serialize(Archive& archive, CandelaTable::Grid& grid) {
  auto& [type, symmetry, horizontal, vertical, candela, flip_horizontal] = grid;
  archive(type, symmetry, horizontal, vertical, candela, flip_horizontal);
}

template <class Archive>
void save(Archive& archive, const CandelaTable& table) {
  archive(table.grid());
}

template <class Archive>
void serialize(Archive& archive, Photometry& photometry) {
  auto& [source, format, version, manufacturer, luminaire, catalogue, test, texts, candela, intensity_unit, factor,
         multiplier, ballast, ballast_lamp, conversion, absolute, lamp_sets, lamp_set, stated, lamp, output_ratio,
         downward_share, watts, tilt_factors, opening, warnings, notes] = photometry;
  archive(source, format, version, manufacturer, luminaire, catalogue, test, texts, candela, intensity_unit, factor,
          multiplier, ballast, ballast_lamp, conversion, absolute, lamp_sets, lamp_set, stated, lamp, output_ratio,
          downward_share, watts, tilt_factors, opening, warnings, notes);
}

// Emitters of one photometric file share it, also when they are read again: cereal sees to that.
template <class Archive>
void serialize(Archive& archive, MeasuredEmitter& shape) {
  auto& [photometry, position, axis, c0, c90, opening] = shape;
  archive(photometry, position, axis, c0, c90, opening);
}

template <class Archive>
void serialize(Archive& archive, Emitter& emitter) {
  auto& [name, power, shape, delay, maintenance_factor, own_maintenance] = emitter;
  archive(name, power, shape, delay, maintenance_factor, own_maintenance);
}

template <class Archive>
void serialize(Archive& archive, Receiver& receiver) {
  auto& [name, position, normal, half_angle, area, concentrator_index, filter_gain, cell_u, cell_v, law, facing] =
      receiver;
  archive(name, position, normal, half_angle, area, concentrator_index, filter_gain, cell_u, cell_v, law, facing);
}

template <class Archive>
void serialize(Archive& archive, AreaProperties& properties) {
  auto& [name, role, quantity, direction, spacing, margin, cells, target, target_uniformity] = properties;
  archive(name, role, quantity, direction, spacing, margin, cells, target, target_uniformity);
}

template <class Archive>
void serialize(Archive& archive, AreaRequest& request) {
  auto& [properties, triangles] = request;
  archive(properties, triangles);
}

template <class Archive>
void serialize(Archive& archive, AreaLeftOut& left_out) {
  auto& [why, points] = left_out;
  archive(why, points);
}

template <class Archive>
void serialize(Archive& archive, Area& area) {
  auto& [properties, quantity, corner, u, v, normal, columns, rows, first_receiver, cells, left_out, margin,
         above_floor, outline, notes] = area;
  archive(properties, quantity, corner, u, v, normal, columns, rows, first_receiver, cells, left_out, margin,
          above_floor, outline, notes);
}

template <class Archive>
void serialize(Archive& archive, Ignored& ignored) {
  auto& [what, effect, advice] = ignored;
  archive(what, effect, advice);
}

template <class Archive>
void serialize(Archive& archive, Room& room) {
  auto& [source, quantity, surfaces, emitters, receivers, areas, area_requests, reflectance_maps, emission_maps,
         ignored, overrides] = room;
  archive(source, quantity, surfaces, emitters, receivers, areas, area_requests, reflectance_maps, emission_maps,
          ignored, overrides);
}

}  // namespace lichtmc

template <>
struct cereal::LoadAndConstruct<lichtmc::CandelaTable> {
  template <class Archive>
  static void load_and_construct(Archive& archive, cereal::construct<lichtmc::CandelaTable>& construct) {
    lichtmc::CandelaTable::Grid grid;
    archive(grid);
    construct(std::move(grid));
  }
};
