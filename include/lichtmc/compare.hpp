// Two results held against each other: do they agree within their errors?
//
// Every figure that both have gives a z-score, z = (b − a)/√(σ_a² + σ_b²). If both results are right and independent
// the z-scores follow the normal law (Student's where few batches told the errors): the largest of n is known, and Σ z²
// follows χ². They disagree where either comes out so large that chance would do it once in a million comparisons.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lichtmc {

// A figure that two results have: irradiance of a tile or at a receiver, W/m² or lx.
struct FigurePair {
  std::string name;  // "floor, column 3, row 4"; "receiver desk"
  double a = 0.0;
  double error_a = 0.0;  // standard error
  double b = 0.0;
  double error_b = 0.0;
  double freedom = 0.0;  // degrees of freedom of the error of the difference
  double z() const;
};

enum class ComparisonOf {
  tiles,               // tiles with the same tiles
  receivers,           // receivers with the same receivers
  tiles_at_receivers,  // tiles of one with receivers of the other that lie at their points
};

// "tiles", "receivers", "tiles with receivers at their points".
std::string to_string(ComparisonOf what);

struct Comparison {
  ComparisonOf what = ComparisonOf::tiles;
  std::vector<FigurePair> figures;  // those that can be compared
  std::size_t dark = 0;             // figures left out because they are 0 in both
  std::size_t unknown = 0;          // left out because an error is not known (too few batches)
  std::size_t unmatched = 0;        // receivers that lie on no tile's point, or on that of several
  std::size_t largest = 0;          // index of the figure with the largest |z|
  double largest_z = 0.0;           // signed
  double largest_chance = 1.0;      // probability that chance makes one as large
  double chi_square = 0.0;          // Σ z²
  double expected_chi_square = 0.0;
  double chi_square_chance = 1.0;  // probability that chance makes it as large
  double difference = 0.0;         // mean of the figures of b over that of a, less 1
  double difference_error = 0.0;   // its standard error
  bool agree = true;
};

// The probability below which a deviation is not taken for chance.
inline constexpr double comparison_false_alarm = 1e-6;

// Compares the results in two folders that `lichtmc run` has written: tiles where both have tiles, receivers where both
// have receivers; where neither is so, the tiles of one with the receivers of the other.
//
// Throws InputError where a folder holds no result, the units differ, the tiles or receivers are not the same ones, or
// nothing can be compared.
std::vector<Comparison> compare_results(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace lichtmc
