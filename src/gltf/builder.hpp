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

#include "room/bounds.hpp"

namespace lichtmc {

class GltfBuilder {
 public:
  using Json = nlohmann::ordered_json;

  // offset_m: subtracted from all positions, so that float represents them (see file_offset()). Unless it is 0, all
  // nodes become children of one node with this translation, and `extras` of that node and of the asset contain it.
  explicit GltfBuilder(const glm::dvec3& offset_m = glm::dvec3(0.0));

  // The caller fills the arrays without a function below ("meshes", "materials", "textures", …).
  Json json;

  // Each function returns the index of the object that it added.
  std::size_t add_view(const void* data, std::size_t bytes);
  std::size_t add_positions(const std::vector<glm::dvec3>& world_m);  // at least one; stored as floats
  std::size_t add_vectors(const std::vector<std::array<float, 2>>& vectors);
  std::size_t add_vectors(const std::vector<std::array<float, 3>>& vectors);
  std::size_t add_indices(const std::vector<std::uint32_t>& indices);
  std::size_t add_png(const std::string& name, std::string_view png);
  std::size_t add_node(Json node);

  void use_extension(const std::string& name);

  // A node at a position; an empty name is left out.
  Json placed_node(const std::string& name, const glm::dvec3& world_m) const;

  // The document as a .glb file. Throws RuntimeError from 4 GiB on.
  std::string binary();
  // The document as a .gltf file with the buffer embedded.
  std::string text();

 private:
  std::size_t add_accessor(const void* data, std::size_t bytes, Json accessor, int target);
  void move_to_offset();
  void finish();

  std::string buffer_;
  glm::dvec3 offset_m_;
};

// The offset for a file whose positions lie within these bounds: 0 if the largest coordinate is at most 32 times the
// largest edge of the box. Floats then lose up to five of their 24 bits, and are rounded by less than a millionth of
// the room's size, the resolution of the tracers. Farther out: the middle of the box, in whole metres (in a box below 1
// m: in multiples of a power of two that is not larger than its largest edge).
glm::dvec3 file_offset(const Bounds& bounds);

}  // namespace lichtmc
