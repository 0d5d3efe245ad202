// Patches: a surface cut into pieces that are nearly plane.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "lichtmc/room.hpp"
#include "room/overlap.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

// Triangles connected by edges, with normals less than 50° from that of the largest, projected on its plane, where they
// do not overlap.
struct Patch {
  std::vector<std::uint32_t> triangles;  // indices into Surface::triangles, the largest first
  std::vector<FlatTriangle> flat;        // m, corners in the plane; first axis as close to a world axis as possible
};

struct Patches {
  std::vector<Patch> patches;
  std::vector<std::uint32_t> slivers;  // triangles in no patch that are too thin to have a normal
};

// Cuts a surface into patches: each grows from the largest triangle that is in none yet, over the edges, as far as
// possible. `noise_m` (≥ 0): triangles thinner than this have no reliable normal and join any neighbour; overlaps no
// deeper than this do not count.
Patches cut_into_patches(const Surface& surface, const std::vector<TriangleShape>& shapes, double noise_m);

}  // namespace lichtmc
