// The direct light on tiles, computed before the walks instead of estimated by photons.
//
// Each emitter's light on a face is a mean over pairs of points in strata (light_on_face.hpp), with a shadow ray for
// each pair. A few samples of every emitter come first. They tell how the rest is divided among the emitters, so that
// the error of their sum is small enough. The standard error comes from the differences within the strata.
//
// What does not depend on shadows is integrated where that is cheaper than sampling: point emitters always, area lights
// of few triangles if all of their samples are visible and many would be needed. Samples then give the part that
// shadows take away. Rooms where nothing casts a shadow need no samples, unless a light has no closed form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "chance/stream.hpp"
#include "tracer/tracer.hpp"
#include "walk/direct_light.hpp"
#include "walk/light_on_face.hpp"
#include "walk/tile_faces.hpp"

namespace lichtmc {

// The error to reach: `relative` times the largest of the direct irradiance of a face, `floor`, and what its tile
// receives at least, if that is known.
struct TileAccuracy {
  double relative = 3e-3;
  double floor = 0.0;              // W/m² or lx
  std::vector<double> least = {};  // the same, of each tile; or empty
};

class DirectTiles {
 public:
  // All references must outlive this.
  DirectTiles(const DirectLight& light, const TileFaces& faces, const Tracer& tracer, const Stream& stream,
              TileAccuracy accuracy);

  // The mean direct irradiance of a face and its standard error, which includes a bound on the error of what is
  // integrated. Random points depend on (seed, face) only.
  DirectIrradiance mean(std::size_t face, TraceCount& count) const;

 private:
  class Sum;

  const DirectLight* light_;
  const TileFaces* faces_;
  const Tracer* tracer_;
  Stream stream_;
  TileAccuracy accuracy_;
};

}  // namespace lichtmc
