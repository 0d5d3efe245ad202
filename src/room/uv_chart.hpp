// Charts from a file's UVs.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "room/chart.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

// Why a surface's UVs do not distinguish its points, or would need far more cells than its area does, as the part of a
// sentence after "because": "it has no UVs", "its UVs wrap …", "its UVs are degenerate …", "the scale of its UVs is
// uneven …", "its UVs fill little of their rectangle …", "its UVs overlap …". Empty if the UVs can be used. Triangles
// without area are ignored.
std::string uv_fault(const Surface& surface, const std::vector<TriangleShape>& shapes);

// The chart of a surface without a uv_fault(): the grid spans the bounds of its UVs, and the number of cells along a
// direction follows from the length of the chart: its extent in u (v) times the area-weighted rms of |∂P/∂u| (|∂P/∂v|),
// which is exact if the chart is affine. edge_m: edge of a tile in metres, > 0.
Chart make_uv_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m);

}  // namespace lichtmc
