// Charts made by lichtmc, for surfaces whose UVs cannot be used.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "room/chart.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

// A chart of a surface: it is cut into patches that are nearly flat; each is projected on its plane, turned so that the
// rectangle about it is smallest, cut again where that would be mostly empty, given whole cells of about `edge_m`
// metres (> 0), and the rectangles are packed into one grid. No cell holds parts of two patches, except for one that gathers
// slivers thinner than the rounding of the coordinates. reason: Chart::reason.
Chart make_engine_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m,
                        std::string reason);

}  // namespace lichtmc
