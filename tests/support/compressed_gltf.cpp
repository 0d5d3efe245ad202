#include "support/compressed_gltf.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include "lichtmc/gltf.hpp"
#include "support/gltf_text.hpp"

namespace lichtmc::test {

using nlohmann::json;

namespace {

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

void append_word(std::string& bytes, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

void pad(std::string& bytes, char with) {
  bytes.resize((bytes.size() + 3) / 4 * 4, with);
}

template <class T>
std::vector<T> values_of(const Glb& glb, std::size_t accessor) {
  const json& view = glb.json["bufferViews"][glb.json["accessors"][accessor]["bufferView"].get<std::size_t>()];
  std::vector<T> values(view["byteLength"].get<std::size_t>() / sizeof(T));
  std::memcpy(values.data(), glb.buffer.data() + view["byteOffset"].get<std::size_t>(), values.size() * sizeof(T));
  return values;
}

// Appends bytes to a buffer, aligned; returns their offset.
std::size_t append(std::string& buffer, const void* data, std::size_t bytes) {
  pad(buffer, '\0');
  const std::size_t offset = buffer.size();
  buffer.append(static_cast<const char*>(data), bytes);
  return offset;
}

void require_extension(json& document, const char* name) {
  document["extensionsUsed"].push_back(name);
  document["extensionsRequired"].push_back(name);
}

}  // namespace

Glb read_glb(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::size_t text = word_at(bytes, 12);
  Glb glb;
  glb.json = json::parse(bytes.substr(20, text));
  if (bytes.size() > 28 + text) glb.buffer = bytes.substr(28 + text, word_at(bytes, 20 + text));
  return glb;
}

void write_glb(const Glb& glb, const std::filesystem::path& file) {
  std::string text = glb.json.dump();
  std::string buffer = glb.buffer;
  pad(text, ' ');
  pad(buffer, '\0');
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, 28 + text.size() + buffer.size());
  append_word(bytes, text.size());
  bytes += "JSON" + text;
  append_word(bytes, buffer.size());
  bytes += std::string("BIN\0", 4) + buffer;
  std::ofstream(file, std::ios::binary) << bytes;
}

Glb glb_of(const Room& room) {
  const TemporaryFolder folder;
  write_gltf(room, folder.path() / "room.glb");
  return read_glb(folder.path() / "room.glb");
}

Glb with_meshopt(const Glb& plain) {
  Glb packed{plain.json, {}};
  std::size_t fallback = 0;
  for (json& view : packed.json["bufferViews"]) {
    if (!view.contains("target")) throw std::runtime_error("only vertices and indices are compressed here");
    const bool indices = view["target"] == 34963;
    const std::size_t bytes = view["byteLength"];
    const char* data = plain.buffer.data() + view["byteOffset"].get<std::size_t>();
    // Texture coordinates have 8 bytes, positions 12; the view's accessor determines the size.
    std::size_t stride = 4;
    for (const json& accessor : plain.json["accessors"]) {
      const auto& of = plain.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
      if (of["byteOffset"] == view["byteOffset"]) stride = bytes / accessor["count"].get<std::size_t>();
    }
    const std::size_t count = bytes / stride;
    std::vector<unsigned char> encoded(indices ? meshopt_encodeIndexBufferBound(count, count)
                                               : meshopt_encodeVertexBufferBound(count, stride));
    encoded.resize(indices ? meshopt_encodeIndexBuffer(encoded.data(), encoded.size(),
                                                       reinterpret_cast<const unsigned int*>(data), count)
                           : meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), data, count, stride));
    const std::size_t offset = append(packed.buffer, encoded.data(), encoded.size());
    view["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},          {"byteOffset", offset}, {"byteLength", encoded.size()},
        {"byteStride", stride}, {"count", count},       {"mode", indices ? "TRIANGLES" : "ATTRIBUTES"}};
    view["buffer"] = 1;
    view["byteOffset"] = fallback;
    if (!indices) view["byteStride"] = stride;
    fallback += bytes;
  }
  packed.json["buffers"] = {
      {{"byteLength", packed.buffer.size()}},
      {{"byteLength", fallback}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  require_extension(packed.json, "EXT_meshopt_compression");
  return packed;
}

Glb with_draco(const Glb& plain, int bits) {
  Glb packed{plain.json, {}};
  packed.json["bufferViews"] = json::array();
  for (json& mesh : packed.json["meshes"]) {
    for (json& primitive : mesh["primitives"]) {
      const std::vector<std::uint32_t> indices = values_of<std::uint32_t>(plain, primitive["indices"]);
      draco::TriangleSoupMeshBuilder builder;
      builder.Start(static_cast<int>(indices.size() / 3));
      json attributes;
      for (const auto& [name, accessor] : primitive["attributes"].items()) {
        const bool position = name == "POSITION";
        const std::vector<float> values = values_of<float>(plain, accessor);
        const std::size_t size = position || name == "COLOR_0" ? 3 : 2;
        const int id =
            builder.AddAttribute(position ? draco::GeometryAttribute::POSITION : draco::GeometryAttribute::TEX_COORD,
                                 static_cast<std::int8_t>(size), draco::DT_FLOAT32);
        for (std::size_t face = 0; face < indices.size() / 3; ++face) {
          const float* corner[3];
          for (std::size_t k = 0; k < 3; ++k) corner[k] = values.data() + size * indices[3 * face + k];
          builder.SetAttributeValuesForFace(id, draco::FaceIndex(static_cast<std::uint32_t>(face)), corner[0],
                                            corner[1], corner[2]);
        }
        attributes[name] = id;
      }
      const std::unique_ptr<draco::Mesh> built = builder.Finalize();
      for (auto& [name, id] : attributes.items()) id = built->attribute(id.get<int>())->unique_id();
      draco::Encoder encoder;
      encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
      encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, bits);
      draco::EncoderBuffer encoded;
      if (!encoder.EncodeMeshToBuffer(*built, &encoded).ok()) throw std::runtime_error("Draco cannot encode this");
      const std::size_t offset = append(packed.buffer, encoded.data(), encoded.size());
      primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", packed.json["bufferViews"].size()},
                                                               {"attributes", attributes}};
      packed.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", encoded.size()}});
    }
  }
  for (json& accessor : packed.json["accessors"]) accessor.erase("bufferView");
  packed.json["buffers"] = {{{"byteLength", packed.buffer.size()}}};
  require_extension(packed.json, "KHR_draco_mesh_compression");
  return packed;
}

}  // namespace lichtmc::test
