#include "gltf/prepare.hpp"

#include <cstdint>

#include <nlohmann/json.hpp>

namespace lichtmc {

namespace {

using Json = nlohmann::json;

constexpr int max_depth = 256;

bool has_extension(const Json& object, const char* name) {
  return object.is_object() && object.contains("extensions") && object["extensions"].is_object() &&
         object["extensions"].contains(name);
}

bool lacks_data(const Json& accessors, const Json& index) {
  if (!index.is_number_unsigned() || !accessors.is_array()) return false;
  const auto k = index.get<std::uint64_t>();
  return k < accessors.size() && accessors[k].is_object() && !accessors[k].contains("bufferView");
}

bool remove_compressed_indices(Json& json) {
  bool changed = false;
  const Json& accessors = list_in(json, "accessors");
  for (Json& mesh : list_in(json, "meshes")) {
    for (Json& primitive : list_in(mesh, "primitives")) {
      if (!has_extension(primitive, "KHR_draco_mesh_compression") || !primitive.contains("indices")) continue;
      if (!lacks_data(accessors, primitive["indices"])) continue;
      primitive.erase("indices");
      changed = true;
    }
  }
  return changed;
}

bool fill_empty_buffers(Json& json) {
  bool changed = false;
  for (Json& buffer : list_in(json, "buffers")) {
    if (!has_extension(buffer, "EXT_meshopt_compression") || buffer.contains("uri")) continue;
    buffer["uri"] = "data:application/octet-stream;base64,AAAA";
    buffer["byteLength"] = 3;
    changed = true;
  }
  return changed;
}

}  // namespace

Json& list_in(Json& object, const char* name) {
  static thread_local Json none;
  none = Json::array();
  return object.is_object() && object.contains(name) && object[name].is_array() ? object[name] : none;
}

bool nests_too_deep(const char* begin, const char* end) {
  int depth = 0;
  bool in_text = false;
  for (const char* c = begin; c != end; ++c) {
    if (in_text) {
      if (*c == '\\' && c + 1 != end) {
        ++c;
      } else if (*c == '"') {
        in_text = false;
      }
      continue;
    }
    if (*c == '"') in_text = true;
    if ((*c == '{' || *c == '[') && ++depth > max_depth) return true;
    if (*c == '}' || *c == ']') --depth;
  }
  return false;
}

bool make_readable(Json& json) {
  const bool indices = remove_compressed_indices(json);
  const bool buffers = fill_empty_buffers(json);
  return indices || buffers;
}

}  // namespace lichtmc
