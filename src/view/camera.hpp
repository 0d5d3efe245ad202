// Camera of a picture.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "room/bounds.hpp"

namespace lichtmc {

struct Ray {
  glm::dvec3 start{0.0};      // m
  glm::dvec3 direction{0.0};  // length 1
};

class Camera {
 public:
  // Oblique from above, in perspective, with all the points (m, at least one) in its field of view. `azimuth` (rad)
  // about the vertical: 0 views along −z, π/2 along −x.
  static Camera from_corner(const std::vector<glm::dvec3>& points, double azimuth, std::size_t width,
                            std::size_t height);
  // Plan view of a box, parallel projection: +x to the right, +z downwards.
  static Camera from_above(const Bounds& box, std::size_t width, std::size_t height);
  // From a point (m) in a room, slightly downwards, with a field of view of 90° along the longer side.
  static Camera from_inside(const glm::dvec3& eye, double azimuth, std::size_t width, std::size_t height);

  // Rays from higher up start at this height (m).
  void cut_above(std::optional<double> y) { cut_y_ = y; }

  // The ray through a point of the picture, in pixels from the top left.
  Ray ray(double x, double y) const;

  // The area in m² that a pixel covers on a surface perpendicular to its ray: in perspective, at this distance from
  // where its ray starts.
  double pixel_area(double x, double y, double distance_m) const;

  // Point (m, 1) → (x, y, ·, w): pixel x/w, y/w.
  glm::dmat4 to_pixel() const;

 private:
  void look(double azimuth, double elevation);

  glm::dvec3 eye_{0.0};
  glm::dvec3 right_{1.0, 0.0, 0.0};  // length 1, as the next two
  glm::dvec3 down_{0.0, 0.0, 1.0};
  glm::dvec3 forward_{0.0, -1.0, 0.0};
  bool perspective_ = true;
  std::optional<double> cut_y_;
  double scale_ = 1.0;  // pixels per m: at a distance of 1 m in perspective, at any distance in parallel projection
  double middle_x_ = 0.0;
  double middle_y_ = 0.0;
};

}  // namespace lichtmc
