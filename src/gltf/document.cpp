#include "gltf/document.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include <nlohmann/json.hpp>

#include "base/message.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

constexpr const char* export_again = " Export the file again.";

// Extensions without which a room can be read rightly as well, or that are read.
constexpr std::array<const char*, 3> known_extensions{"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                                      "KHR_materials_unlit"};

std::string read_bytes(const std::filesystem::path& path, const std::string& file) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw InputError("Cannot read " + file + " (it is a folder). Give a .gltf or .glb file.");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError("Cannot open " + file + " (" + std::strerror(errno) + "). Check the name of the file.");
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) throw InputError("Cannot read " + file + ". Check the disk it is on.");
  if (bytes.empty()) throw InputError(file + ": the file is empty. Give a .gltf or .glb file.");
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

// The container: 12 bytes of header, then chunks of 8 bytes of header and their data (glTF 2.0 specification, section
// 4).
void check_container(const std::string& bytes, const std::string& file) {
  const auto require = [&file](bool sound, const std::string& what) {
    if (!sound) throw InputError(file + ": the GLB container is broken: " + what + "." + export_again);
  };
  constexpr std::uint32_t json_chunk = 0x4E4F534A;
  require(bytes.size() >= 20, "it ends within its header");
  require(word_at(bytes, 4) == 2, "its version is " + std::to_string(word_at(bytes, 4)) + " (allowed: 2)");
  const std::size_t length = word_at(bytes, 8);
  require(length <= bytes.size(),
          "it ends after " + std::to_string(bytes.size()) + " of " + std::to_string(length) + " bytes");
  require(length >= 20, "its length is given as " + std::to_string(length) + " bytes");
  require(word_at(bytes, 16) == json_chunk, "its first chunk is not JSON");
  for (std::size_t offset = 12; offset < length;) {
    require(length - offset >= 8, "a chunk ends within its header");
    const std::size_t size = word_at(bytes, offset);
    require(size <= length - offset - 8, "a chunk is longer than the file");
    offset += 8 + size;
  }
}

bool skip_image(tinygltf::Image* /*image*/, const int /*index*/, std::string* /*error*/, std::string* /*warning*/,
                int /*width*/, int /*height*/, const unsigned char* /*bytes*/, int /*size*/, void* /*user*/) {
  return true;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

std::string joined(const std::string& text) {
  std::string all;
  for (const std::string& line : lines_of(text)) all += (all.empty() ? "" : "; ") + line;
  return all.empty() ? "no reason is given" : all;
}

// The names in a list of the file, as far as its JSON can be read at all; the parser says what is wrong with it
// otherwise.
std::vector<std::string> names_in(const nlohmann::json& json, const char* list) {
  std::vector<std::string> names;
  if (!json.is_object() || !json.contains(list) || !json[list].is_array()) return names;
  for (const auto& name : json[list]) {
    if (name.is_string()) names.push_back(name.get<std::string>());
  }
  return names;
}

// Looked at before parsing: a parser that does not know a required extension fails with other words.
void check_extensions(const Document& document, const nlohmann::json& json) {
  for (const std::string& name : names_in(json, "extensionsRequired")) {
    const bool known =
        std::any_of(known_extensions.begin(), known_extensions.end(), [&](const char* k) { return name == k; });
    if (known) continue;
    refuse(document, "the file requires the extension " + in_quotes(name) +
                         ", which is not known here (known: KHR_lights_punctual, KHR_materials_emissive_strength, "
                         "KHR_materials_unlit). Export it without, for example uncompressed.");
  }
}

std::string advice_for(const nlohmann::json& json) {
  for (const std::string& name : names_in(json, "extensionsUsed")) {
    if (name.find("compression") != std::string::npos)
      return " It uses the extension " + in_quotes(name) + ": export the file uncompressed.";
  }
  return export_again;
}

void check_version(const Document& document) {
  const std::string& version = document.model.asset.version;
  const std::string& least = document.model.asset.minVersion;
  const auto is_2 = [](const std::string& v) {
    return v.size() >= 3 && v.compare(0, 2, "2.") == 0 && v.find_first_not_of("0123456789", 2) == std::string::npos;
  };
  if (!is_2(version)) refuse(document, "the glTF version is '" + version + "' (allowed: 2.0)." + export_again);
  if (!least.empty() && least != "2.0")
    refuse(document, "the file asks for glTF version '" + least + "' (allowed: 2.0)." + export_again);
}

}  // namespace

Document load_document(const std::filesystem::path& path) {
  Document document;
  document.file = path.string();
  const std::string bytes = read_bytes(path, document.file);
  constexpr std::size_t largest = std::numeric_limits<std::int32_t>::max();  // the parser counts bytes in 32 bits
  if (bytes.size() > largest) {
    throw InputError(document.file + ": the file has " + std::to_string(bytes.size()) +
                     " bytes (allowed: up to 2147483647). Split the room.");
  }
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(skip_image, nullptr);
  std::string error;
  std::string warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  const std::string folder = path.parent_path().string();
  bool parsed = false;
  nlohmann::json json;
  try {
    if (is_binary(bytes)) {
      check_container(bytes, document.file);
      json = nlohmann::json::parse(bytes.begin() + 20, bytes.begin() + 20 + word_at(bytes, 12), nullptr, false);
      check_extensions(document, json);
      parsed = parser.LoadBinaryFromMemory(&document.model, &error, &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()), size, folder);
    } else {
      json = nlohmann::json::parse(bytes, nullptr, false);
      check_extensions(document, json);
      parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, bytes.data(), size, folder);
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& reason) {
    error += reason.what();
  }
  if (!parsed)
    refuse(document, "this is not a glTF 2.0 file that can be read (" + joined(error) + ")." + advice_for(json));
  document.warnings = lines_of(warning);
  check_version(document);
  return document;
}

std::string label(const char* kind, const std::string& name, std::size_t index) {
  return std::string(kind) + " " + (name.empty() ? std::to_string(index) : in_quotes(name));
}

void refuse(const Document& document, const std::string& what_and_remedy) {
  throw InputError(document.file + ": " + what_and_remedy);
}

std::size_t checked_index(const Document& document, long long index, std::size_t count, const std::string& what) {
  if (index >= 0 && static_cast<unsigned long long>(index) < count) return static_cast<std::size_t>(index);
  refuse(document, what + " is number " + std::to_string(index) + ", but there are " + std::to_string(count) +
                       " (allowed: 0 to one below that)." + export_again);
}

double number_in(const Document& document, const tinygltf::Value& object, const char* name, double otherwise,
                 const std::string& where) {
  if (!object.IsObject() || !object.Has(name)) return otherwise;
  const tinygltf::Value& value = object.Get(name);
  if (!value.IsNumber())
    refuse(document, "'" + std::string(name) + "' of " + where + " is not a number. Give it as a number.");
  return value.GetNumberAsDouble();
}

}  // namespace lichtmc
