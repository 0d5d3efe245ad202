// Rooms to measure in.
#pragma once

#include <cstddef>
#include <memory>

#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/tiles.hpp"
#include "walk/choose_policy.hpp"
#include "walk/scene.hpp"
#include "walk/tally.hpp"
#include "walk/walk.hpp"

namespace lichtmc::bench {

// The paper's cube, one reflectance.
Room paper_cube(double reflectance);

// A cube of 4 m with furniture of spheres in it, about so many triangles; 12: nothing in it; up to 1000: walls divided.
Room room_of_triangles(std::size_t triangles);

// A room with all that a walk in it needs, for one thread.
class Stage {
 public:
  Stage(Room room, const Settings& settings, double tile_edge_m);

  // Simulates whole batches until at least so many impacts are done; returns how many were.
  double walk(double impacts);
  const Scene& scene() const { return *scene_; }
  std::size_t tiles() const { return tiling_.tiles.size(); }
  const Room& room() const { return room_; }

 private:
  Room room_;
  Tiling tiling_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<Walk> walk_;
  std::unique_ptr<Tally> tally_;
  std::uint64_t next_ = 0;
};

}  // namespace lichtmc::bench
