// Loads a glTF file: container, JSON, buffers, images, decompression.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "gltf/document.hpp"

namespace lichtmc {

// Parses a .gltf or .glb file; the first bytes determine the format. Loads buffers and embedded images. Decompresses
// meshes (EXT_meshopt_compression, KHR_draco_mesh_compression). `follow_links`: as in ReadOptions.
// Throws InputError if the file cannot be read, is not a regular file of up to 2 GiB or not glTF 2.x, or requires an
// unknown extension; if its GLB container or compressed data is damaged; or if a buffer is missing, too short or not
// beneath the folder of the file.
Document load_document(const std::filesystem::path& file, bool follow_links);

// The same of the content of a file, up to 2 GiB. source: its name, for messages. Throws InputError also if it names a
// file of a buffer; texture_source.hpp and photometric_files.hpp refuse those of images and luminaires.
Document parse_document(std::string_view bytes, const std::string& source);

}  // namespace lichtmc
