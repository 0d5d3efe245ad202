#include "lichtmc/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/message.hpp"
#include "chance/significance.hpp"
#include "lichtmc/error.hpp"
#include "output/read_results.hpp"

namespace lichtmc {

namespace {

// Below four degrees of freedom Student's law has no variance of its own variance: an error is as good as unknown.
constexpr double least_freedom = 4.5;

// Degrees of freedom of the error of a difference (B. Welch, 1947).
double freedom_of(const FigurePair& pair, double freedom_a, double freedom_b) {
  const double a = pair.error_a * pair.error_a;
  const double b = pair.error_b * pair.error_b;
  const double sum = a + b;
  if (!(sum > 0.0)) return std::numeric_limits<double>::infinity();
  return 1.0 / (a / sum * (a / sum) / freedom_a + b / sum * (b / sum) / freedom_b);
}

class Comparer {
 public:
  Comparer(ComparisonOf what, double freedom_a, double freedom_b) : freedom_a_(freedom_a), freedom_b_(freedom_b) {
    result_.what = what;
  }

  void add(FigurePair pair) {
    pair.freedom = freedom_of(pair, freedom_a_, freedom_b_);
    if (pair.a == 0.0 && pair.b == 0.0) {
      ++result_.dark;
    } else if (std::isnan(pair.error_a) || std::isnan(pair.error_b) || !(pair.freedom >= least_freedom)) {
      ++result_.unknown;
    } else {
      result_.figures.push_back(std::move(pair));
    }
  }
  void leave_out() { ++result_.unmatched; }
  Comparison finish();

 private:
  Comparison result_;
  double freedom_a_;
  double freedom_b_;
};

Comparison Comparer::finish() {
  double mean = 0.0;      // of Σ z²
  double variance = 0.0;  // of Σ z²
  double sum_a = 0.0;
  double sum_b = 0.0;
  double squares = 0.0;
  double most_unlikely = -1.0;
  for (std::size_t k = 0; k < result_.figures.size(); ++k) {
    const FigurePair& pair = result_.figures[k];
    const double z = pair.z();
    const double v = pair.freedom;
    result_.chi_square += z * z;
    // Moments of the square of a variable that follows Student's law.
    const double stretch = std::isinf(v) ? 1.0 : v / (v - 2.0);
    mean += stretch;
    variance += std::isinf(v) ? 2.0 : 2.0 * stretch * stretch * (v - 1.0) / (v - 4.0);
    sum_a += pair.a;
    sum_b += pair.b;
    squares += pair.error_a * pair.error_a + pair.error_b * pair.error_b;
    const double normal = std::isinf(v) ? std::abs(z) : std::abs(normal_from_student(z, v));
    if (normal > most_unlikely) {
      most_unlikely = normal;
      result_.largest = k;
      result_.largest_z = z;
    }
  }
  if (result_.figures.empty()) return std::move(result_);
  result_.expected_chi_square = mean;
  result_.largest_chance = largest_of_normals_tail(most_unlikely, result_.figures.size());
  // A χ² stretched to the same mean and variance.
  const double freedom = 2.0 * mean * mean / variance;
  if (freedom >= 3.0) result_.chi_square_chance = chi_square_tail(freedom, result_.chi_square * freedom / mean);
  result_.difference = sum_b / sum_a - 1.0;
  result_.difference_error = std::sqrt(squares) / sum_a;
  result_.agree =
      result_.largest_chance >= comparison_false_alarm && result_.chi_square_chance >= comparison_false_alarm;
  return std::move(result_);
}

std::string name_of(const ComparableTile& tile) {
  return tile.surface + ", column " + std::to_string(tile.column) + ", row " + std::to_string(tile.row);
}

std::string name_of(const ComparableReceiver& receiver) {
  return "receiver " + receiver.name;
}

[[noreturn]] void refuse_different(const ComparableResult& a, const ComparableResult& b, const std::string& what,
                                   const std::string& difference, const std::string& advice) {
  throw InputError("The results in " + in_quotes(a.name) + " and " + in_quotes(b.name) + " have other " + what + ": " +
                   difference + " (allowed: the same). " + advice);
}

Comparison compare_tiles(const ComparableResult& a, const ComparableResult& b) {
  const char* advice = "Run both with the same room and the same --tile.";
  if (a.tiles.size() != b.tiles.size()) {
    refuse_different(a, b, "tiles", std::to_string(a.tiles.size()) + " and " + std::to_string(b.tiles.size()), advice);
  }
  Comparer comparer(ComparisonOf::tiles, a.tile_freedom, b.tile_freedom);
  for (std::size_t k = 0; k < a.tiles.size(); ++k) {
    const ComparableTile& one = a.tiles[k];
    const ComparableTile& other = b.tiles[k];
    if (one.surface != other.surface || one.column != other.column || one.row != other.row) {
      refuse_different(
          a, b, "tiles",
          "number " + std::to_string(k) + " is " + in_quotes(name_of(one)) + " and " + in_quotes(name_of(other)),
          advice);
    }
    comparer.add({name_of(one), one.irradiance, one.standard_error, other.irradiance, other.standard_error, 0.0});
  }
  return comparer.finish();
}

// Places and directions are written with all digits.
bool same_place(const ComparableReceiver& a, const ComparableReceiver& b) {
  return a.position == b.position && a.normal == b.normal;
}

Comparison compare_receivers(const ComparableResult& a, const ComparableResult& b) {
  const char* advice = "Run both with the same receivers.";
  if (a.receivers.size() != b.receivers.size()) {
    refuse_different(a, b, "receivers",
                     std::to_string(a.receivers.size()) + " and " + std::to_string(b.receivers.size()), advice);
  }
  Comparer comparer(ComparisonOf::receivers, a.receiver_freedom, b.receiver_freedom);
  for (std::size_t k = 0; k < a.receivers.size(); ++k) {
    const ComparableReceiver& one = a.receivers[k];
    const ComparableReceiver& other = b.receivers[k];
    if (!same_place(one, other)) {
      refuse_different(a, b, "receivers",
                       "number " + std::to_string(k) + ", " + in_quotes(one.name) + " and " + in_quotes(other.name) +
                           ", stand or look elsewhere",
                       advice);
    }
    comparer.add({name_of(one), one.irradiance, one.standard_error, other.irradiance, other.standard_error, 0.0});
  }
  return comparer.finish();
}

// Points that agree in all digits but those that decimal text and float may cost.
using Place = std::array<long long, 3>;
Place place_of(const glm::dvec3& point, double grid) {
  return {std::llround(point.x / grid), std::llround(point.y / grid), std::llround(point.z / grid)};
}

double largest_coordinate(const std::vector<ComparableTile>& tiles) {
  double largest = 0.0;
  for (const ComparableTile& tile : tiles)
    largest = std::max({largest, std::abs(tile.point.x), std::abs(tile.point.y), std::abs(tile.point.z)});
  return largest;
}

// The tiles of `a` with the receivers of `b`, or the other way round: the pairs keep a first.
Comparison compare_across(const ComparableResult& a, const ComparableResult& b, bool tiles_first) {
  const ComparableResult& with_tiles = tiles_first ? a : b;
  const ComparableResult& with_receivers = tiles_first ? b : a;
  constexpr double rounding = 1e-6;
  const double grid = std::max(rounding * largest_coordinate(with_tiles.tiles), std::numeric_limits<double>::min());
  std::multimap<Place, const ComparableTile*> tiles;
  for (const ComparableTile& tile : with_tiles.tiles) tiles.insert({place_of(tile.point, grid), &tile});
  Comparer comparer(ComparisonOf::tiles_at_receivers,
                    tiles_first ? with_tiles.tile_freedom : with_receivers.receiver_freedom,
                    tiles_first ? with_receivers.receiver_freedom : with_tiles.tile_freedom);
  for (const ComparableReceiver& receiver : with_receivers.receivers) {
    const auto [first, last] = tiles.equal_range(place_of(receiver.position, grid));
    if (first == last || std::next(first) != last) {
      comparer.leave_out();
      continue;
    }
    const ComparableTile& tile = *first->second;
    FigurePair pair{name_of(tile) + " and " + name_of(receiver),
                    tile.irradiance,
                    tile.standard_error,
                    receiver.irradiance,
                    receiver.standard_error,
                    0.0};
    if (!tiles_first) {
      std::swap(pair.a, pair.b);
      std::swap(pair.error_a, pair.error_b);
    }
    comparer.add(pair);
  }
  return comparer.finish();
}

}  // namespace

double FigurePair::z() const {
  const double difference = b - a;
  return difference == 0.0 ? 0.0 : difference / std::hypot(error_a, error_b);
}

std::string to_string(ComparisonOf what) {
  switch (what) {
    case ComparisonOf::tiles:
      return "tiles";
    case ComparisonOf::receivers:
      return "receivers";
    case ComparisonOf::tiles_at_receivers:
      return "tiles with receivers at their points";
  }
  return "";
}

namespace {

std::vector<Comparison> compare_figures(const ComparableResult& a, const ComparableResult& b) {
  if (a.unit != b.unit) {
    refuse_different(a, b, "units", a.unit + " and " + b.unit, "Run both with the same --unit.");
  }
  std::vector<Comparison> comparisons;
  if (!a.tiles.empty() && !b.tiles.empty()) comparisons.push_back(compare_tiles(a, b));
  if (!a.receivers.empty() && !b.receivers.empty()) comparisons.push_back(compare_receivers(a, b));
  if (comparisons.empty()) comparisons.push_back(compare_across(a, b, !a.tiles.empty()));
  const bool nothing = std::all_of(comparisons.begin(), comparisons.end(), [](const Comparison& comparison) {
    return comparison.figures.empty() && comparison.dark == 0;
  });
  if (nothing) {
    throw InputError("Nothing in " + in_quotes(a.name) + " can be compared with " + in_quotes(b.name) +
                     " (allowed: the same tiles, the same receivers, or receivers at the points x, y, z of the other's "
                     "tiles.csv, all with known errors). Run one of them again, with more photons or at the other's "
                     "points.");
  }
  return comparisons;
}

}  // namespace

std::vector<Comparison> compare_results(const std::filesystem::path& folder_a, const std::filesystem::path& folder_b) {
  return compare_figures(read_results(folder_a), read_results(folder_b));
}

std::vector<Comparison> compare(const Result& a, const Result& b) {
  return compare_figures(comparable(a, "a"), comparable(b, "b"));
}

}  // namespace lichtmc
