#include "lichtmc/receivers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "room/bounds.hpp"
#include "room/enclosure.hpp"
#include "room/room_check.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

namespace {

constexpr double most_points = 1e7;

void check_grid(double height_m, double spacing_m, const glm::dvec3& size) {
  if (!std::isfinite(height_m)) {
    throw InputError(
        "The height of the grid is " + to_text(height_m) +
        " m (allowed: a finite number). Give --grid the height above the floor in metres, for example 0.85.");
  }
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m)) {
    throw InputError("The spacing of the grid is " + to_text(spacing_m) +
                     " m (allowed: a finite number above 0). Give --grid-spacing a length in metres, for example 0.5.");
  }
  const double points = (size.x / spacing_m + 1.0) * (size.z / spacing_m + 1.0);
  if (points > most_points) {
    throw InputError("A spacing of " + to_text(spacing_m) + " m makes a grid of " + short_number(points) +
                     " points (allowed: up to 1e7). Give --grid-spacing a greater length.");
  }
}

// The number of points on a length, and the position of the first: the margins at both ends are equal.
std::size_t points_along(double length_m, double spacing_m) {
  return static_cast<std::size_t>(std::max(1.0, std::floor(length_m / spacing_m + 1e-9)));
}

// Whether a surface is vertically below each point.
std::vector<bool> above_surfaces(const Room& room, const std::vector<Receiver>& points) {
  const auto tracer = make_embree_tracer(room, make_tiling(room, std::numeric_limits<double>::max()));
  Rays rays(points.size());
  rays.size = points.size();
  for (std::size_t k = 0; k < points.size(); ++k) {
    rays.facet[k] = no_facet;
    rays.set_start(k, glm::vec3(tracer->tracer_point(points[k].position)));
    rays.set_direction(k, glm::vec3(tracer->directions() * glm::dvec3(0.0, -1.0, 0.0)));
  }
  TraceCount count;
  tracer->trace(rays, Misses::escape, count);
  std::vector<bool> over(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) over[k] = rays.facet[k] != no_facet;
  return over;
}

}  // namespace

std::vector<Receiver> receiver_grid(const Room& room, double height_m, double spacing_m) {
  check_surfaces(room);
  const Bounds bounds = bounds_of(room);
  const glm::dvec3 size = bounds.high - bounds.low;
  check_grid(height_m, spacing_m, size);
  const std::size_t columns = points_along(size.x, spacing_m);
  const std::size_t rows = points_along(size.z, spacing_m);
  const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
  std::vector<Receiver> points;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double x = middle.x + (static_cast<double>(column) - 0.5 * static_cast<double>(columns - 1)) * spacing_m;
      const double z = middle.z + (static_cast<double>(row) - 0.5 * static_cast<double>(rows - 1)) * spacing_m;
      points.push_back({"grid_" + std::to_string(column) + "_" + std::to_string(row),
                        {x, bounds.low.y + height_m, z},
                        {0.0, 1.0, 0.0},
                        90.0,
                        1.0});
    }
  }
  const std::vector<bool> over = above_surfaces(room, points);
  // A closed shell that contains all points is the room; one that contains some of them is furniture.
  const Enclosure enclosure(room);
  std::vector<std::size_t> shells(points.size(), 0);
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!over[k]) continue;
    shells[k] = enclosure.shells_about(points[k].position);
    fewest = std::min(fewest, shells[k]);
  }
  std::vector<Receiver> kept;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (over[k] && shells[k] == fewest) kept.push_back(points[k]);
  }
  if (kept.empty()) {
    throw InputError("No point of the grid " + to_text(height_m) + " m above the floor of " + room.source +
                     " lies over a surface. Give --grid another height, or --grid-spacing a smaller length.");
  }
  return kept;
}

}  // namespace lichtmc
