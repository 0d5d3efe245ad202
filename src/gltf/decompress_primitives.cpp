// KHR_draco_mesh_compression: decompresses the triangles and attributes of a primitive.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <draco/compression/decode.h>

#include "base/wide.hpp"
#include "gltf/decompress.hpp"

namespace lichtmc {

namespace {

constexpr const char* extension_name = "KHR_draco_mesh_compression";

// Adds a buffer with these values to the model. Returns the index of its accessor.
template <class T>
int add_accessor(tinygltf::Model& model, const std::vector<T>& values, int components, int type, int component_type) {
  tinygltf::Buffer buffer;
  buffer.data.resize(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(buffer.data.data(), values.data(), buffer.data.size());
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteLength = buffer.data.size();
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.componentType = component_type;
  accessor.type = type;
  accessor.count = values.size() / static_cast<std::size_t>(components);
  model.buffers.push_back(std::move(buffer));
  model.bufferViews.push_back(std::move(view));
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size() - 1);
}

std::unique_ptr<draco::Mesh> decode(const Document& document, const tinygltf::Value& extension,
                                    const std::string& where) {
  const auto& model = document.model;
  const auto view_number = static_cast<long long>(number_in(document, extension, "bufferView", -1.0, where));
  const auto& view =
      model.bufferViews[checked_index(document, view_number, model.bufferViews.size(), "the buffer view of " + where)];
  const auto& bytes =
      model.buffers[checked_index(document, view.buffer, model.buffers.size(), "the buffer of " + where)].data;
  if (static_cast<uint128>(view.byteOffset) + view.byteLength > bytes.size())
    refuse(document, where + " reaches beyond its buffer." + export_uncompressed);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()) + view.byteOffset, view.byteLength);
  draco::Decoder decoder;
  std::string reason;
  try {
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (mesh.ok()) return std::move(mesh).value();
    reason = mesh.status().error_msg_string();
  } catch (const std::exception& fault) {  // for example a stored length beyond the memory
    reason = fault.what();
  }
  refuse(document, where + " is damaged and cannot be decompressed (" + reason + ")." + export_uncompressed);
}

std::vector<std::uint32_t> indices_of(const draco::Mesh& mesh) {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t{3} * mesh.num_faces());
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
    for (const draco::PointIndex& point : mesh.face(face)) indices.push_back(point.value());
  }
  return indices;
}

// The values of an attribute, point by point. Integers are converted as stored: the accessor of the file, not the Draco
// data, states whether they are normalized.
std::vector<float> values_of(const Document& document, const draco::Mesh& mesh, draco::PointAttribute& attribute,
                             int components, const std::string& where) {
  attribute.set_normalized(false);
  std::vector<float> values(std::size_t{mesh.num_points()} * static_cast<std::size_t>(components));
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    float* value = values.data() + std::size_t{point.value()} * static_cast<std::size_t>(components);
    if (!attribute.ConvertValue<float>(attribute.mapped_index(point), static_cast<std::int8_t>(components), value))
      refuse(document, where + " has an attribute that cannot be converted to float." + export_uncompressed);
  }
  return values;
}

// The divisor of a normalized integer; 1 for other types.
float divisor_of(const tinygltf::Accessor& accessor) {
  if (!accessor.normalized) return 1.0F;
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return 127.0F;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 255.0F;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return 32767.0F;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 65535.0F;
    default:
      return 1.0F;
  }
}

// Number of components of an attribute that is read; 0 for others.
int components_of(const std::string& name) {
  if (name == "POSITION") return 3;
  if (name.rfind("TEXCOORD_", 0) == 0) return 2;
  const bool has_four = name == "COLOR_0" || name.rfind("JOINTS_", 0) == 0 || name.rfind("WEIGHTS_", 0) == 0;
  return has_four ? 4 : 0;
}

// Whether a morph target of a mesh has a weight.
bool is_morphed(const tinygltf::Model& model, std::size_t mesh) {
  const auto weighted = [](const std::vector<double>& weights) {
    return std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 0.0; });
  };
  return weighted(model.meshes[mesh].weights) ||
         std::any_of(model.nodes.begin(), model.nodes.end(), [&](const tinygltf::Node& node) {
           return node.mesh == static_cast<int>(mesh) && weighted(node.weights);
         });
}

// Morph targets are not compressed and refer to vertices in their original order, which only Draco's sequential
// encoding keeps (specification of KHR_draco_mesh_compression).
void check_order(const Document& document, const tinygltf::Value& extension, const std::string& where) {
  constexpr std::size_t place_of_method = 8;  // in the header of Draco data; 0: sequential
  const auto& model = document.model;
  const auto& view =
      model.bufferViews[static_cast<std::size_t>(number_in(document, extension, "bufferView", -1.0, where))];
  if (model.buffers[static_cast<std::size_t>(view.buffer)].data[view.byteOffset + place_of_method] == 0) return;
  refuse(document, where +
                       " changes the order of the vertices, but the mesh has morph targets with weights (allowed: "
                       "Draco's sequential encoding). Export the file without compression.");
}

void decompress(Document& document, tinygltf::Primitive& primitive, bool morphed, const std::string& where) {
  auto& model = document.model;
  const tinygltf::Value& extension = primitive.extensions.at(extension_name);
  const std::unique_ptr<draco::Mesh> mesh = decode(document, extension, where);
  if (morphed && !primitive.targets.empty()) check_order(document, extension, where);
  primitive.indices =
      add_accessor(model, indices_of(*mesh), 1, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  if (!extension.Has("attributes") || !extension.Get("attributes").IsObject())
    refuse(document, where + " has no 'attributes' object." + export_uncompressed);
  for (auto& [name, index] : primitive.attributes) {
    if (components_of(name) == 0 || !extension.Get("attributes").Has(name)) continue;
    const double id = number_in(document, extension.Get("attributes"), name.c_str(), -1.0, where);
    const int number = id >= 0.0 && id < 0x1p31 ? mesh->GetAttributeIdByUniqueId(static_cast<std::uint32_t>(id)) : -1;
    if (number < 0) refuse(document, where + " does not contain its attribute " + name + "." + export_uncompressed);
    const auto& described =
        model.accessors[checked_index(document, index, model.accessors.size(), "the accessor of " + name)];
    // Colours may have three or four components.
    const int components = name == "COLOR_0" && described.type == TINYGLTF_TYPE_VEC3 ? 3 : components_of(name);
    std::vector<float> values = values_of(document, *mesh, *mesh->attribute(number), components, where);
    const float divisor = divisor_of(described);
    for (float& value : values) value /= divisor;
    // tinygltf's types VEC2, VEC3, VEC4 are these numbers.
    static_assert(TINYGLTF_TYPE_VEC2 == 2 && TINYGLTF_TYPE_VEC3 == 3 && TINYGLTF_TYPE_VEC4 == 4);
    index = add_accessor(model, values, components, components, TINYGLTF_COMPONENT_TYPE_FLOAT);
  }
}

}  // namespace

void decompress_primitives(Document& document) {
  auto& meshes = document.model.meshes;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (std::size_t k = 0; k < meshes[m].primitives.size(); ++k) {
      tinygltf::Primitive& primitive = meshes[m].primitives[k];
      if (primitive.extensions.count(extension_name) == 0) continue;
      decompress(
          document, primitive, is_morphed(document.model, m),
          std::string(extension_name) + " of " + label("mesh", meshes[m].name, m) + ", primitive " + std::to_string(k));
    }
  }
}

}  // namespace lichtmc
