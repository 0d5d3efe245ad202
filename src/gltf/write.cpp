#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/atomic_file.hpp"
#include "base/frame.hpp"
#include "base/message.hpp"
#include "chance/directions.hpp"
#include "gltf/builder.hpp"
#include "gltf/texture_image.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"

namespace lichtmc {

namespace {

using Json = GltfBuilder::Json;

class Writer {
 public:
  explicit Writer(const Room& room) : room_(&room) {
    for (const ReflectanceMap& map : room.reflectance_maps) textures_.push_back(add_texture(map));
    for (std::size_t k = 0; k < room.surfaces.size(); ++k) add_surface(k);
    for (const Emitter& emitter : room.emitters) add_point_emitter(emitter);
    for (const Receiver& receiver : room.receivers) add_receiver(receiver);
  }

  GltfBuilder& document() { return document_; }

 private:
  std::size_t add_texture(const ReflectanceMap& map);
  void add_surface(std::size_t k);
  void add_point_emitter(const Emitter& emitter);
  void add_receiver(const Receiver& receiver);
  std::size_t material_of(std::size_t surface);

  const Room* room_;
  GltfBuilder document_;
  std::vector<std::size_t> textures_;             // of the room's maps
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

std::size_t Writer::add_texture(const ReflectanceMap& map) {
  Json& json = document_.json;
  // Numbers first: a list that is new moves the others.
  const std::size_t image = document_.add_png(map.name, png_of(map));
  const std::size_t sampler = json["samplers"].size();
  json["samplers"].push_back({{"wrapS", wrap_mode(map.wrap_u)}, {"wrapT", wrap_mode(map.wrap_v)}});
  json["textures"].push_back({{"source", image}, {"sampler", sampler}});
  return json["textures"].size() - 1;
}

const char* unit_of(const Room& room) {
  return room.quantity == Quantity::radiometric ? "W" : "lm";
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
    // The picture alone says the reflectance; it has the first texture coordinates.
    material.erase("extras");
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 1.0, 1.0, 1.0};
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", textures_[*surface.reflectance_map]}};
  }
  for (const Emitter& emitter : room_->emitters) {
    const auto* shape = std::get_if<SurfaceEmitter>(&emitter.shape);
    if (shape == nullptr || shape->surface != k) continue;
    const double luminance = emitter.power / (std::numbers::pi * surface_area(surface));
    material["emissiveFactor"] = {1.0, 1.0, 1.0};
    material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", luminance}};
    material["extras"]["power"] = emitter.power;
    material["extras"]["unit"] = unit_of(*room_);
    material["extras"]["lambert_exponent"] = shape->exponent;
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
  Json attributes{{"POSITION", document_.add_positions(as_floats(surface.positions))}};
  // Those for the tiles come last, where they are looked for first.
  for (const std::vector<glm::dvec2>* set : {&surface.reflectance_uvs, &surface.uvs}) {
    if (set->empty()) continue;
    std::vector<std::array<float, 2>> uvs;
    for (const glm::dvec2& uv : *set) uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
    attributes[attributes.contains("TEXCOORD_0") ? "TEXCOORD_1" : "TEXCOORD_0"] = document_.add_vectors(uvs);
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

// A unit quaternion (x, y, z, w) that turns −Z to a direction: half of the turn from −Z to it, about their common
// normal.
std::array<double, 4> looking_along(const glm::dvec3& direction) {
  const glm::dvec3 from(0.0, 0.0, -1.0);
  const glm::dvec3 to = glm::normalize(direction);
  const glm::dvec3 half = from + to;
  const double length = glm::length(half);
  // Opposite directions: any half turn about an axis across will do.
  if (length < 1e-9) return {1.0, 0.0, 0.0, 0.0};
  const glm::dvec3 middle = half / length;
  const glm::dvec3 axis = glm::cross(from, middle);
  return {axis.x, axis.y, axis.z, glm::dot(from, middle)};
}

void Writer::add_point_emitter(const Emitter& emitter) {
  Json light;
  Json node;
  const double pi = std::numbers::pi;
  if (const auto* isotropic = std::get_if<IsotropicEmitter>(&emitter.shape)) {
    node = placed_node(emitter.name, isotropic->position);
    light = {{"type", "point"}, {"intensity", emitter.power / (4.0 * pi)}};
  } else if (const auto* lambert = std::get_if<LambertEmitter>(&emitter.shape)) {
    node = placed_node(emitter.name, lambert->position);
    node["rotation"] = looking_along(lambert->axis);
    node["extras"]["lambert_exponent"] = lambert->exponent;
    light = {{"type", "point"}, {"intensity", emitter.power / (4.0 * pi)}};
  } else if (const auto* spot = std::get_if<SpotEmitter>(&emitter.shape)) {
    node = placed_node(emitter.name, spot->position);
    node["rotation"] = looking_along(spot->axis);
    light = {{"type", "spot"},
             {"intensity", emitter.power / spot_solid_angle(spot->inner, spot->outer)},
             {"spot", {{"innerConeAngle", spot->inner}, {"outerConeAngle", std::min(spot->outer, pi / 2.0)}}}};
  } else {
    return;  // a surface emitter is part of its material
  }
  node["extras"]["power"] = emitter.power;
  node["extras"]["unit"] = unit_of(*room_);
  Json& lights = document_.json["extensions"]["KHR_lights_punctual"]["lights"];
  node["extensions"]["KHR_lights_punctual"] = {{"light", lights.size()}};
  lights.push_back(std::move(light));
  document_.use_extension("KHR_lights_punctual");
  document_.add_node(std::move(node));
}

void Writer::add_receiver(const Receiver& receiver) {
  Json node = placed_node(receiver.name, receiver.position);
  node["rotation"] = looking_along(receiver.normal);
  node["extras"]["receiver"] = {{"area", receiver.area_m2}, {"fov", receiver.half_angle_deg}};
  document_.add_node(std::move(node));
}

// What a Room may hold and glTF cannot.
void check_writable(const Room& room) {
  std::vector<bool> is_area_light(room.surfaces.size(), false);
  for (const Emitter& emitter : room.emitters) {
    const auto* lambert = std::get_if<LambertEmitter>(&emitter.shape);
    const auto* surface = std::get_if<SurfaceEmitter>(&emitter.shape);
    const double exponent = lambert != nullptr ? lambert->exponent : surface != nullptr ? surface->exponent : 0.0;
    if (!std::isfinite(exponent) || !std::isfinite(emitter.power)) {
      throw InputError("The power or exponent of emitter " + in_quotes(emitter.name) +
                       " is not finite (a file holds finite numbers only). Use a large number, for example 1e30.");
    }
    if (surface == nullptr || surface->surface >= is_area_light.size()) continue;
    if (is_area_light[surface->surface]) {
      throw InputError("Surface " + in_quotes(room.surfaces[surface->surface].name) +
                       " has two emitters (a file holds one for each surface). Add their powers.");
    }
    is_area_light[surface->surface] = true;
  }
}

}  // namespace

void write_gltf(const Room& room, const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".glb" && ending != ".gltf") {
    throw InputError("Cannot tell the form of " + file.string() + " by its ending '" + ending +
                     "' (allowed: .glb or .gltf). Give it one of these.");
  }
  check_writable(room);
  GltfBuilder document = std::move(Writer(room).document());
  write_file_atomically(file, ending == ".glb" ? document.binary() : document.text());
}

}  // namespace lichtmc
