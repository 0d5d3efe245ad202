// glTF 2.0 in and out: a file becomes a Room, a Room becomes a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lichtmc/room.hpp"

namespace lichtmc {

struct ReadOptions {
  std::optional<int> uv_set;         // n of TEXCOORD_n for the tiles; default: 1 where present, else 0
  std::optional<Quantity> quantity;  // what the file's powers are; default: what the file says, else photometric
  std::string scene;                 // name of the scene; default: the file's default scene, else its first
};

// Reads a room from a .gltf or .glb file.
//
// Surfaces: every triangle primitive of the scene, world transforms applied; a mirrored node (determinant < 0) has its
// winding turned back. Reflectance: material extras.reflectance, else the Rec. 709 luminance of the base colour factor.
// Emitters: KHR_lights_punctual point and spot; node or light extras lambert_exponent, power, unit; emissive materials.
// Receivers: nodes with extras.receiver. What the file holds beyond that is named in Room::ignored.
//
// The room is what the file says; whether it can be simulated is for check_room() to say. Throws InputError, naming the
// file and the node, mesh, material or accessor, where the file cannot be read, breaks the specification in a way that
// matters here, requires an unknown extension, or mixes W and lm.
Room read_gltf(const std::filesystem::path& file, const ReadOptions& options = {});

// Writes a room as a .glb (binary) or .gltf (JSON with the buffer embedded) file, by the name's ending, such that
// read_gltf() gives the same room back (coordinates rounded to float). The file appears whole or not at all.
// Throws InputError for another ending, RuntimeError where the file cannot be written.
void write_gltf(const Room& room, const std::filesystem::path& file);

}  // namespace lichtmc
