// Reads rooms from glTF 2.0 files and writes them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// The vertical axis of a file. glTF specifies Y; some programs write files with Z up.
enum class UpAxis { y, z };

struct ReadOptions {
  std::optional<int> uv_set;         // n of TEXCOORD_n for the tiles; default: 1 if present, else 0
  std::optional<Quantity> quantity;  // of the file's powers; default: as stated in the file, else photometric
  std::string scene;                 // name of the scene; default: the file's default scene, else its first
  double scale = 1.0;                // length of the file's unit in m, > 0: 0.01 for centimetres
  UpAxis up = UpAxis::y;             // z: the file's Z becomes the room's Y, its Y the room's −Z
  // Names of materials or surfaces, as for set_reflectance(), whose reflectance that function will set: their textures
  // may be missing.
  std::vector<std::string> numbered;
  // What is left out: names or patterns ("*", "?", "[a-z]") of nodes, each with all nodes below it, of meshes,
  // materials or surfaces.
  std::vector<std::string> without;
  // Whether the buffers and images of the file may be symbolic links that lead out of its folder.
  bool follow_links = false;
};

// Reads a room from a .gltf or .glb file.
//
// Surfaces: every triangle primitive of the scene and every instance of it, in world coordinates; if a node mirrors
// (determinant < 0), its winding is reversed. Meshes may be quantized, or compressed by Draco or meshopt.
// Reflectance: material extras.reflectance, else the Rec. 709 luminance of the base colour factor times the base colour
// texture, point by point. Emitters: KHR_lights_punctual point and spot; EXT_lights_ies, and node or light extras ies:
// luminaires with photometric files (lichtmc/photometry.hpp); node or light extras lambert_exponent, power, unit;
// emissive materials (radiant or luminous flux = exitance · area in m²). Receivers: nodes with extras.receiver.
// Nodes that KHR_node_visibility hides are left out, with all below them.
//
// A surface has the name of its node, or of the mesh if the node has none ("node.material" if the mesh has several
// primitives). Where several nodes have one name, names of parents come before it, as few as tell them apart:
// "desk_1/top"; where parents do not, a number follows: "top_2".
//
// Room::ignored lists what the file contains beyond that; Room::overrides lists scale and up axis if they differ from
// the default, and what was left out.
//
// read_gltf() does not check whether the room can be simulated (check_room() does) or is plausible (inspect() does).
// Throws InputError, with the name of the file and of the node, mesh, material or accessor, if the file cannot be read,
// violates the specification in a way that matters here, requires an unknown extension, lacks an image, contains both W
// and lm, or names a file that is not beneath its own folder; if the scale is not a finite number above 0; and if a
// pattern of `without` fits nothing.
Room read_gltf(const std::filesystem::path& file, const ReadOptions& options = {});

// The same from the content of a .glb file, or of a .gltf file with all its data embedded. source: its name, for
// messages. Files that it names are refused; the option follow_links has no meaning. Limit: 2 GiB.
Room parse_gltf(std::string_view bytes, const std::string& source, const ReadOptions& options = {});

// Writes a room as a .glb (binary) or .gltf (JSON with embedded buffer) file; the extension of the name determines
// which; photometric files are embedded. The points of calculation areas are written as receivers, areas without a grid
// as areas. read_gltf() returns the same room, except that coordinates are rounded to float and reflectance maps to
// grey images of 8 bits (their coordinates are then also used for the tiles of a surface without coordinates of its
// own). The file is replaced atomically. Throws InputError for another extension, RuntimeError if the file cannot be
// written.
void write_gltf(const Room& room, const std::filesystem::path& file);

}  // namespace lichtmc
