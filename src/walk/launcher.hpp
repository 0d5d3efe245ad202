// Where photons start: an emitter is chosen by its power, then a place on it, then a direction by its law.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "chance/stream.hpp"
#include "lichtmc/room.hpp"
#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

class Launcher {
 public:
  // The room must have passed check_room().
  Launcher(const Room& room, const Tracer& tracer);

  // Starts photon i with the random numbers of a history: sets its direction, and its start point or the place on a
  // facet it leaves.
  void launch(const Stream& stream, std::uint64_t history, Rays& rays, std::size_t i) const;

  // The same for photons 0 … n − 1 (n ≤ batch_histories) with histories from `first` on; in rooms with one point
  // emitter several at once.
  void launch_all(const Stream& stream, std::uint64_t first, std::uint32_t n, Rays& rays) const;

  // Whether every point emitter hangs free of all surfaces.
  bool hangs_free() const { return hangs_free_; }

 private:
  struct PointSource {
    Start start;
    glm::dmat3 to_tracer{1.0};  // from the emitter's frame, third axis its own
    std::variant<IsotropicEmitter, LambertEmitter, SpotEmitter> law;
  };
  struct SurfaceSource {
    std::vector<double> areas_up_to;  // cumulative shares of the triangles' areas, the last is 1
    std::vector<TriangleOnFacet> triangles;
    double exponent = 1.0;
  };

  PointSource point_source(const Emitter& emitter, const Tracer& tracer);
  static SurfaceSource surface_source(const Room& room, const SurfaceEmitter& emitter, const Tracer& tracer);
  void launch_from(const PointSource& source, const Stream& stream, std::uint64_t first, std::uint32_t n,
                   Rays& rays) const;
  void start_at(const PointSource& source, const Words& words, Rays& rays, std::size_t i) const;
  void start_on(const SurfaceSource& source, const Words& words, const Words& place, Rays& rays, std::size_t i) const;

  const std::vector<Facet>* facets_;
  std::vector<double> powers_up_to_;  // cumulative shares of the power, the last is 1
  std::vector<std::variant<PointSource, SurfaceSource>> sources_;
  bool hangs_free_ = true;
};

}  // namespace lichtmc
