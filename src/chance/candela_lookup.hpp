// The intensity of a candela table in given directions, one by one or many in a loop that vectorises.
//
// Light samples of walks ask for it at every surface. The interval of an angle is found by a guide: equal bins over the
// range of the angles, each with the interval of its beginning; where bins are not wider than the intervals, it is that
// or the next one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "chance/candela_grid.hpp"
#include "lichtmc/candela_table.hpp"

namespace lichtmc {

class CandelaLookup {
 public:
  // The grid must have been checked, and outlive this.
  explicit CandelaLookup(const CandelaTable::Grid& grid);

  // In cd, in a direction of the luminaire's frame.
  double candela(const glm::dvec3& direction) const;

  // The same for n directions. Arrays that do not overlap.
  void candela(std::size_t n, const double* x, const double* y, const double* z, double* candela) const;

 private:
  // Angles with their guide, in degrees.
  struct Angles {
    explicit Angles(const std::vector<double>& angles);

    double first = 0.0;
    double last = 0.0;
    double bins_per_degree = 0.0;
    std::vector<std::uint32_t> guide;  // intervals
    std::vector<double> from;          // of each interval; and the last angle
    std::vector<double> per_degree;    // 1 divided by its width
    bool one_step = true;              // whether the interval is that of the guide or the next
  };

  const CandelaTable::Grid* grid_;
  Mirrors mirrors_;
  Angles vertical_;
  Angles horizontal_;
  std::size_t next_plane_ = 0;  // distance of the values of the next plane; 0: rotational
};

}  // namespace lichtmc
