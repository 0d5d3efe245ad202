// A glTF file as tinygltf parses it, after the checks that tinygltf leaves to its callers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace lichtmc {

struct Document {
  std::string file;  // as the user gave it, for messages
  tinygltf::Model model;
  std::vector<std::vector<unsigned char>>
      images;                         // the files of Model::images, not decoded; empty where one is missing
  std::vector<std::string> warnings;  // what the parser had to say, a line each
};

// Parses a .gltf or .glb file; which it is its first bytes say. Buffers and images are loaded, meshes that
// EXT_meshopt_compression or KHR_draco_mesh_compression has compressed are plain ones afterwards.
// Throws InputError where the file cannot be opened or is no glTF 2.x, where its GLB container is broken, a buffer is
// missing, compressed data is damaged, or an extension is required that is not known here.
Document load_document(const std::filesystem::path& file);

// Whether everything that an extension says is read, or makes no difference for light.
bool is_known_extension(const std::string& name);

// "node 'lamp'", or "node 3" where it has no name.
std::string label(const char* kind, const std::string& name, std::size_t index);

// Throws InputError: "FILE: what. What to do."
[[noreturn]] void refuse(const Document& document, const std::string& what_and_remedy);

// Checks that a reference of the file names one of `count` things; throws InputError otherwise.
std::size_t checked_index(const Document& document, long long index, std::size_t count, const std::string& what);

// A number in extras or an extension, or `otherwise` where there is none of that name. Throws InputError where it is
// not a number; `where` names what it belongs to.
double number_in(const Document& document, const tinygltf::Value& object, const char* name, double otherwise,
                 const std::string& where);

}  // namespace lichtmc
