// A glTF file parsed by tinygltf, with the checks that tinygltf does not make.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace lichtmc {

struct Document {
  std::string file;  // the path as the user gave it, for messages
  tinygltf::Model model;
  std::vector<std::vector<unsigned char>>
      images;                         // the files of Model::images, not decoded; empty if a file is missing
  std::vector<std::string> warnings;  // of the parser, one line each
};

// Parses a .gltf or .glb file; the first bytes determine the format. Loads buffers and images. Decompresses meshes
// (EXT_meshopt_compression, KHR_draco_mesh_compression).
// Throws InputError if the file cannot be opened, is not glTF 2.x or requires an unknown extension, if its GLB
// container or compressed data is damaged, or if a buffer is missing.
Document load_document(const std::filesystem::path& file);

// Whether an extension is read completely, or has no influence on the simulation.
bool is_known_extension(const std::string& name);

// "node 'lamp'"; "node 3" without a name.
std::string label(const char* kind, const std::string& name, std::size_t index);

// Throws InputError with the message "FILE: what is wrong. What to do."
[[noreturn]] void refuse(const Document& document, const std::string& what_and_remedy);

// Returns an index of the file if it is below `count`; throws InputError otherwise.
std::size_t checked_index(const Document& document, long long index, std::size_t count, const std::string& what);

// A number in extras or an extension; `otherwise` if there is no entry of that name. Throws InputError if the entry is
// not a number. `where`: what it belongs to, for messages.
double number_in(const Document& document, const tinygltf::Value& object, const char* name, double otherwise,
                 const std::string& where);

}  // namespace lichtmc
