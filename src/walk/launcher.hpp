// The start of photons: an emitter is chosen in proportion to its power, then a point on it, then a direction by its
// law.
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
#include "room/emission.hpp"
#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"
#include "walk/launch_words.hpp"

namespace lichtmc {

class Launcher {
 public:
  // The room must have passed check_room().
  Launcher(const Room& room, const Tracer& tracer);

  // Starts photon i with the random numbers of a history: sets its direction, and its start point or its position
  // on a facet.
  void launch(const Stream& stream, std::uint64_t history, Rays& rays, std::size_t i) const;

  // The same for n photons (n ≤ batch_histories) with histories first … first + n − 1, several at once. photon: which
  // of the histories, counted from `first`, photon i of the wave is; an array of batch_histories.
  void launch_all(const Stream& stream, std::uint64_t first, std::uint32_t n, Rays& rays, std::uint32_t* photon) const {
    launch_all(LaunchWords(stream), first, n, rays, photon);
  }
  // With other words. emitter: receives the index into Room::emitters for each of the histories, unless null.
  void launch_all(const LaunchWords& words, std::uint64_t first, std::uint32_t n, Rays& rays, std::uint32_t* photon,
                  std::uint32_t* emitter = nullptr) const;

  // The same, but history h starts from emitter emitters[h/each], whatever its power; emitters: numbers in the room.
  void launch_in_turn(const Stream& stream, std::uint64_t first, std::uint32_t n,
                      const std::vector<std::size_t>& emitters, std::size_t each, Rays& rays,
                      std::uint32_t* photon) const;

  // The emitter that starts a history, its number in the room.
  std::size_t emitter_of(const Stream& stream, std::uint64_t history) const;

  // Whether no point emitter touches a surface.
  bool all_off_surfaces() const { return all_off_surfaces_; }

 private:
  struct PointSource {
    Start start;
    glm::dmat3 to_tracer{1.0};  // from the emitter's frame, third axis its own
    EmitterLaw law;
    std::optional<LuminousOpening> opening{};  // all over which photons start; none: at one point
    glm::dmat3 places{1.0};                    // its points, from the emitter's frame to the tracer's coordinates
  };
  struct SurfaceSource {
    std::vector<double> areas_up_to;  // cumulative fractions of the triangles' areas, the last is 1
    std::vector<TriangleOnFacet> triangles;
    LambertLaw law;                           // about the normal
    std::optional<SurfaceEmission> emission;  // if it is not uniform
  };

  template <class Shape>
  PointSource point_source(const Shape& shape, const Tracer& tracer);
  static SurfaceSource surface_source(const Room& room, const SurfaceEmitter& emitter, EmissionOfRoom& emission,
                                      const Tracer& tracer);
  struct Launches;

  std::vector<std::uint32_t> sort_by_source(std::uint32_t n, Launches& launches, std::uint32_t* photon,
                                            std::uint32_t* emitter) const;
  // Photons begin … end − 1 of the wave start from source k.
  void launch_from(std::size_t k, Launches& launches, std::uint32_t begin, std::uint32_t end, const LaunchWords& words,
                   std::uint64_t first, Rays& rays, const std::uint32_t* photon) const;
  template <class Law>
  void launch_from_point(const PointSource& point, const Law& law, Launches& launches, std::uint32_t begin,
                         std::uint32_t end, Rays& rays) const;
  // place: random words of the point of the opening; null without one.
  static void start_at(const PointSource& source, const glm::dvec3& local, const Words* place, Rays& rays,
                       std::size_t i);
  // A photon of this history starts from a surface, in a direction of the facet's frame.
  void start_on(const SurfaceSource& source, const glm::vec3& local, const LaunchWords& words, std::uint64_t history,
                Rays& rays, std::size_t i) const;

  const std::vector<Facet>* facets_;
  std::vector<double> powers_up_to_;  // cumulative fractions of the power, the last is 1
  std::vector<std::variant<PointSource, SurfaceSource>> sources_;
  std::optional<std::size_t> only_source_;  // the only one with a power, if there is one
  bool all_off_surfaces_ = true;
};

}  // namespace lichtmc
