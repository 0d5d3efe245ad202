// Convexity of rooms: in a convex room no surface lies between two points.
#pragma once

#include "room/welded_mesh.hpp"

namespace lichtmc {

// Whether a mesh is one closed shell around a convex body: every edge belongs to two triangles, and no corner lies in
// front of any triangle's plane, seen from outside, by more than a millionth of the room's size. Meshes for which the
// test would take more than some seconds (over 10⁹ pairs of triangle and corner) count as not convex: the answer "no"
// is the safe one.
bool is_convex(const WeldedMesh& mesh);

}  // namespace lichtmc
