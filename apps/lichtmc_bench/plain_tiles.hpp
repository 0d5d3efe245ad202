// The direct light of tiles by integration of each emitter alone, ray by ray, as a reference for measurements: the way
// of version 0.2.0.
//
// First the irradiance without shadows is integrated over triangles. They are divided until a rule of degree 5 and one
// of degree 2 agree and they are small against the distance from the emitter and the width of its beam. Shadow rays
// then estimate the visible fraction: the mean over pairs of points in strata of the unshadowed flux, unbiased up to
// the second order of its own error. If nothing casts a shadow, no rays are traced.
//
// Emitters without a closed form (surfaces that do not follow Lambert's law, have an emission map, or very many
// triangles) are sampled as at receivers, from points distributed over the tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "chance/stream.hpp"
#include "tracer/tracer.hpp"
#include "walk/direct_light.hpp"
#include "walk/tile_faces.hpp"
#include "walk/triangle_integral.hpp"

namespace lichtmc::bench {

class PlainTiles {
 public:
  // The relative accuracy for a target error.
  static double accuracy(double target_error);

  // relative: the error to reach, relative to the direct irradiance of a face or to `level` (W/m² or lx), whichever is
  // larger; `level` is the emitted power over the area of all surfaces. All references must outlive this.
  PlainTiles(const DirectLight& light, const TileFaces& faces, const Tracer& tracer, const Stream& stream,
             double relative, double level);

  // The mean direct irradiance of a face. Its error contains a bound on that of the integration and the
  // standard error of the visible fraction. Random points depend on (seed, face) only.
  DirectIrradiance mean(std::size_t face, TraceCount& count) const;

 private:
  template <class SampleAt>
  DirectIrradiance shadowed(const std::vector<IntegratedTriangle>& leaves, std::size_t face, std::uint64_t number,
                            const SampleAt& sample_at) const;
  DirectIrradiance by_point(const PointLight& source, std::size_t face, std::uint64_t number, TraceCount& count) const;
  DirectIrradiance by_surface(std::size_t k, std::size_t face, std::uint64_t number, TraceCount& count) const;

  const DirectLight* light_;
  const TileFaces* faces_;
  const Tracer* tracer_;
  Stream stream_;
  double relative_;
  double level_;
};

}  // namespace lichtmc::bench
