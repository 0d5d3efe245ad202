// Patches laid on cells: each turned to its smallest rectangle, and taken apart where that would be mostly empty.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "room/mesh_links.hpp"
#include "room/patches.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

// A patch, or a part of one, with the rectangle about it.
struct LaidPatch {
  Patch patch;            // turned so that its rectangle lies along the axes
  glm::dvec2 low{0.0};    // m, the rectangle
  glm::dvec2 high{0.0};   // m
  glm::dvec2 cells{1.0};  // columns and rows, whole numbers
};

// Lays a patch of a surface on cells of about `edge_m`. Where rectangles about parts of it take clearly fewer cells (a
// frame, an L), it comes apart between triangles. `noise_m` as in cut_into_patches().
std::vector<LaidPatch> lay_out(Patch patch, const std::vector<TriangleShape>& shapes, const MeshLinks& links,
                               double edge_m, double noise_m);

}  // namespace lichtmc
