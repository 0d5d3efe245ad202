// The direct light on tiles, integrated over their area instead of counted.
//
// What would fall on a tile if nothing stood between is integrated: over triangles that are divided until a rule of
// degree 5 and one of degree 2 agree, and that are small against the distance from a lamp and the width of its beam.
// How much of it arrives is then asked by shadow rays: the mean of what is seen, over pairs of points in strata of that
// light, is unbiased up to the second order of its own error. Where nothing casts a shadow nothing is asked.
//
// Emitters without a closed form (surfaces that do not follow Lambert's law, or of very many triangles) are sampled as
// at receivers, from points all over the tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "chance/stream.hpp"
#include "tracer/tracer.hpp"
#include "walk/direct_light.hpp"
#include "walk/tile_faces.hpp"
#include "walk/triangle_integral.hpp"

namespace lichtmc {

class DirectTiles {
 public:
  // `relative`: the error to reach, of a face's direct light or, where that is little, of `level` (W/m² or lx), the
  // irradiance that the light spread over all surfaces makes. All must outlive this.
  DirectTiles(const DirectLight& light, const TileFaces& faces, const Tracer& tracer, const Stream& stream,
              double relative, double level);

  // The mean direct irradiance of a face. Its error bounds that of the integration and holds that of the shadows'
  // sampling. Random points depend on (seed, face) only.
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

}  // namespace lichtmc
