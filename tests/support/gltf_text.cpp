#include "support/gltf_text.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <stdexcept>

#include <stdlib.h>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"

namespace lichtmc::test {

using nlohmann::json;

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "lichtmc_test_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

std::string base64_of(const void* data, std::size_t bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* in = static_cast<const unsigned char*>(data);
  std::string text;
  for (std::size_t k = 0; k < bytes; k += 3) {
    const std::size_t rest = std::min<std::size_t>(3, bytes - k);
    const std::uint32_t group =
        std::uint32_t{in[k]} << 16 | (rest > 1 ? std::uint32_t{in[k + 1]} << 8 : 0U) | (rest > 2 ? in[k + 2] : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += j <= rest ? digits[group >> (18 - 6 * j) & 63U] : '=';
  }
  return text;
}

json triangle_document() {
  json document = json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"name": "floor", "mesh": 0},
              {"name": "lamp", "translation": [0.2, 1, 0.2], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "materials": [{"name": "paint", "extras": {"reflectance": 0.5}, "pbrMetallicRoughness": {"metallicFactor": 0}}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 10}]}}
  })");
  const std::size_t positions = add_accessor(document, std::vector<float>{0, 0, 0, 0, 0, 1, 1, 0, 0}, "VEC3", 5126, 3);
  document["meshes"] = json::array(
      {{{"name", "triangle"}, {"primitives", {{{"attributes", {{"POSITION", positions}}}, {"material", 0}}}}}});
  return document;
}

Room read_document(const json& document) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "room.gltf";
  std::ofstream(file) << document.dump();
  return read_gltf(file);
}

std::string refusal(const json& document) {
  try {
    read_document(document);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool ignores(const Room& room, const std::string& text) {
  return std::any_of(room.ignored.begin(), room.ignored.end(),
                     [&](const Ignored& thing) { return thing.what.find(text) != std::string::npos; });
}

}  // namespace lichtmc::test
