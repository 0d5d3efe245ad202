// The same room as a plain .glb file and with its meshes compressed.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc::test {

// The parts of a .glb file.
struct Glb {
  nlohmann::json json;
  std::string buffer;
};

Glb read_glb(const std::filesystem::path& file);
void write_glb(const Glb& glb, const std::filesystem::path& file);

// The output of write_gltf() for a room.
Glb glb_of(const Room& room);

// Every buffer view of vertices or indices compressed by EXT_meshopt_compression; the plain data is removed.
Glb with_meshopt(const Glb& plain);

// Every primitive compressed by KHR_draco_mesh_compression, positions to `bits` bits; the plain data is removed.
Glb with_draco(const Glb& plain, int bits);

}  // namespace lichtmc::test
