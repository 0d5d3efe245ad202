// Where pictures of a room are taken from.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "room/bounds.hpp"
#include "view/camera.hpp"
#include "view/eye.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

struct Viewpoint {
  Camera camera;
  std::optional<double> cut_y_m;  // what lies above is not drawn
  bool inside = false;
  double shown = 0.0;  // see Viewpoints
};

// A picture is the better the more of the lit area it shows. `shown` is the part in the picture of the integral of
// E / (E + mean E) over all surfaces: a bright square metre counts as 1, a dark one as 0, so that neither a lamp nor
// the outside of a building decides. Of a cuboid with a uniform irradiance, the oblique view shows the floor and two
// walls.
class Viewpoints {
 public:
  // All must outlive it.
  Viewpoints(const Room& room, const Result& result, const Scene& scene, const LitSides& lit);

  // For a picture of this size in pixels. The view of the whole room has priority; if it shows little, it is cut open
  // at a height; if that shows little too, the view corner is from inside.
  Viewpoint choose(View view, std::size_t width, std::size_t height) const;

 private:
  Viewpoint outside(View view, std::optional<double> cut_y_m, std::size_t width, std::size_t height) const;
  Viewpoint inside(std::size_t width, std::size_t height) const;
  std::vector<glm::dvec3> places_inside() const;
  struct Seen {
    double shown = 0.0;
    double tiles_m2 = 0.0;  // area of the tiles in the picture, dark ones too
  };
  Seen seen(const Camera& camera, std::size_t width, std::size_t height) const;
  void find_frame();
  std::vector<glm::dvec3> frame_points(std::optional<double> cut_y_m) const;

  const Room* room_;
  const Result* result_;
  const Scene* scene_;
  const LitSides* lit_;
  std::vector<double> weight_;  // of the tiles: E / (E + mean E)
  double all_m2_ = 0.0;         // the integral over all tiles
  Bounds frame_;                // of what the picture has to contain
  bool trimmed_ = false;        // dark surroundings are left out of the frame
};

}  // namespace lichtmc
