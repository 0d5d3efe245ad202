// The triangles of a room in Embree's tree, and what leaving them requires: the part of a tracer that depends on the
// surfaces alone. Tracers share it.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include "lichtmc/room.hpp"
#include "room/faces_in_one_plane.hpp"
#include "tracer/departure.hpp"
#include "tracer/embree.hpp"
#include "tracer/room_triangles.hpp"
#include "tracer/tracer.hpp"
#include "tracer/triangle_start.hpp"

namespace lichtmc {

class EmbreeTree {
 public:
  // Built on up to `threads` (≥ 1) threads; the same for any number of them. planes: of the room. Throws RuntimeError
  // if Embree fails.
  EmbreeTree(const Room& room, Edges edges, unsigned threads, const FacesInOnePlane& planes);
  EmbreeTree(const EmbreeTree&) = delete;
  EmbreeTree& operator=(const EmbreeTree&) = delete;

  RTCScene scene() const { return scene_.get(); }
  const Placement& placement() const { return placement_; }
  // Of the triangles, in the order of RoomTriangles.
  const std::vector<Departure>& departures() const { return departures_; }
  const FacetGroups& groups() const { return groups_; }
  // The number of each surface's first triangle.
  const std::vector<std::size_t>& first_facet() const { return first_facet_; }

 private:
  using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)>;
  using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, decltype(&rtcReleaseScene)>;

  void load(RoomTriangles triangles);
  void step_off_all_planes(const FacesInOnePlane& planes);

  Placement placement_;
  Device device_;
  Scene scene_{nullptr, &rtcReleaseScene};
  std::vector<std::size_t> first_facet_;
  std::vector<Departure> departures_;
  FacetGroups groups_;
};

}  // namespace lichtmc
