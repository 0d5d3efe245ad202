// Draws rooms from outside: traces rays from the eye; sides of surfaces that receive no light are transparent.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/error.hpp"
#include "lichtmc/picture.hpp"
#include "run/stop_watch.hpp"
#include "view/camera.hpp"
#include "view/colours.hpp"
#include "view/lit_sides.hpp"
#include "walk/scene.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t samples = 3;      // rays per pixel, along each side
constexpr std::size_t band = 16;        // rows of pixels that a thread draws at a time
constexpr std::size_t wave = 1024;      // rays traced together
constexpr int max_layers = 256;         // transparent sides along a ray; after that it ends without a hit
constexpr double crease_cosine = 0.94;  // cos 20°: a larger angle between neighbouring normals is an edge
constexpr float line_opacity = 0.62F;

// The first visible impact of a ray from the eye.
struct VisibleHit {
  std::uint32_t facet = no_facet;
  std::uint32_t tile = no_tile;
  float depth = 0.0F;  // along the ray, in the tracer's coordinates
  glm::vec3 normal{0.0F};
};

// Whether two neighbouring rays have an edge between them: another surface, another normal, or a step in depth.
bool is_edge(const VisibleHit& a, const VisibleHit& b, const std::vector<Facet>& facets, float reach) {
  if (a.facet == b.facet) return false;
  if (a.facet == no_facet || b.facet == no_facet) return true;
  if (facets[a.facet].surface != facets[b.facet].surface) return true;
  if (std::abs(glm::dot(a.normal, b.normal)) < static_cast<float>(crease_cosine)) return true;
  return std::abs(a.depth - b.depth) > reach;
}

}  // namespace

struct RoomPainter::Impl {
  Impl(const Room& the_room, const Result& the_result, unsigned the_threads)
      : room(&the_room),
        result(&the_result),
        threads(the_threads > 0 ? the_threads : std::max(1U, std::thread::hardware_concurrency())),
        scene(the_room, the_result.tiling, Engine::embree),
        lit(find_lit_sides(the_room, scene)) {
    for (const std::vector<SideLight>& surface : lit) {
      for (const SideLight& side : surface) {
        opaque.push_back(side.front ? 1 : 0);
        opaque.push_back(side.back ? 1 : 0);
      }
    }
    for (std::size_t s = 0; s < room->surfaces.size(); ++s) {
      const Surface& surface = room->surfaces[s];
      for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
        if (!lit[s][n].front && !lit[s][n].back) continue;
        for (int k = 0; k < 3; ++k) box.add(surface.positions[surface.triangles[n][k]]);
      }
    }
  }

  // Traces rays to the first visible side.
  class Eye;

  Camera camera_for(View view, std::size_t width, std::size_t height) const;
  double visible_area(const Camera& camera, std::size_t width, std::size_t height) const;

  const Room* room;
  const Result* result;
  unsigned threads;
  Scene scene;
  LitSides lit;
  std::vector<std::uint8_t> opaque;  // 1: lit and therefore visible; index: 2 · facet + behind
  Bounds box;                        // of all lit triangles
};

class RoomPainter::Impl::Eye {
 public:
  explicit Eye(const Impl& impl)
      : impl_(&impl), rays_(wave), ray_(wave), travelled_(wave), tile_(wave), map_(wave), surface_(wave) {}

  // Traces n ≤ `wave` rays: hits[k] for ray_of(k).
  template <class RayOf>
  void trace(std::size_t n, const RayOf& ray_of, VisibleHit* hits) {
    const Tracer& tracer = *impl_->scene.tracer;
    for (std::size_t i = 0; i < n; ++i) {
      const Ray ray = ray_of(i);
      rays_.set_start(i, glm::vec3(tracer.tracer_point(ray.start)));
      rays_.set_direction(i, glm::vec3(tracer.directions() * ray.direction));
      rays_.facet[i] = no_facet;
      ray_[i] = i;
      travelled_[i] = 0.0F;
      hits[i] = VisibleHit{};
    }
    rays_.size = n;
    TraceCount count;
    for (int layer = 0; layer < max_layers && rays_.size > 0; ++layer) {
      tracer.trace(rays_, Misses::escape, count);
      keep_unfinished(hits);
      tracer.depart(rays_);
    }
  }

 private:
  // Stores the hits of rays on visible sides and removes these rays; the others continue behind the transparent side.
  void keep_unfinished(VisibleHit* hits) {
    const std::size_t n = rays_.size;
    hit_ = rays_.facet;
    for (std::size_t i = 0; i < whole_lanes(n); ++i) {
      if (i >= n || rays_.facet[i] == no_facet) rays_.facet[i] = 0;
    }
    impl_->scene.tile_of_each(rays_, tile_.data(), map_.data(), surface_.data());
    const std::vector<Facet>& facets = impl_->scene.tracer->facets();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (hit_[i] == no_facet) continue;
      travelled_[i] += rays_.length[i];
      const std::uint32_t behind = rays_.behind[i];
      if (impl_->opaque[2 * std::size_t{hit_[i]} + behind] != 0) {
        hits[ray_[i]] = {hit_[i], tile_[i], travelled_[i], facets[hit_[i]].normal};
        continue;
      }
      rays_.move_landing(i, kept);
      rays_.behind[kept] = 1 - behind;
      rays_.set_direction(kept, rays_.direction(i));
      ray_[kept] = ray_[i];
      travelled_[kept] = travelled_[i];
      ++kept;
    }
    rays_.size = kept;
  }

  const Impl* impl_;
  Rays rays_;
  std::vector<std::uint32_t> hit_;
  std::vector<std::size_t> ray_;  // number of the ray in each lane
  std::vector<float> travelled_;
  std::vector<std::uint32_t> tile_, map_, surface_;
};

// Area in m² of the tiles in a coarse picture.
double RoomPainter::Impl::visible_area(const Camera& camera, std::size_t width, std::size_t height) const {
  std::vector<bool> seen(result->tiling.tiles.size());
  double area = 0.0;
  Eye eye(*this);
  std::vector<VisibleHit> row(width);
  for (std::size_t y = 0; y < height; ++y) {
    eye.trace(
        width, [&](std::size_t x) { return camera.ray(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5); },
        row.data());
    for (const VisibleHit& hit : row) {
      if (hit.tile == no_tile || seen[hit.tile]) continue;
      seen[hit.tile] = true;
      area += result->tiling.tiles[hit.tile].area_m2;
    }
  }
  return area;
}

Camera RoomPainter::Impl::camera_for(View view, std::size_t width, std::size_t height) const {
  if (view == View::above) return Camera::from_above(box, width, height);
  // The one of eight directions that shows the largest lit area. Most walls are parallel to the axes: none of the
  // directions is parallel to such a wall.
  constexpr std::size_t coarse_width = 144;
  const std::size_t coarse_height = std::max<std::size_t>(1, coarse_width * height / width);
  double best_area = -1.0;
  double best_azimuth = 0.0;
  for (int k = 0; k < 8; ++k) {
    const double azimuth = (0.25 * k + (k % 2 == 0 ? 0.16 : 0.09)) * std::numbers::pi;
    const double area =
        visible_area(Camera::from_corner(box, azimuth, coarse_width, coarse_height), coarse_width, coarse_height);
    if (area <= 1.02 * best_area) continue;  // among nearly equal areas, the first
    best_area = area;
    best_azimuth = azimuth;
  }
  return Camera::from_corner(box, best_azimuth, width, height);
}

namespace {

// The hits of a band of a picture on a grid of samples, with one more row and column of pixels to detect edges.
class Band {
 public:
  Band(std::size_t width, std::size_t rows) : pixel_columns_(width + 1), pixel_rows_(rows + 1) {
    hits_.resize(columns() * pixel_rows_ * samples);
    line_.resize(hits_.size());
    middles_.resize(pixel_columns_ * pixel_rows_);
    wave_hits_.resize(wave);
  }
  std::size_t columns() const { return pixel_columns_ * samples; }

  // Traces one ray per pixel; if the hits of a pixel and its neighbours differ, all rays of the pixel.
  template <class Eye>
  void trace(Eye& eye, const Camera& camera, double first_row) {
    std::vector<std::size_t> all(middles_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (std::size_t first = 0; first < all.size(); first += wave) {
      eye.trace(
          std::min(wave, all.size() - first), [&](std::size_t i) { return middle_ray(camera, first + i, first_row); },
          &middles_[first]);
    }
    std::vector<std::size_t> fine;  // samples
    for (std::size_t pixel = 0; pixel < middles_.size(); ++pixel) {
      const bool even = is_even(pixel);
      for (std::size_t k = 0; k < samples * samples; ++k) {
        const std::size_t at = sample_of(pixel, k);
        hits_[at] = middles_[pixel];
        if (!even) fine.push_back(at);
      }
    }
    for (std::size_t first = 0; first < fine.size(); first += wave) {
      const std::size_t n = std::min(wave, fine.size() - first);
      eye.trace(
          n, [&](std::size_t i) { return sample_ray(camera, fine[first + i], first_row); }, wave_hits_.data());
      for (std::size_t i = 0; i < n; ++i) hits_[fine[first + i]] = wave_hits_[i];
    }
  }

  void find_lines(const std::vector<Facet>& facets, float reach) {
    std::fill(line_.begin(), line_.end(), std::uint8_t{0});
    const std::size_t width = columns();
    for (std::size_t y = 0; y + 1 < pixel_rows_ * samples; ++y) {
      for (std::size_t x = 0; x + 1 < width; ++x) {
        const std::size_t k = y * width + x;
        if (is_edge(hits_[k], hits_[k + 1], facets, reach)) line_[k] = line_[k + 1] = 1;
        if (is_edge(hits_[k], hits_[k + width], facets, reach)) line_[k] = line_[k + width] = 1;
      }
    }
  }

  // Sample k of a pixel of the band.
  std::size_t sample_at(std::size_t x, std::size_t y, std::size_t k) const {
    return (y * samples + k / samples) * columns() + x * samples + k % samples;
  }
  const VisibleHit& hit(std::size_t sample) const { return hits_[sample]; }
  bool on_line(std::size_t sample) const { return line_[sample] != 0; }

 private:
  std::size_t sample_of(std::size_t pixel, std::size_t k) const {
    return sample_at(pixel % pixel_columns_, pixel / pixel_columns_, k);
  }
  Ray middle_ray(const Camera& camera, std::size_t pixel, double first_row) const {
    const std::size_t row = pixel / pixel_columns_;
    return camera.ray(static_cast<double>(pixel % pixel_columns_) + 0.5, static_cast<double>(row) + 0.5 + first_row);
  }
  Ray sample_ray(const Camera& camera, std::size_t sample, double first_row) const {
    const std::size_t row = sample / columns();
    return camera.ray((static_cast<double>(sample % columns()) + 0.5) / samples,
                      (static_cast<double>(row) + 0.5) / samples + first_row);
  }
  // Whether a pixel and its eight neighbours show the same triangle and the same tile.
  bool is_even(std::size_t pixel) const {
    const std::size_t x = pixel % pixel_columns_;
    const std::size_t y = pixel / pixel_columns_;
    const VisibleHit& own = middles_[pixel];
    for (std::size_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, pixel_rows_ - 1); ++v) {
      for (std::size_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, pixel_columns_ - 1); ++u) {
        const VisibleHit& other = middles_[v * pixel_columns_ + u];
        if (other.facet != own.facet || other.tile != own.tile) return false;
      }
    }
    return true;
  }

  std::size_t pixel_columns_, pixel_rows_;
  std::vector<VisibleHit> middles_;  // of the ray through the middle of each pixel
  std::vector<VisibleHit> hits_;     // of each sample
  std::vector<VisibleHit> wave_hits_;
  std::vector<std::uint8_t> line_;
};

// The colour of a line over this colour: dark on bright colours, bright on dark colours.
glm::vec3 with_line(const glm::vec3& light) {
  const float luminance = glm::dot(light, glm::vec3(0.2126F, 0.7152F, 0.0722F));
  const glm::vec3 line(luminance < 0.06F ? 0.5F : 0.0F);
  return glm::mix(light, line, line_opacity);
}

void finish_rows(const Band& samples_of, const Result& result, const ColourScale& scale, std::size_t first_row,
                 std::size_t rows, Picture& picture) {
  constexpr float share = 1.0F / (samples * samples);
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < picture.width; ++x) {
      glm::vec4 sum(0.0F);
      double irradiance = 0.0;
      int seen = 0;
      for (std::size_t k = 0; k < samples * samples; ++k) {
        const std::size_t at = samples_of.sample_at(x, y, k);
        const VisibleHit& hit = samples_of.hit(at);
        if (hit.tile != no_tile) {
          const double own = result.tiles[hit.tile].irradiance;
          const glm::vec3 light = light_of(colour_of(scale, own));
          sum += glm::vec4(samples_of.on_line(at) ? with_line(light) : light, 1.0F);
          irradiance += own;
          ++seen;
        } else if (samples_of.on_line(at)) {
          sum += glm::vec4(0.0F, 0.0F, 0.0F, line_opacity);
        }
      }
      const std::size_t pixel = (first_row + y) * picture.width + x;
      picture.colour[pixel] = share * sum;
      if (seen > 0) picture.irradiance[pixel] = static_cast<float>(irradiance / seen);
    }
  }
}

void check_size(std::size_t pixels) {
  if (pixels < 16 || pixels > 16384)
    throw InputError("The side of a picture is " + std::to_string(pixels) +
                     " pixels (allowed: 16 to 16384). Choose another size.");
}

}  // namespace

RoomPainter::RoomPainter(const Room& room, const Result& result, unsigned threads) {
  if (result.tiles.empty())
    throw InputError("Cannot draw " + result.room +
                     ": its result has no tiles (allowed: results with tiles). Omit --only receivers.");
  impl_ = std::make_unique<Impl>(room, result, threads);
}

RoomPainter::~RoomPainter() = default;

glm::dmat4 view_onto(const Room& room, std::size_t width, std::size_t height) {
  constexpr double azimuth = 0.16 * std::numbers::pi;  // the first candidate of camera_for()
  return Camera::from_corner(bounds_of(room), azimuth, width, height).to_pixel();
}

const LitSides& RoomPainter::lit_sides() const {
  return impl_->lit;
}

Picture RoomPainter::draw(View view, const ColourScale& scale, std::size_t width, std::size_t height) const {
  check_size(width);
  check_size(height);
  const Impl& impl = *impl_;
  const Camera camera = impl.camera_for(view, width, height);
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.colour.resize(width * height);
  picture.irradiance.resize(width * height, std::numeric_limits<float>::quiet_NaN());
  picture.to_pixel = camera.to_pixel();
  const std::vector<Facet>& facets = impl.scene.tracer->facets();
  constexpr float reach = 0.02F;  // a step in depth by a hundredth of the room is an edge

  const std::size_t bands = (height + band - 1) / band;
  std::atomic<std::size_t> next{0};
  StopWatch watch(std::nullopt, {});
  watch.run_on_threads(impl.threads, [&](unsigned) {
    Impl::Eye eye(impl);
    Band own(width, band);
    for (std::size_t b = next++; b < bands && !watch.should_stop(); b = next++) {
      own.trace(eye, camera, static_cast<double>(b * band));
      own.find_lines(facets, reach);
      finish_rows(own, *impl.result, scale, b * band, std::min(band, height - b * band), picture);
    }
  });
  return picture;
}

}  // namespace lichtmc
