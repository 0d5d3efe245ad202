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

#include "base/parallel.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/picture.hpp"
#include "run/stop_watch.hpp"
#include "tracer/prepared_room.hpp"
#include "view/camera.hpp"
#include "view/colours.hpp"
#include "view/eye.hpp"
#include "view/lit_sides.hpp"
#include "view/viewpoint.hpp"
#include "walk/scene.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t samples = 3;      // rays per pixel, along each side
constexpr std::size_t band = 16;        // rows of pixels that a thread draws at a time
constexpr double crease_cosine = 0.94;  // cos 20°: a larger angle between neighbouring normals is an edge
constexpr float line_opacity = 0.62F;
const glm::vec3 unmeasured_light(0.62F);  // a grey that no scale has

// The grey of a surface in a room without results of tiles: level surfaces are brightest, so that floor, walls and
// furniture differ. `up`: the vertical in the coordinates of the normal.
glm::vec3 light_without_tiles(const glm::vec3& normal, const glm::vec3& up) {
  const glm::vec3 across(up.y, up.z, up.x);  // any direction at a right angle to it
  return glm::vec3(0.5F + 0.3F * std::abs(glm::dot(normal, up)) + 0.1F * std::abs(glm::dot(normal, across)));
}

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
  Impl(const Room& the_room, const Result& the_result, unsigned the_threads, std::shared_ptr<PreparedRoom> prepared)
      : room(&the_room),
        result(&the_result),
        threads(the_threads > 0 ? the_threads : usable_processors()),
        scene(the_room, the_result.tiling, Engine::embree, prepared_or_new(std::move(prepared), the_room, the_threads)),
        lit(find_lit_sides(the_room, scene)),
        viewpoints(the_room, the_result, scene, lit) {}

  const Room* room;
  const Result* result;
  unsigned threads;
  Scene scene;
  LitSides lit;
  Viewpoints viewpoints;
};

namespace {

// The hits of a band of a picture on a grid of samples, with one more row and column of pixels to detect edges.
class Band {
 public:
  Band(std::size_t width, std::size_t rows) : pixel_columns_(width + 1), pixel_rows_(rows + 1) {
    hits_.resize(columns() * pixel_rows_ * samples);
    line_.resize(hits_.size());
    middles_.resize(pixel_columns_ * pixel_rows_);
    wave_hits_.resize(Eye::max_rays);
  }
  std::size_t columns() const { return pixel_columns_ * samples; }

  // Traces one ray per pixel; if the hits of a pixel and its neighbours differ, all rays of the pixel.
  void trace(Eye& eye, const Camera& camera, double first_row) {
    std::vector<std::size_t> all(middles_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (std::size_t first = 0; first < all.size(); first += Eye::max_rays) {
      eye.trace(
          std::min(Eye::max_rays, all.size() - first),
          [&](std::size_t i) { return middle_ray(camera, first + i, first_row); }, &middles_[first]);
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
    for (std::size_t first = 0; first < fine.size(); first += Eye::max_rays) {
      const std::size_t n = std::min(Eye::max_rays, fine.size() - first);
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

void finish_rows(const Band& samples_of, const Result& result, const ColourScale& scale, const glm::vec3& up,
                 std::size_t first_row, std::size_t rows, Picture& picture) {
  constexpr float share = 1.0F / (samples * samples);
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < picture.width; ++x) {
      glm::vec4 sum(0.0F);
      double irradiance = 0.0;
      int seen = 0;
      for (std::size_t k = 0; k < samples * samples; ++k) {
        const std::size_t at = samples_of.sample_at(x, y, k);
        const VisibleHit& hit = samples_of.hit(at);
        if (hit.tile != no_tile && result.tiles.empty()) {
          const glm::vec3 light = light_without_tiles(hit.normal, up);
          sum += glm::vec4(samples_of.on_line(at) ? with_line(light) : light, 1.0F);
        } else if (hit.tile == unmeasured) {
          sum += glm::vec4(samples_of.on_line(at) ? with_line(unmeasured_light) : unmeasured_light, 1.0F);
        } else if (hit.tile != no_tile) {
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

RoomPainter::RoomPainter(const Room& room, const Result& result, unsigned threads,
                         std::shared_ptr<PreparedRoom> prepared) {
  if (result.tiling.tiles.empty())
    throw InputError("Cannot draw " + result.room + ": its result has no tiling (allowed: results of simulate()).");
  impl_ = std::make_unique<Impl>(room, result, threads, std::move(prepared));
}

RoomPainter::~RoomPainter() = default;

glm::dmat4 view_onto(const Room& room, std::size_t width, std::size_t height) {
  constexpr double azimuth = 0.16 * std::numbers::pi;
  const Bounds box = bounds_of(room);
  std::vector<glm::dvec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.emplace_back((k & 1) != 0 ? box.high.x : box.low.x, (k & 2) != 0 ? box.high.y : box.low.y,
                         (k & 4) != 0 ? box.high.z : box.low.z);
  return Camera::from_corner(corners, azimuth, width, height).to_pixel();
}

const LitSides& RoomPainter::lit_sides() const {
  return impl_->lit;
}

Picture RoomPainter::draw(View view, const ColourScale& scale, std::size_t width, std::size_t height) const {
  check_size(width);
  check_size(height);
  const Impl& impl = *impl_;
  const Viewpoint viewpoint = impl.viewpoints.choose(view, width, height);
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.colour.resize(width * height);
  picture.irradiance.resize(width * height, std::numeric_limits<float>::quiet_NaN());
  picture.to_pixel = viewpoint.camera.to_pixel();
  picture.from_inside = viewpoint.inside;
  picture.cut_y_m = viewpoint.cut_y_m;
  const std::vector<Facet>& facets = impl.scene.tracer->facets();
  const glm::vec3 up(glm::normalize(impl.scene.tracer->directions() * glm::dvec3(0.0, 1.0, 0.0)));
  constexpr float reach = 0.02F;  // a step in depth by a hundredth of the room is an edge

  const std::size_t bands = (height + band - 1) / band;
  std::atomic<std::size_t> next{0};
  StopWatch watch(std::nullopt, {});
  watch.run_on_threads(impl.threads, [&](unsigned) {
    Eye eye(impl.scene, impl.lit);
    Band own(width, band);
    for (std::size_t b = next++; b < bands && !watch.should_stop(); b = next++) {
      own.trace(eye, viewpoint.camera, static_cast<double>(b * band));
      own.find_lines(facets, reach);
      finish_rows(own, *impl.result, scale, up, b * band, std::min(band, height - b * band), picture);
    }
  });
  return picture;
}

}  // namespace lichtmc
