// Direct light at points: what emitters send there straight.
//
// At a receiver it is computed to the last digit, outside the statistics: point emitters in closed form, E = I(θ) cos
// θ'/r² where nothing stands between; Lambertian surface emitters by the closed polygon formula where nothing can;
// other surface emitters by stratified points on them. At the surfaces that a backward walk meets it is estimated by
// one point of one emitter, or of each of a few.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "chance/stream.hpp"
#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"
#include "walk/light_source.hpp"

namespace lichtmc {

// Where ways from a point begin, in the tracer's coordinates: one step off the surface that it may lie on, on the side
// that it looks to.
glm::dvec3 start_of(const ReferencePoint& reference, const Tracer& tracer);

struct DirectIrradiance {
  double value = 0.0;           // W/m² or lx
  double standard_error = 0.0;  // 0 where it is exact
};

class DirectLight {
 public:
  // The room must have passed check_room(), and outlive this.
  DirectLight(const Room& room, const Tracer& tracer);

  // The direct irradiance at a receiver. Points for surface emitters depend on (seed, number) only. Shadow rays are
  // counted.
  DirectIrradiance at(const ReferencePoint& reference, const Stream& stream, std::uint64_t number,
                      TraceCount& count) const;

  // The emitters with a power. Each surface emitter has a number for random words of its own.
  const std::vector<PointSource>& points() const { return points_; }
  const std::vector<SurfaceSource>& surfaces() const { return surfaces_; }

  // Whether something stands between a point and a point of an emitter.
  bool blocked(const ReferencePoint& reference, const glm::dvec3& target, TraceCount& count) const;

  // How good a sampled value must be: as many pairs of samples are taken, from 32 doubled up to `most`/2, until the
  // standard error is at most `relative` of the value or `absolute`.
  struct Accuracy {
    double relative = 1e-3;
    double absolute = 0.0;  // W/m² or lx
    std::uint32_t most = 16384;
  };
  // The irradiance by surface source k at a point, or as the mean over several: outlook(n) is where sample n is taken.
  DirectIrradiance sampled(std::size_t k, const std::function<ReferencePoint(std::uint32_t)>& reference,
                           const Stream& stream, std::uint64_t number, const Accuracy& accuracy,
                           TraceCount& count) const;

  // How many offers a surface takes: one of every emitter where they are few, else one of one chosen by its power.
  std::size_t light_samples_per_point() const { return few_ ? sources_.size() : 1; }

  // Offer k (below offers_per_point()) at a point of the walk. Its mean over the random words is the direct irradiance,
  // where surface emitters count with the weight that walks which meet them leave (see hit()).
  LightSample offer(std::size_t k, const ReferencePoint& reference, const Words& which, const Words& where) const;

  // A walk that left a surface at an angle of this cosine has met the front of a shining surface after r metres, at an
  // angle of `cosine_there`: its share of the direct irradiance at the surface that it left. Points on an emitter and
  // walks that meet it are two ways to the same light; each counts by how likely it was (balance heuristic: E. Veach,
  // L. Guibas, Optimally Combining Sampling Techniques for Monte Carlo Rendering, SIGGRAPH 1995). Without it a wall
  // that meets a luminous ceiling would get 1/r² of its edge.
  double hit(std::size_t surface, double cosine_here, double cosine_there, double r_m) const;
  bool has_area_lights() const { return !surfaces_.empty(); }
  bool is_area_light(std::size_t surface) const { return !sources_of_surface_[surface].empty(); }

  // Whether a receiver there is on an emitter: the emitter's number.
  std::optional<std::size_t> emitter_at(const ReferencePoint& reference) const;

 private:
  struct Source {
    bool on_surface = false;
    std::size_t index = 0;  // into points_ or surfaces_
    double share = 1.0;     // probability that an offer is of it
  };
  using ReferencePointAt = std::function<ReferencePoint(std::uint32_t)>;

  std::vector<double> by_points(const SurfaceSource& source, const ReferencePointAt& reference, const Stream& stream,
                                std::uint64_t number, std::uint32_t first, std::uint32_t n, TraceCount& count) const;
  std::vector<double> by_flights(const SurfaceSource& source, const ReferencePointAt& reference, const Stream& stream,
                                 std::uint64_t number, std::uint32_t first, std::uint32_t n, TraceCount& count) const;

  const Room* room_;
  const Tracer* tracer_;
  std::vector<PointSource> points_;
  std::vector<SurfaceSource> surfaces_;
  std::vector<Source> sources_;
  std::vector<double> powers_up_to_;
  std::vector<double> surface_shares_;                        // of surfaces_: probability that an offer is of it
  std::vector<std::vector<std::size_t>> sources_of_surface_;  // indices into surfaces_
  bool few_ = true;
};

}  // namespace lichtmc
