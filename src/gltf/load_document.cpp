#include "gltf/load_document.hpp"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/message.hpp"
#include "base/read_file.hpp"
#include "gltf/custom_properties.hpp"
#include "gltf/decompress.hpp"
#include "gltf/extensions.hpp"
#include "gltf/external_files.hpp"
#include "gltf/prepare.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

// The parser counts bytes in 32 bits.
constexpr std::size_t most_bytes = std::numeric_limits<std::int32_t>::max();

std::string read_bytes(const std::filesystem::path& path, const std::string& file) {
  std::string bytes = require_regular_file(path, most_bytes, file, "Give the name of a .gltf or .glb file.",
                                           "Split the room into files, or leave out what is small.");
  if (bytes.empty()) throw InputError(file + ": the file is empty. Give the name of a .gltf or .glb file.");
  return bytes;
}

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word |= std::uint32_t{static_cast<unsigned char>(bytes[offset + k])} << (8 * k);
  return word;
}

bool is_binary(const std::string& bytes) {
  return bytes.compare(0, 4, "glTF") == 0;
}

// The container: a header of 12 bytes, then chunks, each with a header of 8 bytes and its data (glTF 2.0
// specification, section 4).
void check_container(const std::string& bytes, const std::string& file) {
  const auto require = [&file](bool sound, const std::string& what) {
    if (!sound) throw InputError(file + ": the GLB container is damaged (" + what + ")." + export_again);
  };
  constexpr std::uint32_t json_chunk = 0x4E4F534A;
  require(bytes.size() >= 20, "it ends within its header");
  require(word_at(bytes, 4) == 2, "its version is " + std::to_string(word_at(bytes, 4)) + " (allowed: 2)");
  const std::size_t length = word_at(bytes, 8);
  require(length <= bytes.size(),
          "it ends after " + std::to_string(bytes.size()) + " of " + std::to_string(length) + " bytes");
  require(length >= 20, "its header states a length of " + std::to_string(length) + " bytes");
  require(word_at(bytes, 16) == json_chunk, "its first chunk is not JSON");
  for (std::size_t offset = 12; offset < length;) {
    require(length - offset >= 8, "a chunk ends within its header");
    const std::size_t size = word_at(bytes, offset);
    require(size <= length - offset - 8, "a chunk is longer than the file");
    offset += 8 + size;
  }
}

using Images = std::vector<std::vector<unsigned char>>;

// Stores an image undecoded: only base colour images are decoded, and later. The parser has not yet checked the buffer
// view of an image in a buffer: store_images_in_buffers() does that.
bool store_image(tinygltf::Image* image, const int index, std::string* /*error*/, std::string* /*warning*/,
                 int /*width*/, int /*height*/, const unsigned char* bytes, int size, void* user) {
  Images& images = *static_cast<Images*>(user);
  const auto k = static_cast<std::size_t>(index);
  if (images.size() <= k) images.resize(k + 1);
  if (image->bufferView < 0 && bytes != nullptr && size > 0) images[k].assign(bytes, bytes + size);
  return true;
}

void store_images_in_buffers(Document& document) {
  const auto& model = document.model;
  for (std::size_t k = 0; k < model.images.size(); ++k) {
    if (model.images[k].bufferView < 0) continue;
    const std::string where = label("image", model.images[k].name, k);
    const std::string_view bytes = bytes_of_view(document, model.images[k].bufferView, where);
    document.images[k].assign(bytes.begin(), bytes.end());
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

// The lines of a message of the parser, which may quote whole buffers.
std::string joined(const std::string& text) {
  constexpr std::size_t longest = 200;
  std::string all;
  for (std::string line : lines_of(text)) {
    // "[json.exception.parse_error.101] parse error at line 1": only the second part means something to a user.
    const std::size_t end = line.find("] ");
    if (line.compare(0, 16, "[json.exception.") == 0 && end != std::string::npos) line.erase(0, end + 2);
    if (line.size() > longest) line = line.substr(0, longest) + "…";
    all += (all.empty() ? "" : "; ") + line;
  }
  return all.empty() ? "unknown reason" : all;
}

void check_version(const Document& document) {
  const std::string& version = document.model.asset.version;
  const std::string& least = document.model.asset.minVersion;
  const auto is_2 = [](const std::string& v) {
    return v.size() >= 3 && v.compare(0, 2, "2.") == 0 && v.find_first_not_of("0123456789", 2) == std::string::npos;
  };
  if (!is_2(version)) refuse(document, "the glTF version is '" + version + "' (allowed: 2.0)." + export_again);
  if (!least.empty() && least != "2.0")
    refuse(document, "the file requires glTF version '" + least + "' (allowed: 2.0)." + export_again);
}

// Position of the JSON in the bytes of the file.
struct JsonText {
  std::size_t offset = 0;
  std::size_t size = 0;
};

void set_word(std::string& bytes, std::size_t offset, std::size_t value) {
  for (std::size_t k = 0; k < 4; ++k) bytes[offset + k] = static_cast<char>(value >> (8 * k) & 0xFF);
}

// Replaces the JSON of the file; the chunks after it stay unchanged.
void replace_json(std::string& bytes, bool binary, const JsonText& old, std::string text) {
  if (binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');  // chunks end at multiples of four bytes
    const std::size_t length = word_at(bytes, 8) - old.size + text.size();
    set_word(bytes, 12, text.size());
    set_word(bytes, 8, length);
  }
  bytes.replace(old.offset, old.size, text);
}

// Parses the bytes; the checks before parsing have passed.
void parse(Document& document, const std::string& bytes, bool binary, ExternalFiles& files) {
  tinygltf::TinyGLTF parser;
  files.serve(parser);
  parser.SetImageLoader(store_image, &document.images);
  std::string error;
  std::string warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  bool parsed = false;
  try {
    parsed = binary ? parser.LoadBinaryFromMemory(&document.model, &error, &warning,
                                                  reinterpret_cast<const unsigned char*>(bytes.data()), size, "")
                    : parser.LoadASCIIFromString(&document.model, &error, &warning, bytes.data(), size, "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // of its JSON library, whose text means nothing to a user
    error += "a value has an unexpected type or size";
  }
  if (!parsed) refuse(document, "the file is not valid glTF 2.0 (" + joined(error) + ")." + export_again);
  document.warnings = lines_of(warning);
  document.images.resize(document.model.images.size());
  document.image_uris.resize(document.model.images.size());
  for (std::size_t k = 0; k < document.images.size(); ++k) {
    if (document.image_uris[k].empty()) continue;
    document.images[k].clear();
    document.model.images[k].uri = document.image_uris[k];
  }
  store_images_in_buffers(document);
}

// The document of these bytes; its file and folder are set.
Document load(Document document, std::string bytes) {
  const bool binary = is_binary(bytes);
  if (binary) check_container(bytes, document.file);
  const JsonText text = binary ? JsonText{20, word_at(bytes, 12)} : JsonText{0, bytes.size()};
  if (nests_too_deep(bytes.data() + text.offset, bytes.data() + text.offset + text.size))
    refuse(document, "the JSON is nested deeper than 256 levels (the limit)." + std::string(export_again));
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(text.offset);
  nlohmann::json json = nlohmann::json::parse(begin, begin + static_cast<std::ptrdiff_t>(text.size), nullptr, false);
  document.extensions = extensions_in(json);
  check_required_extensions(document);
  ExternalFiles files;
  bool changed = make_readable(json);
  changed = files.take(json, document) || changed;
  bool completed = false;
  document.property_notes = check_custom_properties(document, json, completed);
  if (changed || completed) replace_json(bytes, binary, text, json.dump());
  parse(document, bytes, binary, files);
  check_version(document);
  decompress_views(document);
  decompress_primitives(document);
  return document;
}

}  // namespace

Document load_document(const std::filesystem::path& path, bool follow_links) {
  Document document;
  document.folder = path.parent_path();
  document.follow_links = follow_links;
  document.file = path.string();
  std::string bytes = read_bytes(path, document.file);
  return load(std::move(document), std::move(bytes));
}

Document parse_document(std::string_view bytes, const std::string& source) {
  if (bytes.empty() || bytes.size() > most_bytes) {
    throw InputError(source + ": there are " + std::to_string(bytes.size()) + " bytes (allowed: 1 to " +
                     std::to_string(most_bytes) + "). Give the content of a .gltf or .glb file.");
  }
  Document document;
  document.file = source;
  return load(std::move(document), std::string(bytes));
}

}  // namespace lichtmc
