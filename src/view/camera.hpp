// Camera of a picture.
#pragma once

#include <cstddef>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "room/bounds.hpp"

namespace lichtmc {

struct Ray {
  glm::dvec3 start{0.0};      // m
  glm::dvec3 direction{0.0};  // length 1
};

// A camera with the whole of a box in its field of view.
class Camera {
 public:
  // Oblique from above, in perspective. `azimuth` (rad) about the vertical: 0 views along −z, π/2 along −x.
  static Camera from_corner(const Bounds& box, double azimuth, std::size_t width, std::size_t height);
  // Plan view, parallel projection: +x to the right, +z downwards.
  static Camera from_above(const Bounds& box, std::size_t width, std::size_t height);

  // The ray through a point of the picture, in pixels from the top left.
  Ray ray(double x, double y) const;

  // Point (m, 1) → (x, y, ·, w): pixel x/w, y/w.
  glm::dmat4 to_pixel() const;

 private:
  glm::dvec3 eye_{0.0};
  glm::dvec3 right_{1.0, 0.0, 0.0};  // length 1, as the next two
  glm::dvec3 down_{0.0, 0.0, 1.0};
  glm::dvec3 forward_{0.0, -1.0, 0.0};
  bool perspective_ = true;
  double scale_ = 1.0;  // pixels per m: at a distance of 1 m in perspective, at any distance in parallel projection
  double middle_x_ = 0.0;
  double middle_y_ = 0.0;
};

}  // namespace lichtmc
