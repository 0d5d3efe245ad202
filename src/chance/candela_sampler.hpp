// Directions with a density proportional to the intensity of a candela table.
//
// A cell of the table, between adjacent angles, is chosen in proportion to its exact flux; within it ψ by inversion of
// the integral over ψ, and φ by inversion of the linear density that remains (candela_grid.hpp has ψ and φ). Cells are
// divided into rows of at most 2.5°, in which the sine is a cubic to 2·10⁻⁷, and at a pole further: this changes
// nothing in the density, which is bilinear in every part of a cell, and makes Newton's method converge in three steps.
// Numbers that increase give cells in their order, so that evenly spread numbers give evenly spread directions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "chance/candela_grid.hpp"
#include "lichtmc/candela_table.hpp"

namespace lichtmc {

class CandelaSampler {
 public:
  // The grid must be that of a CandelaTable, and outlive this.
  explicit CandelaSampler(const CandelaTable::Grid& grid);

  // 0 < u < 1, 0 ≤ turns ≤ 1; in double.
  glm::dvec3 sample(double u, double turns) const;

  // The same for n pairs of random words, in float. Arrays of whole_lanes(n) elements that do not overlap.
  void sample(std::size_t n, const std::uint32_t* polar, const std::uint32_t* azimuth, float* x, float* y,
              float* z) const;

 private:
  // A part of the table between two ψ, seen from its end that is nearer to a pole.
  struct Row {
    double sine = 0.0;  // at that end
    double cosine = 1.0;
    double width = 0.0;       // to the other end, in rad; below 0 if that has the smaller ψ
    std::uint32_t begin = 0;  // boundary of the first end, in values_
    std::uint32_t end = 0;    // of the other

    double sine_at(double s) const;  // of ψ at the part s of the width
    double cosine_at(double s) const;
    // ∫ I sin ψ dψ from the first end to there, I linear from `first` to `last`.
    double integral(double first, double last, double s) const;
  };
  // A cell with a flux above 0. The last one is an end mark.
  struct Cell {
    double from = 0.0;     // fraction of the flux before it
    float per_flux = 0.0;  // 1 divided by its fraction
    std::uint16_t plane = 0;
    std::uint16_t row = 0;
  };
  struct Gathered;

  void set_rows();
  void set_cells();
  const Cell& choose(double u, std::uint32_t first_bits) const;  // those of u
  void gather(std::size_t n, const std::uint32_t* polar, Gathered& cells) const;

  const CandelaTable::Grid* grid_;
  Mirrors mirrors_;
  std::size_t boundaries_ = 0;  // of rows
  std::vector<Row> rows_;
  std::vector<float> values_;     // intensity at the boundaries, plane by plane
  std::vector<float> from_turn_;  // of the intervals of φ, in turns
  std::vector<float> turns_;      // their widths
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> guide_;  // the cell at which the search for a number with these first bits begins
  unsigned guide_shift_ = 32;
};

}  // namespace lichtmc
