// The plan of a calculation area.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lichtmc/area_drawing.hpp"
#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The plan of Result::areas[area], a complete SVG in which text is text: its figures; the cells in false colour with
// their values as numbers; isolux lines with theirs; the outline of the area and, for level areas, the section of the
// room at their height; dimensions, scale bar and an arrow. It is made for a width of 17 cm on paper.
std::string area_plan_svg(const Room& room, const Result& result, std::size_t area, const ColourScale& scale);
// The same for a drawing made by draw_area().
std::string area_plan_svg(const Result& result, std::size_t area, const AreaDrawing& drawing, const ColourScale& scale);

}  // namespace lichtmc
