#include "gltf/accessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/wide.hpp"

namespace lichtmc {

namespace {

// Elements in a buffer, `stride` bytes apart.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
};

std::size_t component_size(const Document& document, int type, const std::string& where) {
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
  if (size <= 0)
    refuse(document, where + " has components of the unknown type " + std::to_string(type) + "." + export_again);
  return static_cast<std::size_t>(size);
}

// `count` elements of a buffer view, the first at `offset`; stride 0: tightly packed.
Elements elements_in(const Document& document, long long view_index, std::size_t offset, std::size_t count,
                     std::size_t size, std::size_t stride, const std::string& where) {
  const auto& model = document.model;
  const auto& view =
      model.bufferViews[checked_index(document, view_index, model.bufferViews.size(), "the buffer view of " + where)];
  const auto& bytes =
      model.buffers[checked_index(document, view.buffer, model.buffers.size(), "the buffer of " + where)].data;
  if (stride == 0) stride = size;
  // 128 bits: the sums of the file's 64-bit numbers do not overflow.
  const uint128 view_end = static_cast<uint128>(view.byteOffset) + view.byteLength;
  const uint128 end = static_cast<uint128>(offset) + (count > 0 ? static_cast<uint128>(count - 1) * stride + size : 0);
  if (view_end > bytes.size() || end > view.byteLength) {
    refuse(document, where + " reaches beyond its buffer (" + std::to_string(count) + " elements from byte " +
                         std::to_string(offset) + "; the view has " + std::to_string(view.byteLength) +
                         " bytes, the buffer " + std::to_string(bytes.size()) + ")." + export_again);
  }
  if (stride < size)
    refuse(document, where + " has elements that overlap (stride " + std::to_string(stride) + " bytes, element size " +
                         std::to_string(size) + " bytes)." + export_again);
  return {bytes.data() + view.byteOffset + offset, stride, count};
}

double component(const unsigned char* bytes, int type, bool normalized) {
  const auto read = [bytes](auto value) {
    std::memcpy(&value, bytes, sizeof value);
    return value;
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return static_cast<double>(read(float{}));
    // −128 and −127 both mean −1 (glTF 2.0 specification, section 3.6.2.2).
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalized ? std::max(read(std::int8_t{}) / 127.0, -1.0) : read(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalized ? std::max(read(std::int16_t{}) / 32767.0, -1.0) : read(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return read(std::uint8_t{}) / (normalized ? 255.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return read(std::uint16_t{}) / (normalized ? 65535.0 : 1.0);
    default:  // TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: the callers have excluded all other types
      return read(std::uint32_t{});
  }
}

// Component types of coordinates: float; with KHR_mesh_quantization also byte and short, normalized or not.
bool is_coordinate(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_FLOAT || type == TINYGLTF_COMPONENT_TYPE_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

bool is_unsigned(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// Replaces some of the values by the accessor's sparse elements.
void overlay_sparse(const Document& document, const tinygltf::Accessor& accessor, std::size_t components,
                    const std::string& where, std::vector<double>& values) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count ||
      !is_unsigned(sparse.indices.componentType)) {
    refuse(document, where + " has invalid sparse elements (allowed: at most as many as the accessor has, with " +
                         "unsigned integer indices)." + export_again);
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  const std::size_t index_size = component_size(document, sparse.indices.componentType, where);
  const std::size_t value_size = component_size(document, accessor.componentType, where);
  const Elements indices =
      elements_in(document, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                  index_size, 0, where);
  const Elements replaced =
      elements_in(document, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                  components * value_size, 0, where);
  for (std::size_t k = 0; k < count; ++k) {
    const auto index =
        static_cast<std::size_t>(component(indices.first + k * indices.stride, sparse.indices.componentType, false));
    checked_index(document, static_cast<long long>(index), accessor.count, "a sparse element of " + where);
    for (std::size_t c = 0; c < components; ++c) {
      values[index * components + c] =
          component(replaced.first + k * replaced.stride + c * value_size, accessor.componentType, accessor.normalized);
    }
  }
}

// The values of an accessor without a buffer view: 0, except for its sparse elements.
std::vector<double> sparse_values_of(const Document& document, const tinygltf::Accessor& accessor,
                                     std::size_t components, const std::string& where) {
  if (!accessor.sparse.isSparse) {
    refuse(document,
           where + " has no data (perhaps an unsupported extension compresses it). Export the file uncompressed.");
  }
  // The count alone determines the memory needed: untrusted input, so it is limited by the size of the file.
  std::size_t bytes = 0;
  for (const auto& buffer : document.model.buffers) bytes += buffer.data.size();
  constexpr std::size_t zeros_per_byte = 1000;
  if (accessor.count / zeros_per_byte > bytes)
    refuse(document, where + " has " + std::to_string(accessor.count) + " elements, too many for a file with " +
                         std::to_string(bytes) + " bytes of data (allowed: 1000 per byte)." + export_again);
  std::vector<double> values(accessor.count * components, 0.0);
  overlay_sparse(document, accessor, components, where, values);
  return values;
}

// The values in an accessor's buffer view, without its sparse elements.
std::vector<double> stored_values_of(const Document& document, const tinygltf::Accessor& accessor,
                                     std::size_t components, std::size_t size, const std::string& where) {
  const auto& views = document.model.bufferViews;
  const auto& view = views[checked_index(document, accessor.bufferView, views.size(), "the buffer view of " + where)];
  const int stride = accessor.ByteStride(view);
  if (stride <= 0)
    refuse(document, where + " has a byte stride that its component type does not allow." + export_again);
  const Elements elements = elements_in(document, accessor.bufferView, accessor.byteOffset, accessor.count,
                                        components * size, view.byteStride, where);
  std::vector<double> values;
  values.reserve(accessor.count * components);
  for (std::size_t k = 0; k < elements.count; ++k) {
    for (std::size_t c = 0; c < components; ++c) {
      values.push_back(
          component(elements.first + k * elements.stride + c * size, accessor.componentType, accessor.normalized));
    }
  }
  return values;
}

// All components of an accessor, element by element.
std::vector<double> values_of(const Document& document, const tinygltf::Accessor& accessor, std::size_t components,
                              const std::string& where) {
  constexpr std::size_t max_count = std::size_t{1} << 31;
  if (accessor.count > max_count)
    refuse(document,
           where + " has " + std::to_string(accessor.count) + " elements (allowed: up to 2^31)." + export_again);
  const std::size_t size = component_size(document, accessor.componentType, where);
  if (accessor.bufferView < 0) return sparse_values_of(document, accessor, components, where);
  std::vector<double> values = stored_values_of(document, accessor, components, size, where);
  if (accessor.sparse.isSparse) overlay_sparse(document, accessor, components, where, values);
  return values;
}

const tinygltf::Accessor& accessor_of(const Document& document, int index, int type, const char* type_name,
                                      const std::string& where) {
  const auto& accessors = document.model.accessors;
  const auto& accessor = accessors[checked_index(document, index, accessors.size(), "the accessor of " + where)];
  if (accessor.type != type) refuse(document, where + " is not of the type " + type_name + "." + export_again);
  return accessor;
}

// Coordinates as stored in the file, element by element.
std::vector<double> coordinates(const Document& document, int index, int type, const char* type_name,
                                std::size_t components, const std::string& where) {
  const auto& accessor = accessor_of(document, index, type, type_name, where);
  if (!is_coordinate(accessor.componentType))
    refuse(document, where + " are neither floats, bytes nor shorts (the types allowed)." + export_again);
  return values_of(document, accessor, components, where);
}

}  // namespace

std::vector<glm::dvec3> read_vectors(const Document& document, int index, const std::string& where) {
  const std::vector<double> values = coordinates(document, index, TINYGLTF_TYPE_VEC3, "VEC3", 3, where);
  std::vector<glm::dvec3> vectors(values.size() / 3);
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = values[3 * k + c];
      if (!std::isfinite(value)) {
        refuse(document, where + ": number " + std::to_string(k) + " is " + (std::isnan(value) ? "NaN" : "infinite") +
                             " (allowed: finite numbers). Repair the mesh and export it again.");
      }
      vectors[k][static_cast<glm::length_t>(c)] = value;
    }
  }
  return vectors;
}

std::vector<glm::dquat> read_rotations(const Document& document, int index, const std::string& where) {
  const std::vector<double> values = coordinates(document, index, TINYGLTF_TYPE_VEC4, "VEC4", 4, where);
  std::vector<glm::dquat> rotations;
  for (std::size_t k = 0; k + 3 < values.size(); k += 4) {
    const glm::dquat rotation(values[k + 3], values[k], values[k + 1], values[k + 2]);
    const double length = glm::length(rotation);
    if (!(length > 0.0) || !std::isfinite(length)) {
      refuse(document, where + ": number " + std::to_string(k / 4) +
                           " has length 0 or is not finite (allowed: quaternions of length 1)." + export_again);
    }
    rotations.push_back(rotation / length);  // the stored length is 1 up to rounding
  }
  return rotations;
}

std::vector<glm::dvec2> read_texture_coordinates(const Document& document, int index, const std::string& where) {
  const std::vector<double> values = coordinates(document, index, TINYGLTF_TYPE_VEC2, "VEC2", 2, where);
  std::vector<glm::dvec2> uvs(values.size() / 2);
  for (std::size_t k = 0; k < uvs.size(); ++k) uvs[k] = {values[2 * k], values[2 * k + 1]};
  return uvs;
}

std::vector<glm::dvec3> read_colours(const Document& document, int index, const std::string& where) {
  const auto& accessors = document.model.accessors;
  const auto& accessor = accessors[checked_index(document, index, accessors.size(), "the accessor of " + where)];
  const bool opacity = accessor.type == TINYGLTF_TYPE_VEC4;
  if (!opacity && accessor.type != TINYGLTF_TYPE_VEC3)
    refuse(document, where + " are neither of the type VEC3 nor of the type VEC4." + export_again);
  const bool fractions = accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                                 accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !fractions)
    refuse(document, where +
                         " are neither floats nor normalized unsigned bytes or shorts (the types allowed). Export the "
                         "file again, or set the reflectance of the material: custom property 'reflectance', or "
                         "--reflectance NAME=R.");
  const std::size_t components = opacity ? 4 : 3;
  const std::vector<double> values = values_of(document, accessor, components, where);
  std::vector<glm::dvec3> colours(values.size() / components);
  for (std::size_t k = 0; k < colours.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = values[components * k + c];
      if (std::isnan(value))
        refuse(document, where + ": number " + std::to_string(k) + " is NaN (allowed: 0 to 1)." + export_again);
      colours[k][static_cast<glm::length_t>(c)] = std::clamp(value, 0.0, 1.0);
    }
  }
  return colours;
}

std::vector<glm::uvec4> read_joints(const Document& document, int index, std::size_t joints, const std::string& where) {
  const auto& accessor = accessor_of(document, index, TINYGLTF_TYPE_VEC4, "VEC4", where);
  if (!is_unsigned(accessor.componentType) && accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
    refuse(document, where + " are not unsigned integers (the types allowed)." + export_again);
  const std::vector<double> values = values_of(document, accessor, 4, where);
  std::vector<glm::uvec4> numbers(values.size() / 4);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double value = values[k];
    if (!(value >= 0.0 && value < static_cast<double>(joints)) || value != std::floor(value))
      refuse(document, where + ": number " + std::to_string(k / 4) + " refers to joint " + std::to_string(value) +
                           " (the skin has " + std::to_string(joints) + ")." + export_again);
    numbers[k / 4][static_cast<glm::length_t>(k % 4)] = static_cast<std::uint32_t>(value);
  }
  return numbers;
}

std::vector<glm::dvec4> read_weights(const Document& document, int index, const std::string& where) {
  const std::vector<double> values = coordinates(document, index, TINYGLTF_TYPE_VEC4, "VEC4", 4, where);
  std::vector<glm::dvec4> weights(values.size() / 4);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!(values[k] >= 0.0) || !std::isfinite(values[k]))
      refuse(document, where + ": number " + std::to_string(k / 4) +
                           " is negative or not finite (allowed: finite numbers, 0 or more)." + export_again);
    weights[k / 4][static_cast<glm::length_t>(k % 4)] = values[k];
  }
  return weights;
}

std::vector<glm::dmat4> read_matrices(const Document& document, int index, const std::string& where) {
  const auto& accessor = accessor_of(document, index, TINYGLTF_TYPE_MAT4, "MAT4", where);
  if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
    refuse(document, where + " are not floats (the type allowed)." + export_again);
  const std::vector<double> values = values_of(document, accessor, 16, where);
  std::vector<glm::dmat4> matrices(values.size() / 16);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k]))
      refuse(document, where + ": number " + std::to_string(k / 16) + " is not finite." + export_again);
    matrices[k / 16][static_cast<glm::length_t>(k % 16 / 4)][static_cast<glm::length_t>(k % 4)] = values[k];
  }
  return matrices;
}

std::vector<std::uint32_t> read_indices(const Document& document, int index, std::size_t vertices,
                                        const std::string& where) {
  const auto& accessor = accessor_of(document, index, TINYGLTF_TYPE_SCALAR, "SCALAR", where);
  if (!is_unsigned(accessor.componentType))
    refuse(document, where + " are not unsigned integers (the types allowed)." + export_again);
  std::vector<std::uint32_t> indices;
  for (const double value : values_of(document, accessor, 1, where)) {
    indices.push_back(static_cast<std::uint32_t>(
        checked_index(document, static_cast<long long>(value), vertices, "a vertex in " + where)));
  }
  return indices;
}

}  // namespace lichtmc
