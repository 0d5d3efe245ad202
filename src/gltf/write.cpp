#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/frame.hpp"
#include "base/message.hpp"
#include "chance/directions.hpp"
#include "gltf/texture_image.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/version.hpp"

namespace lichtmc {

namespace {

using Json = nlohmann::ordered_json;

constexpr int array_buffer = 34962;
constexpr int element_array_buffer = 34963;
constexpr int float_type = 5126;
constexpr int unsigned_int_type = 5125;

// The document and its one buffer, as they grow.
class Writer {
 public:
  explicit Writer(const Room& room) : room_(&room) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "lichtmc " + std::string(version())}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (const ReflectanceMap& map : room.reflectance_maps) textures_.push_back(add_texture(map));
    for (std::size_t k = 0; k < room.surfaces.size(); ++k) add_surface(k);
    for (const Emitter& emitter : room.emitters) add_point_emitter(emitter);
    for (const Receiver& receiver : room.receivers) add_receiver(receiver);
    finish();
  }

  const Json& json() const { return json_; }
  Json& json() { return json_; }
  const std::string& buffer() const { return buffer_; }

 private:
  std::size_t add_texture(const ReflectanceMap& map);
  void add_surface(std::size_t k);
  void add_point_emitter(const Emitter& emitter);
  void add_receiver(const Receiver& receiver);
  void finish();

  std::size_t material_of(std::size_t surface);
  std::size_t add_accessor(const void* data, std::size_t bytes, Json accessor, int target);
  template <std::size_t N>
  std::size_t add_vectors(const std::vector<std::array<float, N>>& vectors, bool with_bounds);
  void add_node(Json node) {
    json_["scenes"][0]["nodes"].push_back(json_["nodes"].size());
    json_["nodes"].push_back(std::move(node));
  }
  void use_extension(const std::string& name) {
    Json& used = json_["extensionsUsed"];
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
  }

  const Room* room_;
  Json json_;
  std::string buffer_;
  std::vector<std::size_t> textures_;             // of the room's maps
  std::map<std::string, std::size_t> materials_;  // by their JSON text
};

std::size_t Writer::add_accessor(const void* data, std::size_t bytes, Json accessor, int target) {
  const std::size_t offset = buffer_.size();  // all elements are made of 4-byte numbers: always aligned
  buffer_.append(static_cast<const char*>(data), bytes);
  accessor["bufferView"] = json_["bufferViews"].size();
  json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", target}});
  json_["accessors"].push_back(std::move(accessor));
  return json_["accessors"].size() - 1;
}

template <std::size_t N>
std::size_t Writer::add_vectors(const std::vector<std::array<float, N>>& vectors, bool with_bounds) {
  Json accessor{{"componentType", float_type}, {"count", vectors.size()}, {"type", N == 3 ? "VEC3" : "VEC2"}};
  if (with_bounds) {
    std::array<float, N> low = vectors.front();
    std::array<float, N> high = vectors.front();
    for (const auto& v : vectors) {
      for (std::size_t c = 0; c < N; ++c) {
        low[c] = std::min(low[c], v[c]);
        high[c] = std::max(high[c], v[c]);
      }
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }
  return add_accessor(vectors.data(), vectors.size() * sizeof vectors.front(), accessor, array_buffer);
}

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
  const std::string png = png_of(map);
  const std::size_t offset = buffer_.size();
  buffer_ += png;
  buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');  // what follows is aligned
  // Numbers first: a list that is new moves the others.
  const std::size_t view = json_["bufferViews"].size();
  const std::size_t image = json_["images"].size();
  const std::size_t sampler = json_["samplers"].size();
  json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", png.size()}});
  json_["images"].push_back({{"name", map.name}, {"mimeType", "image/png"}, {"bufferView", view}});
  json_["samplers"].push_back({{"wrapS", wrap_mode(map.wrap_u)}, {"wrapT", wrap_mode(map.wrap_v)}});
  json_["textures"].push_back({{"source", image}, {"sampler", sampler}});
  return json_["textures"].size() - 1;
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
    use_extension("KHR_materials_emissive_strength");
  }
  const auto [entry, fresh] =
      materials_.try_emplace(material.dump(-1, ' ', false, Json::error_handler_t::replace), json_["materials"].size());
  if (fresh) json_["materials"].push_back(std::move(material));
  return entry->second;
}

void Writer::add_surface(std::size_t k) {
  const Surface& surface = room_->surfaces[k];
  if (surface.triangles.empty()) return;
  std::vector<std::array<float, 3>> positions;
  for (const glm::dvec3& p : surface.positions)
    positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  Json attributes{{"POSITION", add_vectors<3>(positions, true)}};
  // Those for the tiles come last, where they are looked for first.
  for (const std::vector<glm::dvec2>* set : {&surface.reflectance_uvs, &surface.uvs}) {
    if (set->empty()) continue;
    std::vector<std::array<float, 2>> uvs;
    for (const glm::dvec2& uv : *set) uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
    attributes[attributes.contains("TEXCOORD_0") ? "TEXCOORD_1" : "TEXCOORD_0"] = add_vectors<2>(uvs, false);
  }
  std::vector<std::uint32_t> indices;
  for (const glm::uvec3& t : surface.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
  const std::size_t index_accessor = add_accessor(
      indices.data(), indices.size() * sizeof indices.front(),
      {{"componentType", unsigned_int_type}, {"count", indices.size()}, {"type", "SCALAR"}}, element_array_buffer);
  const std::size_t material = material_of(k);
  json_["meshes"].push_back(
      {{"name", surface.name},
       {"primitives", {{{"attributes", attributes}, {"indices", index_accessor}, {"material", material}}}}});
  add_node({{"name", surface.name}, {"mesh", json_["meshes"].size() - 1}});
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

Json placed_node(const std::string& name, const glm::dvec3& position) {
  Json node{{"translation", {position.x, position.y, position.z}}};
  if (!name.empty()) node["name"] = name;
  return node;
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
  Json& lights = json_["extensions"]["KHR_lights_punctual"]["lights"];
  node["extensions"]["KHR_lights_punctual"] = {{"light", lights.size()}};
  lights.push_back(std::move(light));
  use_extension("KHR_lights_punctual");
  add_node(std::move(node));
}

void Writer::add_receiver(const Receiver& receiver) {
  Json node = placed_node(receiver.name, receiver.position);
  node["rotation"] = looking_along(receiver.normal);
  node["extras"]["receiver"] = {{"area", receiver.area_m2}, {"fov", receiver.half_angle_deg}};
  add_node(std::move(node));
}

void Writer::finish() {
  if (!buffer_.empty()) json_["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
  // The specification allows no empty lists.
  if (json_["scenes"][0]["nodes"].empty()) json_["scenes"][0].erase("nodes");
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += k + j <= bytes.size() ? digits[group >> (18 - 6 * j) & 63U] : '=';
  }
  return text;
}

// A text's length up to the next multiple of 4.
void pad(std::string& text, char with) {
  text.resize((text.size() + 3) / 4 * 4, with);
}

void append_word(std::string& bytes, std::size_t value) {
  for (std::size_t k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xFFU);
}

std::string container(const Json& json, std::string buffer) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  pad(text, ' ');
  pad(buffer, '\0');
  const std::size_t total = 12 + 8 + text.size() + (buffer.empty() ? 0 : 8 + buffer.size());
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw RuntimeError("The room is too large for a .glb file (over 4 GiB). Split it.");
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, total);
  append_word(bytes, text.size());
  bytes += "JSON" + text;
  if (buffer.empty()) return bytes;
  append_word(bytes, buffer.size());
  bytes += std::string("BIN\0", 4) + buffer;
  return bytes;
}

}  // namespace

namespace {

// What a Room may hold and glTF cannot.
void check_writable(const Room& room) {
  std::vector<bool> shines(room.surfaces.size(), false);
  for (const Emitter& emitter : room.emitters) {
    const auto* lambert = std::get_if<LambertEmitter>(&emitter.shape);
    const auto* surface = std::get_if<SurfaceEmitter>(&emitter.shape);
    const double exponent = lambert != nullptr ? lambert->exponent : surface != nullptr ? surface->exponent : 0.0;
    if (!std::isfinite(exponent) || !std::isfinite(emitter.power)) {
      throw InputError("The power or exponent of emitter " + in_quotes(emitter.name) +
                       " is not finite (a file holds finite numbers only). Use a large number, for example 1e30.");
    }
    if (surface == nullptr || surface->surface >= shines.size()) continue;
    if (shines[surface->surface]) {
      throw InputError("Surface " + in_quotes(room.surfaces[surface->surface].name) +
                       " has two emitters (a file holds one for each surface). Add their powers.");
    }
    shines[surface->surface] = true;
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
  Writer writer(room);
  if (ending == ".glb") {
    write_file_atomically(file, container(writer.json(), writer.buffer()));
    return;
  }
  if (!writer.buffer().empty()) {
    writer.json()["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(writer.buffer());
  }
  write_file_atomically(file, writer.json().dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace lichtmc
