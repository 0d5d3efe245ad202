// glTF 2.0 in and out: a file becomes a Room, a Room becomes a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// The axis of a file that points up. glTF says Y; files that other programs have written so are lying on their side.
enum class UpAxis { y, z };

struct ReadOptions {
  std::optional<int> uv_set;         // n of TEXCOORD_n for the tiles; default: 1 where present, else 0
  std::optional<Quantity> quantity;  // what the file's powers are; default: what the file says, else photometric
  std::string scene;                 // name of the scene; default: the file's default scene, else its first
  double scale = 1.0;                // metres that a unit of the file is, > 0: 0.01 for centimetres
  UpAxis up = UpAxis::y;             // z: the file's Z becomes the room's Y, its Y the room's −Z
  std::vector<std::string> numbered_materials;  // whose reflectance will be set by set_reflectance(): textures that
                                                // they have need not be there
};

// Reads a room from a .gltf or .glb file.
//
// Surfaces: every triangle primitive of the scene and every instance of it, world transforms applied; a mirrored node
// (determinant < 0) has its winding turned back. Meshes may be quantized, or compressed by Draco or meshopt.
// Reflectance: material extras.reflectance, else the Rec. 709 luminance of the base colour factor times the base colour
// texture, point by point. Emitters: KHR_lights_punctual point and spot; node or light extras lambert_exponent, power,
// unit; emissive materials, whose power goes with the area in m². Receivers: nodes with extras.receiver. What the file
// holds beyond that is named in Room::ignored; scale and up axis, where not the file's own, in Room::mended.
//
// The room is what the file says; whether it can be simulated is for check_room() to say, and what looks wrong in it
// for inspect(). Throws InputError, naming the file and the node, mesh, material or accessor, where the file cannot be
// read, breaks the specification in a way that matters here, requires an unknown extension, lacks an image, or mixes W
// and lm; and where the scale is not a finite number above 0.
Room read_gltf(const std::filesystem::path& file, const ReadOptions& options = {});

// Writes a room as a .glb (binary) or .gltf (JSON with the buffer embedded) file, by the name's ending, such that
// read_gltf() gives the same room back: coordinates rounded to float, reflectance maps to grey pictures of 8 bits
// (whose coordinates then serve for tiles too, where a surface has none of its own). The file appears whole or not at
// all. Throws InputError for another ending, RuntimeError where the file cannot be written.
void write_gltf(const Room& room, const std::filesystem::path& file);

}  // namespace lichtmc
