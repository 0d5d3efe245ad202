// Patches: connected faces in one plane. Their areas decide which of two faces in one place lies on the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "room/box_tree.hpp"
#include "room/room_faces.hpp"

namespace lichtmc {

// The place of a face in the order of covering, from the top downwards.
struct PatchOrder {
  std::uint32_t area = 0;   // by the area of the patch, the smallest first; equal areas have equal numbers
  std::uint32_t patch = 0;  // of equal ones the first in the room
  // Within one patch, which may overlap itself: by the area of the part that belongs to the face's surface.
  std::uint32_t surface = 0;
};

// The order of the given faces. A patch consists of faces in one plane and of the same orientation (if their surfaces
// are one-sided) that share an edge, or a part of one longer than the tolerance. Faces of one surface are joined
// wherever two of their corners are the same. Faces of different surfaces are joined only where exactly one face ends
// on either side of the edge, or where exactly one on either side has the same two corners there: a rug whose edge lies
// on a joint of the floor is not a part of the floor.
//
// Areas that differ by no more than the tolerance times the circumference of a square are equal.
std::unordered_map<std::uint32_t, PatchOrder> patch_orders(const RoomFaces& faces, const BoxTree& tree,
                                                           const std::vector<std::uint32_t>& of);

}  // namespace lichtmc
