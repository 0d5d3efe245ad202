// The first flights of backward walks: the walks of a round leave in directions that are spread evenly, and those of a
// face from places that are.
//
// Direction j of n is point j of a golden spiral on the unit disc that Lambert's law projects to: sin²θ = (j + s)/n
// within the field of view, azimuth 2π (j γ + t), γ = (3 − √5)/2 (H. Vogel, A better way to construct the sunflower
// head, Math. Biosci. 44 (1979) 179). s and t are random, the same for a round: each part of the disc has its share of
// the directions on average, so that the mean of a round is unbiased. Places are Sobol's points with a random digital
// shift (chance/sobol.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

#include "base/lanes.hpp"
#include "chance/stream.hpp"
#include "tracer/rays.hpp"
#include "walk/origin_view.hpp"

namespace lichtmc {

// The random words that choose directions and places.
class RoundPoints {
 public:
  // group: walks in a round, above 0. has_place: they have places.
  RoundPoints(std::uint32_t group, bool has_place);

  // Round `set` of the walks with these random numbers begins: rounds have numbers of their own for each origin.
  void begin(const Stream& stream, std::uint64_t set);

  // Of walk `number` of the round.
  std::uint32_t polar(std::uint32_t number) const { return points_[number].polar + polar_shift_; }
  std::uint32_t azimuth(std::uint32_t number) const { return points_[number].azimuth + shift_[1]; }
  std::uint32_t place(std::uint32_t number, std::size_t k) const { return points_[number].place[k] ^ place_shift_[k]; }

 private:
  static constexpr std::uint32_t golden = 1640531527;  // γ, in units of 2⁻³²
  struct Point {
    std::uint32_t polar = 0;
    std::uint32_t azimuth = 0;
    std::array<std::uint32_t, 2> place{};
  };

  bool has_place_;
  std::vector<Point> points_;  // by azimuth: neighbours are traced together, in similar directions
  Words shift_{};
  std::uint32_t polar_shift_ = 0;
  Words place_shift_{};
};

// Directions by Lambert's law within fields of view, or with the densities of cylinders and half cylinders.
class FirstFlights {
 public:
  explicit FirstFlights(std::size_t capacity);

  // Flight i: what it leaves, and two random words.
  void set(std::size_t i, const OriginView& view, std::uint32_t polar, std::uint32_t azimuth);

  // Sets the directions of the first n flights, which have been set since the last call, and their weights as in
  // ReferencePoint::weight(): the cosines of their angles to the normals. directions: world → the tracer's coordinates.
  void aim(std::size_t n, const glm::dmat3& directions, Rays& rays, float* weights);

 private:
  // A flight from a cylinder.
  struct Around {
    std::size_t flight = 0;
    glm::dvec3 axis{0.0};
    glm::dvec3 facing{0.0};
  };

  std::vector<float> normal_x_, normal_y_, normal_z_;
  std::vector<float> view_;  // squared sine of the half angle of the field of view
  std::vector<std::uint32_t> polar_, azimuth_;
  std::vector<Around> around_;
};

}  // namespace lichtmc
