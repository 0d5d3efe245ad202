// Layout of patches on cells: each is rotated to its smallest rectangle, and divided if that would be mostly empty.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "room/mesh_links.hpp"
#include "room/patches.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

// A patch, or a part of one, with its bounding rectangle.
struct LaidPatch {
  Patch patch;            // rotated so that its rectangle lies along the axes
  glm::dvec2 low{0.0};    // m, the rectangle
  glm::dvec2 high{0.0};   // m
  glm::dvec2 cells{1.0};  // columns and rows, integers
};

// Lays a patch of a surface out on cells of about `edge_m` metres. If rectangles around parts of it need clearly fewer
// cells (a frame, an L), it is divided between triangles. `noise_m` as in cut_into_patches().
std::vector<LaidPatch> lay_out(Patch patch, const std::vector<TriangleShape>& shapes, const MeshLinks& links,
                               double edge_m, double noise_m);

}  // namespace lichtmc
