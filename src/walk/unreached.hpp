// Which sides of a room's faces light cannot reach: outer faces of thick walls, undersides of slabs.
//
// It is decided before and without the run, from the room alone, so that it does not depend on how many photons a run
// has. Photons are sent first; a patch of faces that one of them hits is reached. From the others walks are sent
// backward, by Lambert's law from random points of them, over further surfaces, and at each the emitters are sampled:
// an emitter that is seen proves that light can come back along the walk. Patches between which such walks fly are
// judged together: light reaches them if it comes to more than 10⁻⁴ of their walks. Less comes through cracks between
// meshes.
//
// If light arrives in a share q of the walks from a patch, the patch is taken for unreached with a probability of
// (1 − q)^n, with n ≥ 256 walks from it and many more from the patches that it is judged with: 2·10⁻⁶ for q = 5 %. A
// gap behind a cupboard has q of some 1 % at a depth of 200 times its width. Light that needs more than 8 flights does
// not count.
#pragma once

#include <cstdint>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "room/face_patches.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

class UnreachedSides {
 public:
  // Costs some 10 ms in rooms where light gets everywhere, at most some 10⁶ rays else; nothing in convex rooms. A
  // surface with one tile map for both sides counts as reached where either side is.
  UnreachedSides(const Room& room, const Tiling& tiling, const Scene& scene);

  bool none() const { return unreached_.empty(); }
  // Whether no light reaches this side of a triangle (of a surface with one tile map: neither side).
  bool holds(std::size_t surface, std::size_t triangle, Side side) const {
    return !none() && unreached_[patches_.side_of(surface, triangle, side == Side::back)];
  }

 private:
  FacePatches patches_;
  std::vector<bool> unreached_;  // by side of a patch; empty if light reaches all
};

}  // namespace lichtmc
