#include "view/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

constexpr double corner_elevation = 40.0 * std::numbers::pi / 180.0;  // above the horizon: shows floor and walls alike
constexpr double inside_elevation = 12.0 * std::numbers::pi / 180.0;  // of the line of sight: floors matter most
constexpr double half_field_inside = 45.0 * std::numbers::pi / 180.0;
constexpr double half_field = 14.0 * std::numbers::pi / 180.0;  // of view, along the longer side: little distortion
constexpr double margin = 0.02;                                 // of the picture, on each side

}  // namespace

void Camera::look(double azimuth, double elevation) {
  forward_ = -glm::dvec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                         std::cos(azimuth) * std::cos(elevation));
  right_ = {std::cos(azimuth), 0.0, -std::sin(azimuth)};
  down_ = glm::cross(forward_, right_);
}

Camera Camera::from_corner(const std::vector<glm::dvec3>& points, double azimuth, std::size_t width,
                           std::size_t height) {
  Camera camera;
  camera.look(azimuth, corner_elevation);
  const auto w = static_cast<double>(width);
  const auto h = static_cast<double>(height);
  camera.scale_ = 0.5 * std::max(w, h) / std::tan(half_field);
  camera.middle_x_ = 0.5 * w;
  camera.middle_y_ = 0.5 * h;

  // Moves the eye backwards until all points are in view, and sideways and upwards until the picture is centred. Each
  // step halves the remaining error, because the distance is large compared with the box.
  Bounds box;
  for (const glm::dvec3& point : points) box.add(point);
  const glm::dvec3 centre = 0.5 * (box.low + box.high);
  const double size = std::max(glm::length(box.high - box.low), std::numeric_limits<double>::min());
  double distance = size / std::tan(half_field);
  glm::dvec2 shift(0.0);
  for (int k = 0; k < 30; ++k) {
    camera.eye_ = centre - distance * camera.forward_ + shift.x * camera.right_ + shift.y * camera.down_;
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (const glm::dvec3& corner : points) {
      const glm::dvec4 at = camera.to_pixel() * glm::dvec4(corner, 1.0);
      const glm::dvec2 place((at.x / at.w - 0.5 * w) / w, (at.y / at.w - 0.5 * h) / h);
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
    const glm::dvec2 middle = 0.5 * (low + high);
    shift += middle * glm::dvec2(w, h) * distance / camera.scale_;
    const glm::dvec2 half = 0.5 * (high - low);
    distance *= std::max(half.x, half.y) / (0.5 - margin);
  }
  return camera;
}

Camera Camera::from_above(const Bounds& box, std::size_t width, std::size_t height) {
  Camera camera;
  camera.perspective_ = false;
  const glm::dvec3 size = box.high - box.low;
  const auto w = static_cast<double>(width);
  const auto h = static_cast<double>(height);
  camera.scale_ = (1.0 - 2.0 * margin) * std::min(w / size.x, h / size.z);
  camera.middle_x_ = 0.5 * w;
  camera.middle_y_ = 0.5 * h;
  camera.eye_ = 0.5 * (box.low + box.high);
  camera.eye_.y = box.high.y + 0.1 * std::max({size.x, size.y, size.z});
  return camera;
}

Camera Camera::from_inside(const glm::dvec3& eye, double azimuth, std::size_t width, std::size_t height) {
  Camera camera;
  camera.look(azimuth, inside_elevation);
  camera.eye_ = eye;
  camera.scale_ = 0.5 * static_cast<double>(std::max(width, height)) / std::tan(half_field_inside);
  camera.middle_x_ = 0.5 * static_cast<double>(width);
  camera.middle_y_ = 0.5 * static_cast<double>(height);
  return camera;
}

Ray Camera::ray(double x, double y) const {
  const glm::dvec3 aside = (x - middle_x_) / scale_ * right_ + (y - middle_y_) / scale_ * down_;
  Ray ray{eye_, forward_};
  if (perspective_)
    ray.direction = glm::normalize(forward_ + aside);
  else
    ray.start += aside;
  if (cut_y_ && ray.start.y > *cut_y_ && ray.direction.y < 0.0)
    ray.start += (ray.start.y - *cut_y_) / -ray.direction.y * ray.direction;
  return ray;
}

double Camera::pixel_area(double x, double y, double distance_m) const {
  if (!perspective_) return 1.0 / (scale_ * scale_);
  // Solid angle: on the plane at a distance of 1 m a pixel has the area 1/scale², at the distance s from the eye and
  // inclined by the cosine 1/s.
  const glm::dvec3 aside = (x - middle_x_) / scale_ * right_ + (y - middle_y_) / scale_ * down_;
  const double s = glm::length(forward_ + aside);
  const double distance = distance_m + glm::length(ray(x, y).start - eye_);
  return distance * distance / (scale_ * scale_ * s * s * s);
}

glm::dmat4 Camera::to_pixel() const {
  // Rows of the matrix: x, y, depth and w of a place; GLM keeps columns.
  const auto row = [this](const glm::dvec3& axis, double factor) {
    return glm::dvec4(factor * axis, -factor * glm::dot(axis, eye_));
  };
  const glm::dvec4 depth = row(forward_, 1.0);
  const glm::dvec4 w = perspective_ ? depth : glm::dvec4(0.0, 0.0, 0.0, 1.0);
  const glm::dvec4 x = row(right_, scale_) + middle_x_ * w;
  const glm::dvec4 y = row(down_, scale_) + middle_y_ * w;
  return glm::transpose(glm::dmat4(x, y, depth, w));
}

}  // namespace lichtmc
