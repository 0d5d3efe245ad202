#include "gltf/external_files.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "base/memory.hpp"
#include "base/message.hpp"
#include "base/read_file.hpp"
#include "gltf/prepare.hpp"

namespace lichtmc {

namespace {

using Json = nlohmann::json;

constexpr const char* plain_data = "data:application/octet-stream;base64,";

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// Percent-encoding (RFC 3986, section 2.1). A "%" without two digits stays: some programs do not encode names.
std::string percent_decoded(const std::string& uri) {
  std::string name;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    const int high = uri[k] == '%' && k + 2 < uri.size() ? hex_digit(uri[k + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[k + 2]) : -1;
    if (low < 0) {
      name += uri[k];
      continue;
    }
    name += static_cast<char>(16 * high + low);
    k += 2;
  }
  return name;
}

// The scheme of a URI with at least two letters (RFC 3986, section 3.1); empty without. One letter is a drive.
std::string scheme_of(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string::npos || colon < 2 || std::isalpha(static_cast<unsigned char>(uri.front())) == 0) return "";
  const std::string scheme = uri.substr(0, colon);
  const bool valid = std::all_of(scheme.begin(), scheme.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
  });
  return valid ? scheme : "";
}

bool is_data(const std::string& uri) {
  return uri.compare(0, 5, "data:") == 0;
}

// The URI of an object of the file; null if it has none that is a text.
Json* uri_in(Json& object) {
  if (!object.is_object() || !object.contains("uri") || !object["uri"].is_string()) return nullptr;
  return &object["uri"];
}

// The parser knows data URIs by a list of media types, in which WebP is missing. It has no use for the type.
bool simplify_data_uri(Json& uri) {
  const std::string& text = uri.get_ref<const std::string&>();
  for (const char* known : {"data:image/png;base64,", "data:image/jpeg;base64,", plain_data}) {
    if (text.compare(0, std::string(known).size(), known) == 0) return false;
  }
  const std::string end_of_type = ";base64,";
  constexpr std::size_t longest_type = 200;
  const std::size_t end = text.substr(0, longest_type).find(end_of_type);
  if (end == std::string::npos) return false;
  uri = plain_data + text.substr(end + end_of_type.size());
  return true;
}

ContainedPath refused_without_folder() {
  ContainedPath refused;
  refused.fault = "the room is read from bytes in memory, which have no folder";
  refused.allowed = "embedded data: a .glb file, or data: in a .gltf file";
  refused.remedy = "Export the room as .glb with everything embedded, or read it from its file.";
  return refused;
}

}  // namespace

ContainedPath locate_name(const Document& document, const std::string& name) {
  if (!document.folder) return refused_without_folder();
  const std::string scheme = scheme_of(name);
  if (scheme.empty()) return path_within(*document.folder, name, document.follow_links);
  ContainedPath refused;
  refused.fault = "it has the scheme '" + scheme + ":'";
  refused.allowed = "a file beneath the folder of the file that names it, or data:";
  refused.remedy = "Copy the file there, and write its name relative to that folder.";
  return refused;
}

ContainedPath locate_uri(const Document& document, const std::string& uri) {
  // The scheme is looked for in the URI itself: "a%3Ab" is a name with a colon.
  return document.folder && scheme_of(uri).empty()
             ? path_within(*document.folder, percent_decoded(uri), document.follow_links)
             : locate_name(document, uri);
}

bool ExternalFiles::take(Json& json, Document& document) {
  const bool buffers = take_buffers(json, document);
  const bool images = take_images(json, document);
  return buffers || images;
}

bool ExternalFiles::take_buffers(Json& json, const Document& document) {
  bool changed = false;
  double together = 0.0;
  std::size_t index = 0;
  for (Json& buffer : list_in(json, "buffers")) {
    const std::size_t k = index++;
    Json* const uri = uri_in(buffer);
    // The parser reports a length that is missing or not a number.
    if (uri == nullptr || is_data(*uri) || !buffer.contains("byteLength") || !buffer["byteLength"].is_number_unsigned())
      continue;
    const std::string named = uri->get<std::string>();
    const std::string what = "the file " + in_quotes(named) + " of buffer " + std::to_string(k);
    const auto length = buffer["byteLength"].get<std::uint64_t>();
    together += static_cast<double>(length);
    if (together > memory_limit()) {
      refuse(document, "the buffers up to number " + std::to_string(k) + " have " + to_text(together) +
                           " bytes, more than the memory (allowed: up to " + to_text(memory_limit()) +
                           "). Split the room.");
    }
    const ContainedPath place = locate_uri(document, named);
    if (!place.fault.empty())
      refuse(document, what + " is not opened: " + place.fault + " (allowed: " + place.allowed + "). " + place.remedy);
    FileContent content = read_start_of_file(place.path, length);
    if (!content.fault.empty()) {
      refuse(document, what + " cannot be read (" + content.fault +
                           "; allowed: a regular file). Copy it into the folder of the room file, or export again.");
    }
    if (content.bytes.size() < length) {
      refuse(document, what + " has " + std::to_string(content.bytes.size()) +
                           " bytes (allowed: at least its byteLength, " + std::to_string(length) +
                           "). Export the file again.");
    }
    const std::string key = "buffer/" + std::to_string(k);
    content_[key].assign(content.bytes.begin(), content.bytes.end());
    *uri = key;
    changed = true;
  }
  return changed;
}

bool ExternalFiles::take_images(Json& json, Document& document) {
  bool changed = false;
  std::size_t index = 0;
  for (Json& image : list_in(json, "images")) {
    const std::size_t k = index++;
    document.image_uris.emplace_back();
    Json* const uri = uri_in(image);
    if (uri == nullptr) continue;
    if (is_data(*uri)) {
      changed = simplify_data_uri(*uri) || changed;
      continue;
    }
    document.image_uris[k] = uri->get<std::string>();
    // One byte in its place: without any the parser would report a missing file.
    const std::string key = "image/" + std::to_string(k);
    content_[key] = {0};
    *uri = key;
    changed = true;
  }
  return changed;
}

void ExternalFiles::serve(tinygltf::TinyGLTF& parser) {
  tinygltf::FsCallbacks access{};
  access.FileExists = [](const std::string& name, void* files) {
    return static_cast<ExternalFiles*>(files)->content_.count(name) != 0;
  };
  access.ExpandFilePath = [](const std::string& name, void*) { return name; };
  access.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string*, const std::string& name, void* files) {
    *bytes = std::move(static_cast<ExternalFiles*>(files)->content_.at(name));
    return true;
  };
  access.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  access.user_data = this;
  // Later releases of the parser ask for sizes, and keep their own access to files if one of the functions is missing.
  [](auto& functions) {
    if constexpr (requires { functions.GetFileSizeInBytes; }) {
      functions.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& name, void* files) {
        *size = static_cast<ExternalFiles*>(files)->content_.at(name).size();
        return true;
      };
    }
  }(access);
  parser.SetFsCallbacks(access);
}

}  // namespace lichtmc
