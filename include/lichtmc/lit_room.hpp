// A room with its irradiance as false colour, as a glTF file for any viewer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lichtmc/paths.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// A binary glTF 2.0 file: every triangle of the room where it is, its tiles as a picture of one pixel each on its
// surface (KHR_materials_unlit: shown as they are, without lamps). Triangles are wound so that the side that gets light
// is the front, and drawn from there alone: viewers that leave out the backs of faces look into the room through the
// nearer walls. What gets light on neither side is all but transparent. Maps of more than 4096 cells a side are drawn
// coarser.
//
// Numbers are kept under "lichtmc" in extras: materials have there surface, side, unit, columns, rows, mean, lowest and
// highest irradiance, and the numbers of two buffer views, `irradiance` and `standard_error`, with a 32-bit float for
// each cell, row by row from the smallest v (NaN: no tile there, or no error known). The scene's tell the colour scale.
// Emitters are nodes of kind "emitter"; photon paths, if given, a node of kind "paths", with lines from violet (first
// flight) to yellow (tenth and later).
std::string lit_room_glb(const Room& room, const Result& result, const LitSides& lit, const ColourScale& scale,
                         const std::vector<PhotonPath>& paths = {});

// Paths alone: the node of lit_room_glb(), as a .glb file.
std::string paths_glb(const std::vector<PhotonPath>& paths);

// Colour of a flight, counted from 1, in pictures of paths.
Colour colour_of_flight(std::size_t flight);

}  // namespace lichtmc
