// Charts from a file's UVs.
#pragma once

#include <string>
#include <vector>

#include "lichtmc/room.hpp"
#include "room/chart.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

// Why a surface's UVs cannot tell its points apart, as the end of a sentence that ends in "because": "it has no UVs",
// "its UVs wrap …", "its UVs are degenerate …", "its UVs overlap …". Empty where the UVs serve. Triangles without area
// are not looked at.
std::string uv_fault(const Surface& surface, const std::vector<TriangleShape>& shapes);

// The chart of a surface without a uv_fault(): the grid spans the bounds of its UVs, and a direction gets as many cells
// as the chart is long: its extent in u (v) times the area-weighted rms of |∂P/∂u| (|∂P/∂v|), which is exact where the
// chart is affine. edge_m: edge of a tile in metres, > 0.
Chart make_uv_chart(const Surface& surface, const std::vector<TriangleShape>& shapes, double edge_m);

}  // namespace lichtmc
