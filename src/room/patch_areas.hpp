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
  std::uint32_t patch = 0;    // by the area of the patch, the smallest first; equal areas have equal numbers
  std::uint32_t surface = 0;  // for equal ones: the same for the part of the patch that belongs to the face's surface

  bool operator==(const PatchOrder& other) const = default;
  auto operator<=>(const PatchOrder& other) const = default;
};

// The order of the given faces. A patch consists of faces in one plane and of the same orientation (if their surfaces
// are one-sided) that share an edge, or a part of one longer than the tolerance. Faces of one surface are joined
// wherever two of their corners are the same. Faces of different surfaces are joined only where exactly one face ends
// on either side of the edge: a rug whose edge lies on a joint of the floor is not a part of the floor.
//
// Areas that differ by no more than the tolerance times the circumference of a square are equal.
std::unordered_map<std::uint32_t, PatchOrder> patch_orders(const RoomFaces& faces, const BoxTree& tree,
                                                           const std::vector<std::uint32_t>& of);

}  // namespace lichtmc
