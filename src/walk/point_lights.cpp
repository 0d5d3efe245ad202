#include "walk/point_lights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chance/moments.hpp"

namespace lichtmc {

namespace {

struct Places {
  const float* LICHTMC_APART x;
  const float* LICHTMC_APART y;
  const float* LICHTMC_APART z;
  const std::uint32_t* LICHTMC_APART facet;
  const std::uint32_t* LICHTMC_APART behind;
};

// From the surface point to the emitter: t in the tracer's coordinates, w in the world, M the transformation. The
// normal of the surface is not of length 1 in the tracer's coordinates of a cuboid, so M n is divided by its length.
LICHTMC_LANES void illuminate(std::size_t n, const Places& places, const Facet* LICHTMC_APART facets,
                              const PointLights::Source* LICHTMC_APART sources,
                              const std::uint32_t* LICHTMC_APART source, const glm::dmat3& to_world, double short_of,
                              double* LICHTMC_APART irradiance, float* LICHTMC_APART dx, float* LICHTMC_APART dy,
                              float* LICHTMC_APART dz, std::uint32_t* LICHTMC_APART within_reach) {
  const double xx = to_world[0].x, xy = to_world[0].y, xz = to_world[0].z;
  const double yx = to_world[1].x, yy = to_world[1].y, yz = to_world[1].z;
  const double zx = to_world[2].x, zy = to_world[2].y, zz = to_world[2].z;
  const float* LICHTMC_APART x = places.x;
  const float* LICHTMC_APART y = places.y;
  const float* LICHTMC_APART z = places.z;
  const std::uint32_t* LICHTMC_APART facet = places.facet;
  const std::uint32_t* LICHTMC_APART behind = places.behind;
  for (std::size_t i = 0; i < n; ++i) {
    const PointLights::Source& from = sources[source[i]];
    const double tx = from.x - double{x[i]};
    const double ty = from.y - double{y[i]};
    const double tz = from.z - double{z[i]};
    const double wx = xx * tx + yx * ty + zx * tz;
    const double wy = xy * tx + yy * ty + zy * tz;
    const double wz = xz * tx + yz * ty + zz * tz;
    const Facet& on = facets[facet[i]];
    const double sx = on.normal.x;
    const double sy = on.normal.y;
    const double sz = on.normal.z;
    const double nx = xx * sx + yx * sy + zx * sz;
    const double ny = xy * sx + yy * sy + zy * sz;
    const double nz = xz * sx + yz * sy + zz * sz;
    const double squared = wx * wx + wy * wy + wz * wz;
    const double along_front = (wx * nx + wy * ny + wz * nz) / std::sqrt(nx * nx + ny * ny + nz * nz);
    const double along = behind[i] != 0 ? -along_front : along_front;  // r cos θ
    const double value = from.factor * along / (squared * std::sqrt(squared));
    irradiance[i] = along > 0.0 ? value : 0.0;
    const double length = std::sqrt(tx * tx + ty * ty + tz * tz);
    const double share = 1.0 - short_of / length;
    dx[i] = static_cast<float>(tx * share);
    dy[i] = static_cast<float>(ty * share);
    dz[i] = static_cast<float>(tz * share);
    within_reach[i] = length > short_of ? 0U : 1U;
  }
}

LICHTMC_LANES void look_back(std::size_t n, const Places& places, const PointLights::Source* LICHTMC_APART sources,
                             const std::uint32_t* LICHTMC_APART source, const glm::dmat3& to_world,
                             double* LICHTMC_APART away_x, double* LICHTMC_APART away_y, double* LICHTMC_APART away_z) {
  const double xx = to_world[0].x, xy = to_world[0].y, xz = to_world[0].z;
  const double yx = to_world[1].x, yy = to_world[1].y, yz = to_world[1].z;
  const double zx = to_world[2].x, zy = to_world[2].y, zz = to_world[2].z;
  const float* LICHTMC_APART x = places.x;
  const float* LICHTMC_APART y = places.y;
  const float* LICHTMC_APART z = places.z;
  for (std::size_t i = 0; i < n; ++i) {
    const PointLights::Source& from = sources[source[i]];
    const double tx = double{x[i]} - from.x;
    const double ty = double{y[i]} - from.y;
    const double tz = double{z[i]} - from.z;
    const double wx = xx * tx + yx * ty + zx * tz;
    const double wy = xy * tx + yy * ty + zy * tz;
    const double wz = xz * tx + yz * ty + zz * tz;
    const double r = std::sqrt(wx * wx + wy * wy + wz * wz);
    away_x[i] = wx / r;
    away_y[i] = wy / r;
    away_z[i] = wz / r;
  }
}

// Directions in the frames of their sources.
LICHTMC_LANES void turn_into_frames(std::size_t n, const glm::dmat3* LICHTMC_APART to_frames,
                                    const std::uint32_t* LICHTMC_APART source, double* LICHTMC_APART x,
                                    double* LICHTMC_APART y, double* LICHTMC_APART z) {
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dmat3& m = to_frames[source[i]];
    const double wx = x[i];
    const double wy = y[i];
    const double wz = z[i];
    x[i] = m[0].x * wx + m[1].x * wy + m[2].x * wz;
    y[i] = m[0].y * wx + m[1].y * wy + m[2].y * wz;
    z[i] = m[0].z * wx + m[1].z * wy + m[2].z * wz;
  }
}

LICHTMC_LANES void multiply_lanes(std::size_t n, const double* LICHTMC_APART by, double factor,
                                  double* LICHTMC_APART numbers) {
  for (std::size_t i = 0; i < n; ++i) numbers[i] *= factor * by[i];
}

}  // namespace

PointLights::PointLights(std::vector<const PointLight*> lights, const Tracer& tracer)
    : tracer_(&tracer), lights_(std::move(lights)) {
  for (const PointLight*& light : lights_) {
    if (light == nullptr) {
      sources_.emplace_back();
      continue;
    }
    const glm::dvec3 position = tracer.tracer_point(light->position());
    const std::optional<double> uniform = light->uniform_intensity();
    sources_.push_back({position.x, position.y, position.z, uniform.value_or(light->flux())});
    if (uniform) {
      light = nullptr;  // nothing remains to be multiplied
    } else {
      all_isotropic_ = false;
    }
  }
  if (all_isotropic_) return;
  for (auto* numbers : {&away_x_, &away_y_, &away_z_, &candela_}) numbers->resize(whole_lanes(batch_histories));
  find_common_table();
}

// Isotropic lights need no density: with them, photons are treated one by one.
void PointLights::find_common_table() {
  const bool some_isotropic =
      std::any_of(lights_.begin(), lights_.end(), [](const PointLight* light) { return light == nullptr; });
  if (some_isotropic) return;
  const CandelaTable* table = lights_.front()->table();
  for (const PointLight* light : lights_) {
    if (light->table() != table) return;
    const Frame& frame = light->frame();
    to_frames_.push_back(glm::transpose(glm::dmat3(frame.tangent, frame.bitangent, frame.normal)));
  }
  table_ = table;
}

void PointLights::sample(const Rays& rays, LightSamples& samples) {
  const std::size_t n = rays.size;
  const Places places{rays.x.data(), rays.y.data(), rays.z.data(), rays.facet.data(), rays.behind.data()};
  illuminate(n, places, tracer_->facets().data(), sources_.data(), samples.source.data(), tracer_->to_world(),
             2.0 * tracer_->step(), samples.irradiance.data(), samples.dx.data(), samples.dy.data(), samples.dz.data(),
             samples.within_reach.data());
  if (all_isotropic_) return;
  look_back(n, places, sources_.data(), samples.source.data(), tracer_->to_world(), away_x_.data(), away_y_.data(),
            away_z_.data());
  if (table_ != nullptr) {
    multiply_by_table(n, samples);
  } else {
    multiply_by_density(n, samples);
  }
}

void PointLights::multiply_by_table(std::size_t n, LightSamples& samples) {
  turn_into_frames(n, to_frames_.data(), samples.source.data(), away_x_.data(), away_y_.data(), away_z_.data());
  table_->candela(n, away_x_.data(), away_y_.data(), away_z_.data(), candela_.data());
  multiply_lanes(n, candela_.data(), 1.0 / table_->flux(), samples.irradiance.data());
}

void PointLights::multiply_by_density(std::size_t n, LightSamples& samples) {
  for (std::size_t i = 0; i < n; ++i) {
    const PointLight* light = lights_[samples.source[i]];
    if (light != nullptr && samples.irradiance[i] > 0.0)
      samples.irradiance[i] *= light->density({away_x_[i], away_y_[i], away_z_[i]});
  }
}

}  // namespace lichtmc
