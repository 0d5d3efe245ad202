// Writes a room with its irradiance in false colour as a glTF file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lichtmc/paths.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// A binary glTF 2.0 file with every triangle of the room. The tile map of a surface is its texture, one pixel per tile
// (KHR_materials_unlit: viewers show the colours without lighting). The winding makes the lit side the front face, and
// only front faces are drawn: with back-face culling, the nearer walls do not hide the room. Triangles without light on
// either side are nearly transparent. Textures are limited to 4096 pixels per side: larger tile maps are averaged.
//
// The extras contain the numbers under "lichtmc". Materials: surface, side, unit, columns, rows, mean, lowest and
// highest irradiance, and the indices of two buffer views, `irradiance` and `standard_error`, with a 32-bit float per
// cell, row by row from the smallest v (NaN: no tile, or error unknown). Scene: the colour scale. Emitters are nodes of
// kind "emitter". Photon paths, if given, are a node of kind "paths", with lines from violet (first flight) to yellow
// (tenth and later).
std::string lit_room_glb(const Room& room, const Result& result, const LitSides& lit, const ColourScale& scale,
                         const std::vector<PhotonPath>& paths = {});

// Only the photon paths (the node of lit_room_glb()), as a .glb file.
std::string paths_glb(const std::vector<PhotonPath>& paths);

// Colour of a flight (counted from 1) in pictures of photon paths.
Colour colour_of_flight(std::size_t flight);

}  // namespace lichtmc
