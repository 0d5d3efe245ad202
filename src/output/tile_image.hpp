// Tile maps as OpenEXR images.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lichtmc/result.hpp"

namespace lichtmc {

// An OpenEXR file of one tile map, as bytes. One pixel per cell, row 0 (the top scan line) at the smallest v, column 0
// at the smallest u. Channels, all 32-bit float: Y (irradiance), standard_error (NaN if unknown), area (m²); and
// direct, the direct part of Y, if computed separately. Cells without surface have 0 in all channels. Header
// attributes: unit, quantity, surface, material, side, uv_min, uv_max, tile_count, tile_edge_m, lichtmc_version,
// software, comments. Throws RuntimeError if OpenEXR or the allocation of memory fails.
std::string tile_image(const Result& result, std::size_t map);

// Converts names to unique parts of file names, in UTF-8: characters that file systems may reject become '_', and the
// length is limited to 120 bytes. Unique also without regard to the case of ASCII letters.
std::vector<std::string> file_stems(const std::vector<std::string>& names);

// File names of the tile maps of a result: file_stems() of their names, with ".exr".
std::vector<std::string> tile_image_names(const Tiling& tiling);

}  // namespace lichtmc
