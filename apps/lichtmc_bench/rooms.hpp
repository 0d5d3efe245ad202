// Rooms for benchmarks.
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

// The cube of the paper, with one reflectance.
Room paper_cube(double reflectance);

// A cube of 4 m with spheres as furniture, about this number of triangles; 12: empty; up to 1000: divided walls.
Room room_of_triangles(std::size_t triangles);

// A room with the data of a walk, for one thread.
class Stage {
 public:
  Stage(Room room, const Settings& settings, double tile_edge_m);

  // Simulates whole batches until at least this number of impacts; returns their number.
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
