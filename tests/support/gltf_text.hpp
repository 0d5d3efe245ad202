// Small glTF files for tests, built as JSON and read back from a temporary folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc::test {

// A folder; the destructor removes it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// A document with a right triangle ("floor", corners (0,0,0), (0,0,1), (1,0,0), material "paint" of reflectance 0.5)
// and a point light "lamp" of 10 cd.
nlohmann::json triangle_document();

// Appends an accessor with its own buffer to a document and returns its number. `type` "SCALAR", "VEC2", "VEC3";
// component type as in glTF.
template <class T>
std::size_t add_accessor(nlohmann::json& document, const std::vector<T>& values, const char* type, int component_type,
                         std::size_t components);

// The room that read_gltf() makes from a document.
Room read_document(const nlohmann::json& document);
// The message of the InputError that reading it throws; empty if it throws none.
std::string refusal(const nlohmann::json& document);

// Whether one of a room's `ignored` lines contains a text.
bool ignores(const Room& room, const std::string& text);

// Bytes of numbers as base64.
std::string base64_of(const void* data, std::size_t bytes);

template <class T>
std::size_t add_accessor(nlohmann::json& document, const std::vector<T>& values, const char* type, int component_type,
                         std::size_t components) {
  const std::size_t bytes = values.size() * sizeof(T);
  document["buffers"].push_back(
      {{"byteLength", bytes}, {"uri", "data:application/octet-stream;base64," + base64_of(values.data(), bytes)}});
  document["bufferViews"].push_back({{"buffer", document["buffers"].size() - 1}, {"byteLength", bytes}});
  document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                   {"componentType", component_type},
                                   {"count", values.size() / components},
                                   {"type", type}});
  return document["accessors"].size() - 1;
}

}  // namespace lichtmc::test
