// The plan of a calculation area as a drawing for CAD programs.
#pragma once

#include <cstddef>
#include <string>

#include "lichtmc/area_drawing.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

// The plan of Result::areas[area], which `drawing` shows, as an ASCII DXF file of AutoCAD Release 12, which every CAD
// program reads; in metres. Level areas lie at (x, −z) of the room, which are x and y in Blender and in most plans;
// others at (right, height) on their sheet. Layers: ROOM (the section of the room), AREA (outline), NUMBERS (a text at
// each point), ISOLUX_300 for each level, TITLE (name and figures below the area).
std::string area_dxf(const Result& result, std::size_t area, const AreaDrawing& drawing);

}  // namespace lichtmc
