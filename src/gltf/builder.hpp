// Builds a glTF document: JSON and one binary buffer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace lichtmc {

class GltfBuilder {
 public:
  using Json = nlohmann::ordered_json;

  GltfBuilder();

  // The caller fills the arrays without a function below ("meshes", "materials", "textures", …).
  Json json;

  // Each function returns the index of the object that it added.
  std::size_t add_view(const void* data, std::size_t bytes);
  std::size_t add_positions(const std::vector<std::array<float, 3>>& positions);
  std::size_t add_vectors(const std::vector<std::array<float, 2>>& vectors);
  std::size_t add_vectors(const std::vector<std::array<float, 3>>& vectors);
  std::size_t add_indices(const std::vector<std::uint32_t>& indices);
  std::size_t add_png(const std::string& name, std::string_view png);
  std::size_t add_node(Json node);

  void use_extension(const std::string& name);

  // The document as a .glb file. Throws RuntimeError from 4 GiB on.
  std::string binary();
  // The document as a .gltf file with the buffer embedded.
  std::string text();

 private:
  std::size_t add_accessor(const void* data, std::size_t bytes, Json accessor, int target);
  void finish();

  std::string buffer_;
};

// A node at a position; an empty name is left out.
GltfBuilder::Json placed_node(const std::string& name, const glm::dvec3& position_m);

// Positions rounded to float, as glTF stores them.
std::vector<std::array<float, 3>> as_floats(const std::vector<glm::dvec3>& points);

}  // namespace lichtmc
