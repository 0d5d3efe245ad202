#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/atomic_file.hpp"
#include "base/decimal_shift.hpp"
#include "base/frame.hpp"
#include "base/message.hpp"
#include "gltf/builder.hpp"
#include "gltf/texture_image.hpp"
#include "gltf/write_luminaires.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "room/bounds.hpp"
#include "room/emission.hpp"
#include "room/emitter_shape.hpp"

namespace lichtmc {

namespace {

using Json = GltfBuilder::Json;

class Writer {
 public:
  explicit Writer(const Room& room) : room_(&room), document_(file_offset(bounds_of(room))) {
    for (const ReflectanceMap& map : room.reflectance_maps) textures_.push_back(add_texture(map, reflectance_png(map)));
    for (const EmissionMap& map : room.emission_maps) emission_textures_.push_back(add_texture(map, emission_png(map)));
    for (std::size_t k = 0; k < room.surfaces.size(); ++k) add_surface(k);
    for (const Emitter& emitter : room.emitters) {
      visit_shape(
          emitter,
          [&](const auto& point) {
            if constexpr (requires { point.photometry; }) {
              add_luminaire(emitter, point);
            } else {
              add_point_emitter(emitter, point);
            }
          },
          [](const auto& /*area_light*/) {});  // part of its material
    }
    for (const Receiver& receiver : room.receivers) add_receiver(receiver);
    for (const AreaRequest& request : room.area_requests) add_area_request(request);
  }

  GltfBuilder& document() { return document_; }

 private:
  std::size_t add_texture(const TextureMap& map, const std::string& png);
  const SurfaceEmitter* emitter_of(std::size_t surface) const;
  void add_surface(std::size_t k);
  template <PointShape Shape>
  void add_point_emitter(const Emitter& emitter, const Shape& shape);
  void add_luminaire(const Emitter& emitter, const MeasuredEmitter& shape);
  void add_power(const Emitter& emitter, Json& node) const;
  void add_receiver(const Receiver& receiver);
  void add_area_request(const AreaRequest& request);
  std::size_t material_of(std::size_t surface);

  const Room* room_;
  GltfBuilder document_;
  LuminaireWriter luminaires_{document_};
  std::vector<std::size_t> textures_;             // of the room's reflectance maps
  std::vector<std::size_t> emission_textures_;    // of its emission maps
  std::map<std::string, std::size_t> materials_;  // by their JSON text
};

int wrap_mode(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return 10497;
    case Wrap::clamp:
      return 33071;
    case Wrap::mirror:
      return 33648;
  }
  return 0;
}

std::size_t Writer::add_texture(const TextureMap& map, const std::string& png) {
  Json& json = document_.json;
  // Indices first: a new list moves the others.
  const std::size_t image = document_.add_png(map.name, png);
  const std::size_t sampler = json["samplers"].size();
  json["samplers"].push_back({{"wrapS", wrap_mode(map.wrap_u)}, {"wrapT", wrap_mode(map.wrap_v)}});
  json["textures"].push_back({{"source", image}, {"sampler", sampler}});
  return json["textures"].size() - 1;
}

const char* unit_of(const Room& room) {
  return room.quantity == Quantity::radiometric ? "W" : "lm";
}

// The number of the texture coordinates of the reflectance map of a surface with an emission map, see add_surface().
int reflectance_set(const Surface& surface) {
  return surface.uvs.empty() ? 1 : 2;
}

// The power when new: reading multiplies it by the maintenance factor.
double new_power(const Emitter& emitter) {
  return emitter.power / emitter.maintenance_factor;
}

void write_delay_and_maintenance(const Emitter& emitter, Json& extras) {
  if (emitter.delay_s != 0.0) extras["delay_ns"] = shift_decimals(emitter.delay_s, 9);
  if (emitter.own_maintenance || emitter.maintenance_factor != 1.0)
    extras["maintenance_factor"] = emitter.maintenance_factor;
}

const SurfaceEmitter* Writer::emitter_of(std::size_t surface) const {
  for (const Emitter& emitter : room_->emitters) {
    if (emitting_surface(emitter) == surface) return &std::get<SurfaceEmitter>(emitter.shape);
  }
  return nullptr;
}

std::size_t Writer::material_of(std::size_t k) {
  const Surface& surface = room_->surfaces[k];
  const double rho = surface.reflectance;
  Json material{{"name", surface.material.empty() ? surface.name : surface.material},
                {"pbrMetallicRoughness",
                 {{"baseColorFactor", {rho, rho, rho, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
                {"doubleSided", surface.sides == Sides::both},
                {"extras", {{"reflectance", rho}}}};
  if (surface.reflectance_map) {
    // Only the image contains the reflectance; it uses the first texture coordinates.
    material.erase("extras");
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 1.0, 1.0, 1.0};
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", textures_[*surface.reflectance_map]}};
  }
  if (!surface.vertex_colours.empty()) {
    // ρ is the product of the vertex colours and the texture, or the vertex colours alone.
    material.erase("extras");
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 1.0, 1.0, 1.0};
  }
  for (const Emitter& emitter : room_->emitters) {
    if (emitting_surface(emitter) != k) continue;
    const auto& shape = std::get<SurfaceEmitter>(emitter.shape);
    double luminance = new_power(emitter) / (std::numbers::pi * surface_area(surface));
    if (shape.emission_map) {
      // The texture contains the values divided by the highest one.
      const EmissionMap& map = room_->emission_maps[*shape.emission_map];
      luminance *= highest_value(map) / mean_emission(surface, map, shape.emission_uvs);
      material["emissiveTexture"] = {{"index", emission_textures_[*shape.emission_map]}};
      if (surface.reflectance_map)
        material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = reflectance_set(surface);
    }
    material["emissiveFactor"] = {1.0, 1.0, 1.0};
    material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", luminance}};
    material["extras"]["power"] = new_power(emitter);
    material["extras"]["unit"] = unit_of(*room_);
    material["extras"]["lambert_exponent"] = shape.exponent;
    write_delay_and_maintenance(emitter, material["extras"]);
    document_.use_extension("KHR_materials_emissive_strength");
  }
  const auto [entry, fresh] = materials_.try_emplace(material.dump(-1, ' ', false, Json::error_handler_t::replace),
                                                     document_.json["materials"].size());
  if (fresh) document_.json["materials"].push_back(std::move(material));
  return entry->second;
}

void Writer::add_surface(std::size_t k) {
  const Surface& surface = room_->surfaces[k];
  if (surface.triangles.empty()) return;
  Json attributes{{"POSITION", document_.add_positions(surface.positions)}};
  // read_gltf() takes TEXCOORD_1 for the tiles if it exists, and their coordinates are second if there is another set.
  std::vector<const std::vector<glm::dvec2>*> sets{&surface.reflectance_uvs, &surface.uvs};
  const SurfaceEmitter* emitter = emitter_of(k);
  if (emitter != nullptr && emitter->emission_map)
    sets = {&emitter->emission_uvs, &surface.uvs, &surface.reflectance_uvs};
  int number = 0;
  for (const std::vector<glm::dvec2>* set : sets) {
    if (set->empty()) continue;
    std::vector<std::array<float, 2>> uvs;
    for (const glm::dvec2& uv : *set) uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
    attributes["TEXCOORD_" + std::to_string(number++)] = document_.add_vectors(uvs);
  }
  if (!surface.vertex_colours.empty()) {
    std::vector<std::array<float, 3>> colours;
    for (const glm::dvec3& c : surface.vertex_colours)
      colours.push_back({static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)});
    attributes["COLOR_0"] = document_.add_vectors(colours);
  }
  std::vector<std::uint32_t> indices;
  for (const glm::uvec3& t : surface.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
  const std::size_t index_accessor = document_.add_indices(indices);
  const std::size_t material = material_of(k);
  Json& meshes = document_.json["meshes"];
  meshes.push_back(
      {{"name", surface.name},
       {"primitives", {{{"attributes", attributes}, {"indices", index_accessor}, {"material", material}}}}});
  document_.add_node({{"name", surface.name}, {"mesh", meshes.size() - 1}});
}

// A unit quaternion (x, y, z, w) that rotates −Z to a direction, about their common normal.
std::array<double, 4> looking_along(const glm::dvec3& direction) {
  const glm::dvec3 from(0.0, 0.0, -1.0);
  const glm::dvec3 to = glm::normalize(direction);
  const glm::dvec3 half = from + to;
  const double length = glm::length(half);
  // Opposite directions: a rotation by π about any perpendicular axis.
  if (length < 1e-9) return {1.0, 0.0, 0.0, 0.0};
  const glm::dvec3 middle = half / length;
  const glm::dvec3 axis = glm::cross(from, middle);
  return {axis.x, axis.y, axis.z, glm::dot(from, middle)};
}

// The light of KHR_lights_punctual for an emitter, and the other properties of its node.
struct PunctualLight {
  Json light;
  Json node_extras = Json::object();
};

PunctualLight punctual(const IsotropicEmitter& /*shape*/, double power) {
  return {{{"type", "point"}, {"intensity", power / (4.0 * std::numbers::pi)}}};
}

PunctualLight punctual(const LambertEmitter& shape, double power) {
  return {{{"type", "point"}, {"intensity", power / (4.0 * std::numbers::pi)}}, {{"lambert_exponent", shape.exponent}}};
}

PunctualLight punctual(const SpotEmitter& shape, double power) {
  return {
      {{"type", "spot"},
       {"intensity", power / shape.law().solid_angle()},
       {"spot", {{"innerConeAngle", shape.inner}, {"outerConeAngle", std::min(shape.outer, std::numbers::pi / 2.0)}}}}};
}

void Writer::add_power(const Emitter& emitter, Json& node) const {
  node["extras"]["power"] = new_power(emitter);
  node["extras"]["unit"] = unit_of(*room_);
  write_delay_and_maintenance(emitter, node["extras"]);
}

template <PointShape Shape>
void Writer::add_point_emitter(const Emitter& emitter, const Shape& shape) {
  Json node = document_.placed_node(emitter.name, shape.position);
  if constexpr (requires { shape.axis; }) node["rotation"] = looking_along(shape.axis);
  PunctualLight written = punctual(shape, new_power(emitter));
  node["extras"] = std::move(written.node_extras);
  add_power(emitter, node);
  Json& lights = document_.json["extensions"]["KHR_lights_punctual"]["lights"];
  node["extensions"]["KHR_lights_punctual"] = {{"light", lights.size()}};
  lights.push_back(std::move(written.light));
  document_.use_extension("KHR_lights_punctual");
  document_.add_node(std::move(node));
}

void Writer::add_luminaire(const Emitter& emitter, const MeasuredEmitter& shape) {
  Json node = document_.placed_node(emitter.name, shape.position);
  luminaires_.add(*shape.photometry, {shape.axis, shape.c0, shape.c90}, shape.opening, new_power(emitter),
                  room_->quantity, node);
  add_power(emitter, node);
  document_.add_node(std::move(node));
}

glm::dvec3 level_part(const glm::dvec3& direction) {
  return {direction.x, 0.0, direction.z};
}

void Writer::add_receiver(const Receiver& receiver) {
  Json node = document_.placed_node(receiver.name, receiver.position);
  const bool is_half = receiver.law == ReceiverLaw::semicylindrical;
  node["rotation"] = looking_along(is_half ? level_part(receiver.facing) : receiver.normal);
  Json& extras = node["extras"]["receiver"];
  extras = {{"area", receiver.area_m2}, {"fov", receiver.half_angle_deg}};
  if (receiver.law != ReceiverLaw::planar) extras["quantity"] = std::string(to_string(receiver.law));
  if (receiver.concentrator_index) extras["concentrator_index"] = *receiver.concentrator_index;
  if (receiver.filter_gain != 1.0) extras["filter_gain"] = receiver.filter_gain;
  document_.add_node(std::move(node));
}

void Writer::add_area_request(const AreaRequest& request) {
  std::vector<glm::dvec3> positions;
  for (const auto& triangle : request.triangles) positions.insert(positions.end(), triangle.begin(), triangle.end());
  if (positions.empty()) return;
  const AreaProperties& p = request.properties;
  Json extras{{"calculation_area", p.role}};
  const auto add = [&extras](const char* name, const std::optional<double>& value) {
    if (value) extras[name] = *value;
  };
  add("spacing", p.spacing_m);
  add("margin", p.margin_m);
  add("target_lx", p.target_lx);
  add("target_uniformity", p.target_uniformity);
  if (p.quantity) extras["quantity"] = std::string(to_string(*p.quantity));
  if (p.direction) extras["direction"] = {p.direction->x, p.direction->y, p.direction->z};
  if (p.cells) extras["cells"] = true;
  const Json attributes{{"POSITION", document_.add_positions(positions)}};
  Json& meshes = document_.json["meshes"];
  meshes.push_back({{"name", p.name}, {"primitives", {{{"attributes", attributes}}}}});
  document_.add_node({{"name", p.name}, {"mesh", meshes.size() - 1}, {"extras", extras}});
}

// Values that a Room may have and glTF cannot represent.
void check_writable(const Room& room) {
  for (const Surface& surface : room.surfaces) {
    if (surface.vertex_colours.empty() || surface.highest_reflectance >= 1.0) continue;
    throw InputError("Surface " + in_quotes(surface.name) + " has vertex colours, limited to a reflectance of " +
                     to_text(surface.highest_reflectance) +
                     " (a file cannot contain such a limit). Lower the vertex colours themselves.");
  }
  for (const Receiver& receiver : room.receivers) {
    constexpr double vertical = 1e-9;  // sine of the angle between the axis and the vertical
    if (receiver.law == ReceiverLaw::planar || glm::length(level_part(glm::normalize(receiver.normal))) < vertical)
      continue;
    throw InputError("The axis of the " + std::string(to_string(receiver.law)) + " receiver " +
                     in_quotes(receiver.name) +
                     " is not vertical (a file contains vertical ones only). Give it the "
                     "axis 0,1,0.");
  }
  std::vector<bool> emits(room.surfaces.size(), false);
  for (const Emitter& emitter : room.emitters) {
    const double parameter = std::visit(
        [](const auto& shape) {
          if constexpr (requires { shape.exponent; }) return shape.exponent;
          return 0.0;
        },
        emitter.shape);
    if (!std::isfinite(parameter) || !std::isfinite(emitter.power)) {
      throw InputError("The power or exponent of emitter " + in_quotes(emitter.name) +
                       " is not finite (a file contains finite numbers only). Use a large number, for example 1e30.");
    }
    const std::optional<std::size_t> surface = emitting_surface(emitter);
    if (!surface || *surface >= emits.size()) continue;
    if (emits[*surface]) {
      throw InputError("Surface " + in_quotes(room.surfaces[*surface].name) +
                       " has two emitters (a file contains one for each surface). Add their powers.");
    }
    emits[*surface] = true;
  }
}

}  // namespace

void write_gltf(const Room& room, const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".glb" && ending != ".gltf") {
    throw InputError("Cannot determine the format of " + file.string() + " by its ending '" + ending +
                     "' (allowed: .glb or .gltf). Use one of these.");
  }
  check_writable(room);
  GltfBuilder document = std::move(Writer(room).document());
  write_file_atomically(file, ending == ".glb" ? document.binary() : document.text());
}

}  // namespace lichtmc
