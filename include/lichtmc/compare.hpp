// Comparison of two results: whether they agree within their standard errors.
//
// Every figure that both contain gives a z-score, z = (b − a)/√(σ_a² + σ_b²). If both results are correct and
// independent, the z-scores follow the normal distribution (Student's if the errors come from few batches): the
// distribution of the largest of n is known, and Σ z² follows χ². The results disagree if either is so large that
// chance alone would cause it once in a million comparisons.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/area.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc {

// A figure that two results contain: irradiance of a tile or at a receiver, W/m² or lx.
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
  tiles,               // the tiles of both, which must be the same
  receivers,           // the receivers of both, which must be the same
  tiles_at_receivers,  // tiles of one with receivers of the other that lie at their points
};

// "tiles", "receivers", "tiles with receivers at their points".
std::string to_string(ComparisonOf what);

struct Comparison {
  ComparisonOf what = ComparisonOf::tiles;
  std::vector<FigurePair> figures;  // those that can be compared
  std::size_t dark = 0;             // figures left out because both are 0
  std::size_t unknown = 0;          // figures left out because an error is unknown (too few batches)
  std::size_t unmatched = 0;        // receivers that lie at no tile's point, or at those of several
  std::size_t largest = 0;          // index of the figure with the largest |z|
  double largest_z = 0.0;           // signed
  double largest_chance = 1.0;      // probability that chance alone causes one this large
  double chi_square = 0.0;          // Σ z²
  double expected_chi_square = 0.0;
  double chi_square_chance = 1.0;  // probability that chance alone causes one this large
  double difference = 0.0;         // (mean of the figures of b)/(mean of those of a) − 1
  double difference_error = 0.0;   // its standard error
  bool agree = true;
};

// A deviation with a probability below this is not attributed to chance.
inline constexpr double comparison_false_alarm = 1e-6;

// Compares the results in two folders written by `lichtmc run`: tiles if both have tiles, receivers if both have
// receivers; otherwise the tiles of one with the receivers of the other.
//
// Throws InputError if a folder contains no result, the units differ, the tiles or receivers are not the same, or
// nothing can be compared.
std::vector<Comparison> compare_results(const std::filesystem::path& a, const std::filesystem::path& b);

// The same for two results in memory, called "a" and "b" in messages.
std::vector<Comparison> compare(const Result& a, const Result& b);

// Those of its figures with the largest |z|, the largest first; at most `count`.
std::vector<const FigurePair*> worst_figures(const Comparison& comparison, std::size_t count);

// The comparison in words, a few lines; if they disagree, with the `count` worst figures.
std::string comparison_text(const Comparison& comparison, std::size_t count = 5);

// A calculation area of a design.
struct DesignArea {
  std::string name;
  std::string role;
  std::string quantity;  // "horizontal", …
  std::size_t points = 0;
  Figure mean;  // W/m² or lx
  Figure minimum;
  Figure uniformity;
  std::optional<double> target_mean;
  std::optional<double> target_uniformity;
  Verdict verdict = Verdict::none;
  Verdict mean_verdict = Verdict::none;
  Verdict uniformity_verdict = Verdict::none;
  std::optional<double> above_floor_m;
};

// An area of two designs, by its name. In one of them it may be missing.
struct DesignAreas {
  std::optional<DesignArea> a;
  std::optional<DesignArea> b;
  // b − a, with the errors of independent results; NaN if one is missing.
  Figure mean_difference;
  Figure uniformity_difference;
};

struct DesignTotals {
  // NaN: unknown. Of different factors the lowest and the highest; the latter is the same if all are.
  double least_maintenance_factor = std::numeric_limits<double>::quiet_NaN();
  double greatest_maintenance_factor = std::numeric_limits<double>::quiet_NaN();
  double power = 0.0;           // of all emitters, W or lm
  std::optional<double> watts;  // that all luminaires take, if all emitters have a photometric file that tells it
};

struct DesignComparison {
  std::string a;  // the folders
  std::string b;
  std::string unit;                // of power: "W" or "lm"
  std::vector<DesignAreas> areas;  // in the order of a, then those of b alone
  DesignTotals total_a;
  DesignTotals total_b;
};

// Two designs side by side: the areas of the results, or scenes, in two folders. A difference is no fault.
//
// Throws InputError if a folder contains no result or no areas, or if the units differ.
DesignComparison compare_designs(const std::filesystem::path& a, const std::filesystem::path& b);

// The comparison as a table, for readers.
std::string designs_text(const DesignComparison& designs);

}  // namespace lichtmc
