// Charts made by lichtmc, for surfaces whose UVs cannot be used.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "room/chart.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

// A chart of a surface: the surface is cut into patches that are nearly plane. Each patch is projected on its plane,
// rotated so that its bounding rectangle is smallest, cut again if that would be mostly empty, and gets whole cells of
// about `edge_m` metres (> 0); the rectangles are packed into one grid. No cell contains parts of two patches, except
// for one cell with all slivers thinner than the rounding of the coordinates. reason: Chart::reason.
Chart make_engine_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m,
                        std::string reason);

}  // namespace lichtmc
