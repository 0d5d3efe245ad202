#include "view/viewpoint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

constexpr std::size_t coarse_width = 144;  // pixels of the pictures that are compared
constexpr double same = 1.02;              // among nearly equal views, the first
constexpr double nearly = 0.7;             // views from other directions that show this part of the most are as good
// A view that is cut open must show this much more than one of the whole room: it leaves out what is above. Where a
// roof hides a room or a vault its floor, it shows 1.1 to 7 times as much; in ordinary rooms at most 1.05 times.
constexpr double cut_gain = 1.1;
constexpr std::array<double, 4> cuts{0.8, 0.6, 0.4, 0.25};  // heights, as parts of the room's height
// A view of the whole room that shows this much is taken even if one from inside shows more: it shows where things are.
// Ordinary rooms show 0.4 to 0.6 from outside.
constexpr double good = 0.35;
constexpr double inside_gain = 1.3;
// Dark surroundings: the outermost parts with this share of the lit area on each side …
constexpr double rim_share = 0.005;
// … are left out of the frame if that makes it this much smaller.
constexpr double much_smaller = 0.6;

// The eight directions of oblique views. Most walls are parallel to the axes: none of the directions is.
double azimuth_of(int k) {
  return (0.25 * k + (k % 2 == 0 ? 0.16 : 0.09)) * std::numbers::pi;
}

std::size_t coarse_height(std::size_t width, std::size_t height) {
  return std::max<std::size_t>(1, coarse_width * height / width);
}

// Directions at most 20° apart, so that the outermost points in them miss at most 1 − cos 10° = 1.5 % of a sphere, less
// than the margin of a picture; and those to the corners of a cube, in which the corners of a box are outermost.
std::vector<glm::dvec3> directions() {
  constexpr int n = 128;
  std::vector<glm::dvec3> all;
  for (int k = 0; k < 8; ++k) all.emplace_back((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
  for (int k = 0; k < n; ++k) {
    const double y = 1.0 - (2.0 * k + 1.0) / n;
    const double azimuth = k * std::numbers::pi * (3.0 - std::sqrt(5.0));  // a Fibonacci lattice
    const double r = std::sqrt(1.0 - y * y);
    all.emplace_back(r * std::cos(azimuth), y, r * std::sin(azimuth));
  }
  return all;
}

}  // namespace

Viewpoints::Viewpoints(const Room& room, const Result& result, const Scene& scene, const LitSides& lit)
    : room_(&room), result_(&result), scene_(&scene), lit_(&lit) {
  double power = 0.0;
  double area = 0.0;
  for (std::size_t t = 0; t < result.tiles.size(); ++t) {
    if (!(result.tiles[t].irradiance > 0.0)) continue;
    power += result.tiles[t].irradiance * result.tiling.tiles[t].area_m2;
    area += result.tiling.tiles[t].area_m2;
  }
  const double mean = area > 0.0 ? power / area : 1.0;
  for (std::size_t t = 0; t < result.tiling.tiles.size(); ++t) {
    const double irradiance = result.tiles.empty() ? 0.0 : std::max(0.0, result.tiles[t].irradiance);
    weight_.push_back(area > 0.0 ? irradiance / (irradiance + mean) : 1.0);  // none is known: all counts alike
    all_m2_ += weight_.back() * result.tiling.tiles[t].area_m2;
  }
  find_frame();
}

// The box of all lit triangles, without dark surroundings such as the ground about a building.
void Viewpoints::find_frame() {
  for (std::size_t s = 0; s < room_->surfaces.size(); ++s) {
    const Surface& surface = room_->surfaces[s];
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      if (!(*lit_)[s][n].front && !(*lit_)[s][n].back) continue;
      for (int k = 0; k < 3; ++k) frame_.add(surface.positions[surface.triangles[n][k]]);
    }
  }
  Bounds bright;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::pair<double, double>> places;  // along the axis, with the lit area there
    for (std::size_t t = 0; t < weight_.size(); ++t)
      places.emplace_back(result_->tiling.tiles[t].point[axis], weight_[t] * result_->tiling.tiles[t].area_m2);
    std::sort(places.begin(), places.end());
    const double outside = rim_share * all_m2_;
    double area = 0.0;
    for (const auto& [place, own] : places) {
      area += own;
      if (area > outside && bright.low[axis] > place) bright.low[axis] = place;
      if (area < all_m2_ - outside || bright.high[axis] < bright.low[axis]) bright.high[axis] = place;
    }
  }
  const glm::dvec3 size = frame_.high - frame_.low;
  for (int axis = 0; axis < 3; ++axis) {
    const double part = bright.high[axis] - bright.low[axis];
    if (!(part < much_smaller * size[axis])) continue;
    trimmed_ = true;
    const double rim = 0.1 * part;
    frame_.low[axis] = std::max(frame_.low[axis], bright.low[axis] - rim);
    frame_.high[axis] = std::min(frame_.high[axis], bright.high[axis] + rim);
  }
}

// Points whose pictures enclose that of the frame's content.
std::vector<glm::dvec3> Viewpoints::frame_points(std::optional<double> cut_y_m) const {
  std::vector<glm::dvec3> points;
  if (trimmed_ || cut_y_m) {
    for (int k = 0; k < 8; ++k) {
      points.emplace_back((k & 1) != 0 ? frame_.high.x : frame_.low.x,
                          (k & 2) != 0 ? cut_y_m.value_or(frame_.high.y) : frame_.low.y,
                          (k & 4) != 0 ? frame_.high.z : frame_.low.z);
    }
    return points;
  }
  const std::vector<glm::dvec3> all = directions();
  std::vector<double> reach(all.size(), -std::numeric_limits<double>::infinity());
  points.resize(all.size());
  const glm::dvec3 middle = 0.5 * (frame_.low + frame_.high);
  std::vector<bool> used;
  for (std::size_t s = 0; s < room_->surfaces.size(); ++s) {
    const Surface& surface = room_->surfaces[s];
    used.assign(surface.positions.size(), false);
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      if (!(*lit_)[s][n].front && !(*lit_)[s][n].back) continue;
      for (int k = 0; k < 3; ++k) used[surface.triangles[n][k]] = true;
    }
    for (std::size_t k = 0; k < used.size(); ++k) {
      if (!used[k]) continue;
      for (std::size_t d = 0; d < all.size(); ++d) {
        const double own = glm::dot(all[d], surface.positions[k] - middle);
        if (own <= reach[d]) continue;
        reach[d] = own;
        points[d] = surface.positions[k];
      }
    }
  }
  return points;
}

Viewpoints::Seen Viewpoints::seen(const Camera& camera, std::size_t width, std::size_t height) const {
  constexpr double least_cosine = 0.02;  // a pixel of a grazing surface stands for at most 50 times its own area
  const Tracer& tracer = *scene_->tracer;
  Eye eye(*scene_, *lit_);
  std::vector<VisibleHit> row(width);
  std::vector<bool> counted(weight_.size());
  Seen seen;
  for (std::size_t y = 0; y < height; ++y) {
    const auto middle = [y](std::size_t x) { return glm::dvec2(static_cast<double>(x), static_cast<double>(y)) + 0.5; };
    eye.trace(
        width, [&](std::size_t x) { return camera.ray(middle(x).x, middle(x).y); }, row.data());
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint32_t tile = row[x].tile;
      if (tile == no_tile || tile == unmeasured) continue;
      const glm::dvec3 direction = tracer.directions() * camera.ray(middle(x).x, middle(x).y).direction;
      const double distance = row[x].depth * glm::length(tracer.world_vector(direction));
      const double cosine = std::abs(glm::dot(glm::dvec3(row[x].normal), direction));
      seen.shown +=
          weight_[tile] * camera.pixel_area(middle(x).x, middle(x).y, distance) / std::max(cosine, least_cosine);
      if (!counted[tile]) seen.tiles_m2 += result_->tiling.tiles[tile].area_m2;
      counted[tile] = true;
    }
  }
  seen.shown = all_m2_ > 0.0 ? seen.shown / all_m2_ : 0.0;
  return seen;
}

Viewpoint Viewpoints::outside(View view, std::optional<double> cut_y_m, std::size_t width, std::size_t height) const {
  const std::vector<glm::dvec3> points = view == View::corner ? frame_points(cut_y_m) : std::vector<glm::dvec3>{};
  const auto camera = [&](double azimuth, std::size_t w, std::size_t h) {
    Camera one = view == View::above ? Camera::from_above(frame_, w, h) : Camera::from_corner(points, azimuth, w, h);
    one.cut_above(cut_y_m);
    return one;
  };
  const std::size_t rows = coarse_height(width, height);
  // Of the directions that show nearly as much as the best one, the one with the largest area in the picture.
  std::vector<std::pair<double, Seen>> found;
  for (int k = 0; k < (view == View::above ? 1 : 8); ++k)
    found.emplace_back(azimuth_of(k), seen(camera(azimuth_of(k), coarse_width, rows), coarse_width, rows));
  const auto less = [](const auto& a, const auto& b) { return a.second.shown < b.second.shown; };
  const double most = std::max_element(found.begin(), found.end(), less)->second.shown;
  Viewpoint best;
  double best_azimuth = 0.0;
  double best_area = -1.0;
  for (const auto& [azimuth, own] : found) {
    if (own.shown < nearly * most || own.tiles_m2 <= same * best_area) continue;
    best_area = own.tiles_m2;
    best_azimuth = azimuth;
    best.shown = own.shown;
  }
  best.camera = camera(best_azimuth, width, height);
  best.cut_y_m = cut_y_m;
  return best;
}

// Points in the space that light crosses: in front of lit tiles, near them and in the middle of the space there.
std::vector<glm::dvec3> Viewpoints::places_inside() const {
  constexpr std::size_t places = 24;
  std::vector<Ray> rays;
  double area = 0.0;
  for (std::size_t t = 0; t < weight_.size() && rays.size() < places; ++t) {
    area += weight_[t] * result_->tiling.tiles[t].area_m2;
    if (area * places < (static_cast<double>(rays.size()) + 0.5) * all_m2_) continue;
    const Tile& tile = result_->tiling.tiles[t];
    const glm::dvec3 out = 0.5 * (frame_.low + frame_.high) - tile.point;
    // A step of a thousandth off the surface, not to hit it at once; it is too small to see.
    if (glm::length(out) > 0.0) rays.push_back({tile.point + 1e-3 * out, glm::normalize(out)});
  }
  const Tracer& tracer = *scene_->tracer;
  Eye eye(*scene_, *lit_);
  std::vector<VisibleHit> hits(rays.size());
  eye.trace(
      rays.size(), [&](std::size_t k) { return rays[k]; }, hits.data());
  std::vector<glm::dvec3> found;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (hits[k].facet == no_facet) continue;
    const glm::dvec3 free =
        static_cast<double>(hits[k].depth) * tracer.world_vector(tracer.directions() * rays[k].direction);
    for (const double part : {0.1, 0.5}) found.push_back(rays[k].start + part * free);
  }
  return found;
}

Viewpoint Viewpoints::inside(std::size_t width, std::size_t height) const {
  const std::size_t rows = std::max<std::size_t>(1, coarse_height(width, height) / 2);
  Viewpoint best;
  best.inside = true;
  for (const glm::dvec3& place : places_inside()) {
    for (int k = 0; k < 8; ++k) {
      const double own =
          seen(Camera::from_inside(place, azimuth_of(k), coarse_width / 2, rows), coarse_width / 2, rows).shown;
      if (own <= same * best.shown) continue;
      best.shown = own;
      best.camera = Camera::from_inside(place, azimuth_of(k), width, height);
    }
  }
  return best;
}

Viewpoint Viewpoints::choose(View view, std::size_t width, std::size_t height) const {
  Viewpoint best = outside(view, std::nullopt, width, height);
  double enough = cut_gain * best.shown;
  for (const double part : cuts) {
    Viewpoint open = outside(view, frame_.low.y + part * (frame_.high.y - frame_.low.y), width, height);
    if (open.shown <= enough) continue;
    enough = same * open.shown;
    best = std::move(open);
  }
  if (view == View::above || (!best.cut_y_m && best.shown >= good)) return best;
  Viewpoint within = inside(width, height);
  if (within.shown > (best.cut_y_m ? same : inside_gain) * best.shown) return within;
  return best;
}

}  // namespace lichtmc
