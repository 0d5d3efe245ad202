// The emission of a surface with an emission map: its mean, and points with a density proportional to it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "chance/choice.hpp"
#include "chance/philox.hpp"
#include "chance/places.hpp"
#include "chance/stream.hpp"
#include "lichtmc/room.hpp"
#include "room/texture_map.hpp"
#include "room/value_bounds.hpp"

namespace lichtmc {

// The mean value of a map over the area of a surface; uvs: coordinates on the map, one per position. If the surface
// covers up to 2^18 pixels it is exact: the map is quadratic between the centres of neighbouring pixels, and integrated
// piece by piece. Beyond, the mean over equal parts of the triangles, about one per pixel and at most some millions.
// known: means of triangles that were computed before, on the same map; new ones are added.
using TriangleMeans = std::map<std::array<double, 7>, double>;  // by number of parts and corners on the map
double mean_emission(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs,
                     TriangleMeans& known);
double mean_emission(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs);

// Whether the mean is above 0.
bool emits(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs);

// A point of a surface: barycentric coordinates of the second and third corner of a triangle.
struct EmissionPlace {
  std::size_t triangle = 0;  // index into Surface::triangles
  glm::dvec2 weights{0.0};
  double relative = 1.0;  // exitance at the point, divided by its mean
};

// Points are drawn by rejection, which needs no model of the map but bounds of it: the triangles are divided into
// pieces with a known highest value; a piece is chosen in proportion to its area times this value, a point uniform on
// it is accepted with the probability value/highest value. The density of accepted points is exactly that of the map.
// Pieces are divided where most proposals would be lost, until three of four are accepted or their number is reached.
class SurfaceEmission {
 public:
  static constexpr std::size_t most_pieces_of_room = std::size_t{1} << 18;

  // bounds: of the map. mean: of the map over the surface, above 0. Surface, map and uvs must outlive this.
  SurfaceEmission(const Surface& surface, const EmissionMap& map, const std::vector<glm::dvec2>& uvs,
                  const ValueBounds& bounds, double mean, std::size_t most_pieces = most_pieces_of_room);

  // The exitance at a point of a triangle, divided by its mean.
  double relative(std::size_t triangle, const glm::dvec2& weights) const { return value(triangle, weights) / mean_; }

  // A bound of the exitance anywhere, divided by its mean.
  double highest() const { return double{highest_} / mean_; }

  // Whether the map has the same value on all of the surface, to 10⁻⁵ (the corners of a palette's colour may have
  // rounded coordinates).
  bool uniform() const { return uniform_; }

  // u chooses the piece of the first proposal, v and w the point on it (all in [0, 1)). further(k): the k-th set of
  // further random words: one to decide about a proposal, three for the next.
  template <class Further>
  EmissionPlace choose_place(double u, double v, double w, const Further& further) const {
    return choose_from(pieces_[choose(shares_up_to_, u)], v, w, further);
  }

  // The same by two numbers p and q, so that equal parts of the unit square are equal parts of the proposals.
  template <class Further>
  EmissionPlace choose_evenly(double p, double q, const Further& further) const {
    const std::size_t k = choose(shares_up_to_, p);
    return choose_from(pieces_[k], share_within(shares_up_to_, k, p), q, further);
  }

 private:
  struct Piece {
    std::uint32_t triangle = 0;
    std::array<glm::vec2, 3> corners{};  // barycentric; multiples of a power of two, exact in float
    float lowest = 0.0F;
    float highest = 0.0F;
  };
  class Division;

  template <class Further>
  EmissionPlace choose_from(Piece piece, double v, double w, const Further& further) const {
    for (std::uint32_t k = 0;; ++k) {
      const glm::dvec2 in_piece = uniform_on_triangle(v, w);
      const glm::dvec2 a(piece.corners[0]);
      const glm::dvec2 place =
          a + in_piece.x * (glm::dvec2(piece.corners[1]) - a) + in_piece.y * (glm::dvec2(piece.corners[2]) - a);
      const double found = value(piece.triangle, place);
      if (found >= double{piece.highest}) return {piece.triangle, place, found / mean_};
      const Words words = further(k);
      if (unit_open(words[0]) * double{piece.highest} < found) return {piece.triangle, place, found / mean_};
      piece = pieces_[choose(shares_up_to_, unit_open(words[1]))];
      v = unit_open(words[2]);
      w = unit_open(words[3]);
    }
  }

  double value(std::size_t triangle, const glm::dvec2& weights) const {
    const glm::uvec3 corner = surface_->triangles[triangle];
    const glm::dvec2 a = (*uvs_)[corner.x];
    const glm::dvec2 uv = a + weights.x * ((*uvs_)[corner.y] - a) + weights.y * ((*uvs_)[corner.z] - a);
    return value_at(*map_, uv.x, uv.y);
  }

  const Surface* surface_;
  const EmissionMap* map_;
  const std::vector<glm::dvec2>* uvs_;
  double mean_;
  bool uniform_ = false;
  float highest_ = 0.0F;
  std::vector<Piece> pieces_;  // those that emit
  std::vector<double> shares_up_to_;
};

// Prepares the emission of the emitters of a room, which share maps and the number of pieces.
class EmissionOfRoom {
 public:
  // The room must outlive this and all that it makes.
  explicit EmissionOfRoom(const Room& room);

  // None if the exitance of the emitter is uniform.
  std::optional<SurfaceEmission> of(const SurfaceEmitter& emitter);

 private:
  const Room* room_;
  std::size_t most_pieces_;                    // per emitter
  std::map<std::size_t, ValueBounds> bounds_;  // by map
  std::map<std::size_t, TriangleMeans> means_;
};

}  // namespace lichtmc
