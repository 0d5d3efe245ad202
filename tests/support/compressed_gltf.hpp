// The same room as a plain .glb file and with its meshes compressed.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc::test {

// A .glb file taken apart.
struct Glb {
  nlohmann::json json;
  std::string buffer;
};

Glb read_glb(const std::filesystem::path& file);
void write_glb(const Glb& glb, const std::filesystem::path& file);

// What write_gltf() makes of a room.
Glb glb_of(const Room& room);

// Every buffer view of vertices or indices compressed by EXT_meshopt_compression; the plain data is gone.
Glb with_meshopt(const Glb& plain);

// Every primitive compressed by KHR_draco_mesh_compression, positions to `bits` bits; the plain data is gone.
Glb with_draco(const Glb& plain, int bits);

}  // namespace lichtmc::test
