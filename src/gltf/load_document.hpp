// Loads a glTF file: container, JSON, buffers, images, decompression.
#pragma once

#include <filesystem>
#include <string>

#include "gltf/document.hpp"

namespace lichtmc {

// Parses a .gltf or .glb file; the first bytes determine the format. Loads buffers and images. Decompresses meshes
// (EXT_meshopt_compression, KHR_draco_mesh_compression).
// Throws InputError if the file cannot be opened, is not glTF 2.x or requires an unknown extension, if its GLB
// container or compressed data is damaged, or if a buffer is missing.
Document load_document(const std::filesystem::path& file);

// Whether an extension is read completely, or has no influence on the simulation.
bool is_known_extension(const std::string& name);

}  // namespace lichtmc
