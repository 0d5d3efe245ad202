// EXT_meshopt_compression: decompresses buffer views (A. Kapoulkine, glTF extension, 2020).
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <meshoptimizer.h>

#include "gltf/decompress.hpp"

namespace lichtmc {

namespace {

// The codecs need at least 1 bit for 256 bytes. A view that states a higher ratio is damaged: it is rejected before
// memory is allocated for it.
constexpr std::uint64_t max_compression_ratio = 2048;
constexpr std::uint64_t always_allowed_bytes = 4096;

enum class Mode { attributes, triangles, indices };

// A compressed buffer view.
struct Packed {
  const unsigned char* data = nullptr;
  std::size_t size = 0;
  std::size_t stride = 0;
  std::size_t count = 0;
  Mode mode = Mode::attributes;
  std::string filter;
};

std::uint64_t whole_number(const Document& document, const tinygltf::Value& object, const char* name, double otherwise,
                           const std::string& where) {
  const double value = number_in(document, object, name, otherwise, where);
  if (value >= 0.0 && value < 0x1p32 && value == std::floor(value)) return static_cast<std::uint64_t>(value);
  refuse(document,
         "'" + std::string(name) + "' of " + where + " is not a whole number below 2^32." + export_uncompressed);
}

std::string text_in(const tinygltf::Value& object, const char* name, const char* otherwise) {
  return object.Has(name) && object.Get(name).IsString() ? object.Get(name).Get<std::string>() : otherwise;
}

// Reads the position of the compressed data and the size of the decompressed data.
Packed read_extent(const Document& document, const tinygltf::Value& extension, const std::string& where) {
  Packed packed;
  const std::uint64_t buffer = whole_number(document, extension, "buffer", -1.0, where);
  const std::uint64_t offset = whole_number(document, extension, "byteOffset", 0.0, where);
  packed.size = whole_number(document, extension, "byteLength", -1.0, where);
  packed.stride = whole_number(document, extension, "byteStride", -1.0, where);
  packed.count = whole_number(document, extension, "count", -1.0, where);
  const auto& buffers = document.model.buffers;
  const auto& bytes =
      buffers[checked_index(document, static_cast<long long>(buffer), buffers.size(), "the buffer of " + where)].data;
  // Each is below 2³²: the sum does not overflow.
  if (offset + packed.size > bytes.size())
    refuse(document, where + " reaches beyond its buffer." + export_uncompressed);
  packed.data = bytes.data() + offset;
  return packed;
}

// Whether the extension allows this stride for attributes and their filter.
bool is_attribute_stride(std::size_t stride, const std::string& filter) {
  if (filter == "OCTAHEDRAL") return stride == 4 || stride == 8;
  if (filter == "QUATERNION") return stride == 8;
  if (filter != "NONE" && filter != "EXPONENTIAL") return false;
  return stride > 0 && stride <= 256 && stride % 4 == 0;
}

// Reads mode and filter. Returns false if the extension does not allow them together with stride and count.
bool read_mode(const tinygltf::Value& extension, const std::string& mode, Packed& packed) {
  packed.filter = text_in(extension, "filter", "NONE");
  if (mode == "ATTRIBUTES") return is_attribute_stride(packed.stride, packed.filter);
  if (mode != "TRIANGLES" && mode != "INDICES") return false;
  packed.mode = mode == "TRIANGLES" ? Mode::triangles : Mode::indices;
  return (packed.stride == 2 || packed.stride == 4) && packed.filter == "NONE" &&
         (packed.mode == Mode::indices || packed.count % 3 == 0);
}

Packed read_description(const Document& document, const tinygltf::Value& extension, const std::string& where) {
  if (!extension.IsObject()) refuse(document, where + " is not an object." + export_uncompressed);
  Packed packed = read_extent(document, extension, where);
  const std::string mode = text_in(extension, "mode", "(none)");
  if (!read_mode(extension, mode, packed)) {
    refuse(document, where + " has values that the extension does not allow together (mode " + mode + ", filter " +
                         packed.filter + ", stride " + std::to_string(packed.stride) + ", count " +
                         std::to_string(packed.count) + ")." + export_uncompressed);
  }
  if (std::uint64_t{packed.count} * packed.stride > max_compression_ratio * packed.size + always_allowed_bytes)
    refuse(document, where + " states more elements than its data can hold." + export_uncompressed);
  return packed;
}

std::vector<unsigned char> decompressed(const Document& document, const Packed& packed, const std::string& where) {
  std::vector<unsigned char> bytes(packed.count * packed.stride);
  int fault = 0;
  switch (packed.mode) {
    case Mode::attributes:
      fault = meshopt_decodeVertexBuffer(bytes.data(), packed.count, packed.stride, packed.data, packed.size);
      break;
    case Mode::triangles:
      fault = meshopt_decodeIndexBuffer(bytes.data(), packed.count, packed.stride, packed.data, packed.size);
      break;
    case Mode::indices:
      fault = meshopt_decodeIndexSequence(bytes.data(), packed.count, packed.stride, packed.data, packed.size);
      break;
  }
  if (fault != 0) refuse(document, where + " is damaged and cannot be decompressed." + export_uncompressed);
  if (packed.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), packed.count, packed.stride);
  if (packed.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), packed.count, packed.stride);
  if (packed.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), packed.count, packed.stride);
  return bytes;
}

}  // namespace

void decompress_views(Document& document) {
  auto& model = document.model;
  for (std::size_t k = 0; k < model.bufferViews.size(); ++k) {
    auto& view = model.bufferViews[k];
    const auto extension = view.extensions.find("EXT_meshopt_compression");
    if (extension == view.extensions.end()) continue;
    const std::string where = "EXT_meshopt_compression of " + label("buffer view", view.name, k);
    const Packed packed = read_description(document, extension->second, where);
    tinygltf::Buffer buffer;
    buffer.data = decompressed(document, packed, where);
    view.buffer = static_cast<int>(model.buffers.size());
    view.byteOffset = 0;
    view.byteLength = buffer.data.size();
    model.buffers.push_back(std::move(buffer));
  }
}

}  // namespace lichtmc
