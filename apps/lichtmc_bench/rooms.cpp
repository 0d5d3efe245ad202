#include "rooms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "lichtmc/cuboid.hpp"

namespace lichtmc::bench {

namespace {

// Divides every triangle of a surface into four.
void divide(Surface& surface) {
  std::vector<glm::uvec3> parts;
  surface.uvs.clear();
  for (const glm::uvec3& t : surface.triangles) {
    const auto middle = [&surface](std::uint32_t a, std::uint32_t b) {
      surface.positions.push_back(0.5 * (surface.positions[a] + surface.positions[b]));
      return static_cast<std::uint32_t>(surface.positions.size() - 1);
    };
    const std::uint32_t ab = middle(t.x, t.y);
    const std::uint32_t bc = middle(t.y, t.z);
    const std::uint32_t ca = middle(t.z, t.x);
    parts.insert(parts.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
  }
  surface.triangles = std::move(parts);
}

// A sphere of 2·n·(n − 1) triangles, seen from outside.
Surface sphere(const std::string& name, const glm::dvec3& centre, double radius, std::uint32_t n) {
  Surface surface;
  surface.name = name;
  surface.reflectance = 0.6;
  for (std::uint32_t i = 0; i <= n; ++i) {
    const double polar = std::numbers::pi * i / n;
    for (std::uint32_t j = 0; j < n; ++j) {
      const double azimuth = 2.0 * std::numbers::pi * j / n;
      surface.positions.push_back(centre + radius * glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                                               -std::sin(polar) * std::sin(azimuth)));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t k = (j + 1) % n;
      if (i > 0) surface.triangles.emplace_back(i * n + j, (i + 1) * n + k, i * n + k);
      if (i + 1 < n) surface.triangles.emplace_back(i * n + j, (i + 1) * n + j, (i + 1) * n + k);
    }
  }
  return surface;
}

}  // namespace

Room paper_cube(double reflectance) {
  Room room = make_cuboid({1.0, 1.0, 1.0}, uniform_reflectance(reflectance));
  room.quantity = Quantity::radiometric;
  room.emitters.push_back({"paper", 1.0, LambertEmitter{{0.5, 0.5, 0.5}, {0.0, -1.0, 0.0}, 5.0}});
  return room;
}

Room room_of_triangles(std::size_t triangles) {
  Room room = make_cuboid({4.0, 4.0, 4.0}, uniform_reflectance(0.6));
  room.quantity = Quantity::radiometric;
  room.emitters.push_back({"lamp", 1.0, IsotropicEmitter{{2.0, 3.5, 2.0}}});
  std::size_t count = 12;
  if (triangles <= 1000) {
    for (; count * 4 <= triangles; count *= 4) {
      for (Surface& surface : room.surfaces) divide(surface);
    }
    return room;
  }
  constexpr int spheres = 8;
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / (2.0 * spheres))));
  for (int k = 0; k < spheres; ++k) {
    const int storey = k / 4;
    const int row = k / 2 % 2;
    const glm::dvec3 centre(0.8 + 2.4 * (k % 2), 0.8 + 1.6 * storey, 0.8 + 2.4 * row);
    room.surfaces.push_back(sphere("sphere " + std::to_string(k), centre, 0.5, n));
  }
  return room;
}

Stage::Stage(Room room, const Settings& settings, double tile_edge_m)
    : room_(std::move(room)), tiling_(make_tiling(room_, tile_edge_m)) {
  scene_ = std::make_unique<Scene>(room_, tiling_, settings.engine);
  walk_ = make_walk(*scene_, settings);
  tally_ =
      std::make_unique<Tally>(scene_->first_tile, score_law(settings.estimator, scene_->has_reflectance_maps()).hits);
}

double Stage::walk(double impacts) {
  const std::uint64_t before = tally_->counts().impacts;
  while (static_cast<double>(tally_->counts().impacts - before) < impacts) {
    walk_->simulate_batch(next_, batch_histories, *tally_, [] { return false; });
    next_ += batch_histories;
  }
  return static_cast<double>(tally_->counts().impacts - before);
}

}  // namespace lichtmc::bench
