// The parts of a prepared room, each computed when it is first needed.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/prepared_room.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "room/enclosure.hpp"
#include "room/faces_in_one_plane.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

class EmbreeTree;

// What the mesh of all triangles tells.
struct MeshFacts {
  std::size_t duplicates = 0;             // triangles with the same corners as another
  std::size_t open_edges = 0;             // edges of only one triangle
  std::vector<glm::dvec3> open_edges_at;  // m, midpoints of the first few
  bool convex = false;                    // see is_convex()
};

class PreparedRoom {
 public:
  // As prepare(); threads ≥ 1.
  PreparedRoom(const Room& room, unsigned threads, std::function<void(std::string_view)> progress)
      : room_(&room), threads_(threads), progress_(std::move(progress)) {}
  PreparedRoom(const PreparedRoom&) = delete;
  PreparedRoom& operator=(const PreparedRoom&) = delete;

  const Room& room() const { return *room_; }
  unsigned threads() const { return threads_; }
  void announce(std::string_view step) const {
    if (progress_) progress_(step);
  }

  const std::shared_ptr<const FacesInOnePlane>& planes();
  const MeshFacts& mesh();
  const Enclosure& enclosure();
  // The room's triangles in Embree's tree. Throws RuntimeError if Embree fails.
  const std::shared_ptr<const EmbreeTree>& tree(Edges edges);
  // The tiles with this edge, see make_tiling(): those that were kept, which are then gone, or made now.
  Tiling take_tiling(double edge_m);
  void keep_tiling(double edge_m, Tiling tiling);

 private:
  void weld();

  const Room* room_;
  unsigned threads_;
  std::function<void(std::string_view)> progress_;
  std::once_flag planes_once_;
  std::shared_ptr<const FacesInOnePlane> planes_;
  std::once_flag mesh_once_;
  MeshFacts mesh_;
  std::optional<Enclosure> enclosure_;
  std::array<std::mutex, 2> tree_mutex_;
  std::array<std::shared_ptr<const EmbreeTree>, 2> trees_;  // by Edges
  std::mutex tiling_mutex_;
  std::optional<std::pair<double, Tiling>> tiling_;
};

// The prepared room that a caller has given, after a check that it is that of this room; if it is null, a new one.
// Throws InputError if it belongs to another room.
std::shared_ptr<PreparedRoom> prepared_or_new(std::shared_ptr<PreparedRoom> given, const Room& room, unsigned threads,
                                              std::function<void(std::string_view)> progress = {});

}  // namespace lichtmc
