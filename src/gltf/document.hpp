// A glTF file parsed by tinygltf, with the checks that tinygltf does not make.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>

#include <glm/vec3.hpp>
#include "lichtmc/room.hpp"

namespace lichtmc {

// An extension of glTF that a file uses.
struct ExtensionUse {
  std::string name;
  bool required = false;
  std::size_t places = 0;   // number of objects that have it
  std::string first_place;  // "material 'glass'"; empty: it is only listed
};

struct Document {
  std::string file;  // the path as the user gave it, or the name of the bytes, for messages
  // That contains it; buffers and images are beneath it. None: of bytes in memory, which may name no files.
  std::optional<std::filesystem::path> folder;
  bool follow_links = false;  // whether they may be symbolic links that lead out of it
  std::vector<ExtensionUse> extensions;
  std::vector<Ignored> property_notes;  // of check_custom_properties()
  tinygltf::Model model;
  std::vector<std::vector<unsigned char>>
      images;                           // Model::images in buffers or data URIs, not decoded; empty for those in files
  std::vector<std::string> image_uris;  // of those in files; empty for the others
  std::vector<std::string> warnings;    // of the parser, one line each
};

// "node 'lamp'"; "node 3" without a name.
std::string label(const char* kind, const std::string& name, std::size_t index);

// Throws InputError with the message "FILE: what is wrong. What to do."
[[noreturn]] void refuse(const Document& document, const std::string& what_and_remedy);

// Ends of such messages.
inline constexpr const char* export_again = " Export the file again.";
inline constexpr const char* export_uncompressed = " Export the file again, or without compression.";

// Returns an index of the file if it is below `count`; throws InputError otherwise.
std::size_t checked_index(const Document& document, long long index, std::size_t count, const std::string& what);

// The bytes of a buffer view. Throws InputError if it does not exist or reaches beyond its buffer. `what`: the view,
// for messages.
std::string_view bytes_of_view(const Document& document, long long view, const std::string& what);

// A number in extras or an extension; `otherwise` if there is no entry of that name. Throws InputError if the entry is
// not a number. `where`: what it belongs to, for messages.
double number_in(const Document& document, const tinygltf::Value& object, const char* name, double otherwise,
                 const std::string& where);

// A colour in extras or an extension: the first three of its numbers; `otherwise` if there is no entry of that name.
// Throws InputError if they are not finite numbers, 0 or more.
glm::dvec3 colour_in(const Document& document, const tinygltf::Value& object, const char* name,
                     const glm::dvec3& otherwise, const std::string& where);

}  // namespace lichtmc
