// A surface's tile map as an image of numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"

namespace lichtmc {

// An OpenEXR file of one tile map, as bytes. One pixel per cell, row 0 (the top scan line) at the smallest v, column 0
// at the smallest u. Channels, all 32-bit float: Y (irradiance), standard_error (NaN where unknown), area (m²);
// and direct, the part of Y that came straight from the emitters, where that was found apart. Cells without surface
// have 0 in all of them. Header attributes: unit, quantity, surface, material, side, uv_min, uv_max, tile_count,
// tile_edge_m, lichtmc_version, software, comments. Throws RuntimeError where OpenEXR or the memory refuses.
std::string tile_image(const Result& result, std::size_t map);

// Names as parts of file names, in UTF-8: what file systems dislike turned into '_', cut to 120 bytes; no two alike,
// whatever the case of their ASCII letters.
std::vector<std::string> file_stems(const std::vector<std::string>& names);

// File names for the tile maps of a result: the maps' names as file_stems() gives them, with ".exr".
std::vector<std::string> tile_image_names(const Tiling& tiling);

}  // namespace lichtmc
