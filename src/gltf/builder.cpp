#include "gltf/builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "base/base64.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"

namespace lichtmc {

namespace {

constexpr int array_buffer = 34962;
constexpr int element_array_buffer = 34963;
constexpr int float_type = 5126;
constexpr int unsigned_int_type = 5125;

// Extends a text to the next multiple of 4 bytes.
void pad(std::string& text, char with) {
  text.resize((text.size() + 3) / 4 * 4, with);
}

void append_word(std::string& bytes, std::size_t value) {
  for (std::size_t k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xFFU);
}

// Bytes of names that are not UTF-8 are replaced.
std::string dump(const GltfBuilder::Json& json, int indent) {
  return json.dump(indent, ' ', false, GltfBuilder::Json::error_handler_t::replace);
}

}  // namespace

GltfBuilder::GltfBuilder(const glm::dvec3& offset_m) : offset_m_(offset_m) {
  json["asset"] = {{"version", "2.0"}, {"generator", "lichtmc " + std::string(version())}};
  json["scene"] = 0;
  json["scenes"] = Json::array({{{"nodes", Json::array()}}});
}

std::size_t GltfBuilder::add_view(const void* data, std::size_t bytes) {
  const std::size_t offset = buffer_.size();
  buffer_.append(static_cast<const char*>(data), bytes);
  pad(buffer_, '\0');  // aligns the next view to 4 bytes
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  return json["bufferViews"].size() - 1;
}

std::size_t GltfBuilder::add_accessor(const void* data, std::size_t bytes, Json accessor, int target) {
  const std::size_t view = add_view(data, bytes);
  json["bufferViews"][view]["target"] = target;
  accessor["bufferView"] = view;
  json["accessors"].push_back(std::move(accessor));
  return json["accessors"].size() - 1;
}

std::size_t GltfBuilder::add_positions(const std::vector<glm::dvec3>& world_m) {
  std::vector<std::array<float, 3>> positions;
  positions.reserve(world_m.size());
  for (const glm::dvec3& world : world_m) {
    const glm::dvec3 p = world - offset_m_;
    positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  const std::size_t number = add_vectors(positions);
  std::array<float, 3> low = positions.front();
  std::array<float, 3> high = positions.front();
  for (const auto& p : positions) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  }
  json["accessors"][number]["min"] = low;
  json["accessors"][number]["max"] = high;
  return number;
}

std::size_t GltfBuilder::add_vectors(const std::vector<std::array<float, 2>>& vectors) {
  return add_accessor(vectors.data(), vectors.size() * sizeof vectors.front(),
                      {{"componentType", float_type}, {"count", vectors.size()}, {"type", "VEC2"}}, array_buffer);
}

std::size_t GltfBuilder::add_vectors(const std::vector<std::array<float, 3>>& vectors) {
  return add_accessor(vectors.data(), vectors.size() * sizeof vectors.front(),
                      {{"componentType", float_type}, {"count", vectors.size()}, {"type", "VEC3"}}, array_buffer);
}

std::size_t GltfBuilder::add_indices(const std::vector<std::uint32_t>& indices) {
  return add_accessor(indices.data(), indices.size() * sizeof indices.front(),
                      {{"componentType", unsigned_int_type}, {"count", indices.size()}, {"type", "SCALAR"}},
                      element_array_buffer);
}

std::size_t GltfBuilder::add_png(const std::string& name, std::string_view png) {
  const std::size_t view = add_view(png.data(), png.size());
  json["images"].push_back({{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
  return json["images"].size() - 1;
}

std::size_t GltfBuilder::add_node(Json node) {
  // A new list moves the others: no reference to one of them may be kept while it is made.
  const std::size_t number = json["nodes"].size();
  json["nodes"].push_back(std::move(node));
  json["scenes"][0]["nodes"].push_back(number);
  return number;
}

void GltfBuilder::use_extension(const std::string& name) {
  Json& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void GltfBuilder::finish() {
  move_to_offset();
  if (!buffer_.empty()) json["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
  // The specification does not allow empty arrays.
  if (json["scenes"][0]["nodes"].empty()) json["scenes"][0].erase("nodes");
}

std::string GltfBuilder::binary() {
  finish();
  std::string text = dump(json, -1);
  pad(text, ' ');
  const std::size_t total = 12 + 8 + text.size() + (buffer_.empty() ? 0 : 8 + buffer_.size());
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw RuntimeError("The room is too large for a .glb file (" + std::to_string(total) +
                       " bytes; allowed: below 4 GiB). Split the room.");
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, total);
  append_word(bytes, text.size());
  bytes += "JSON" + text;
  if (buffer_.empty()) return bytes;
  append_word(bytes, buffer_.size());
  bytes += std::string("BIN\0", 4) + buffer_;
  return bytes;
}

std::string GltfBuilder::text() {
  finish();
  if (!buffer_.empty()) json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(buffer_);
  return dump(json, 1) + "\n";
}

GltfBuilder::Json GltfBuilder::placed_node(const std::string& name, const glm::dvec3& world_m) const {
  const glm::dvec3 p = world_m - offset_m_;
  Json node{{"translation", {p.x, p.y, p.z}}};
  if (!name.empty()) node["name"] = name;
  return node;
}

void GltfBuilder::move_to_offset() {
  Json& roots = json["scenes"][0]["nodes"];
  if (offset_m_ == glm::dvec3(0.0) || roots.empty()) return;
  const Json place{offset_m_.x, offset_m_.y, offset_m_.z};
  json["asset"]["extras"]["lichtmc"] = {{"offset_m", place}};
  Json children = std::move(roots);
  roots = Json::array();
  add_node({{"name", "offset"},
            {"translation", place},
            {"children", std::move(children)},
            {"extras", {{"lichtmc", {{"kind", "offset"}, {"offset_m", place}}}}}});
  offset_m_ = glm::dvec3(0.0);  // done
}

glm::dvec3 file_offset(const Bounds& bounds) {
  const glm::dvec3 size = bounds.high - bounds.low;
  const glm::dvec3 farthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  const double extent = std::max({size.x, size.y, size.z});
  constexpr double far_away = 32.0;
  if (!(std::max({farthest.x, farthest.y, farthest.z}) > far_away * extent) || !(extent > 0.0)) return glm::dvec3(0.0);
  const double step = std::min(1.0, std::exp2(std::floor(std::log2(extent))));
  return step * glm::round(0.5 * (bounds.low + bounds.high) / step);
}

}  // namespace lichtmc
