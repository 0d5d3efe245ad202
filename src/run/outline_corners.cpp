#include "run/outline_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

double cross2(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// The points first … last of a cyclic list.
struct StraightRun {
  std::size_t first = 0;
  std::size_t last = 0;  // may be ≥ the size of the list
  bool is_wall() const { return last - first >= 2; }
};

class Corners {
 public:
  Corners(const std::vector<glm::dvec2>& points, double spacing, double rounding)
      : points_(points), spacing_(spacing), rounding_(rounding) {}

  std::vector<glm::dvec2> polygon() {
    std::vector<StraightRun> runs;
    const std::size_t begin = first_corner();
    for (std::size_t k = begin; k < begin + points_.size(); k = runs.back().last + 1)
      runs.push_back({k, end_of_run(k, begin + points_.size() - 1)});
    find_corners(runs);
    std::vector<glm::dvec2> corners;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (cut_[k]) continue;
      const std::size_t first = runs[k].first;
      const std::size_t last = runs[k].last;
      if (!runs[k].is_wall()) {
        for (std::size_t n = first; n <= last; ++n) corners.push_back(at(n));
        continue;
      }
      if (!begins_at_corner_[k]) corners.push_back(at(first));
      corners.push_back(corner_after_[k].value_or(at(last)));
    }
    for (glm::dvec2& corner : corners)
      corner = {short_decimal(corner.x, rounding_), short_decimal(corner.y, rounding_)};
    return corners;
  }

 private:
  const glm::dvec2& at(std::size_t k) const { return points_[k % points_.size()]; }

  bool on_line(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) const {
    const double length = glm::length(b - a);
    return length == 0.0 || std::abs(cross2(b - a, p - a)) <= 2.0 * rounding_ * length;
  }

  // A point that is not on the line through its neighbours, whose next one is.
  std::size_t first_corner() const {
    const std::size_t n = points_.size();
    for (std::size_t k = 0; k < n; ++k) {
      if (!on_line(at(k + n - 1), at(k + 1), at(k)) && on_line(at(k), at(k + 2), at(k + 1))) return k;
    }
    return 0;
  }

  std::size_t end_of_run(std::size_t first, std::size_t most) const {
    std::size_t last = first;
    while (last < most) {
      const std::size_t next = last + 1;
      // Backwards is no continuation.
      if (last > first && glm::dot(at(last) - at(first), at(next) - at(last)) < 0.0) return last;
      for (std::size_t k = first + 1; k < next; ++k) {
        if (!on_line(at(first), at(next), at(k))) return last;
      }
      last = next;
    }
    return last;
  }

  // The next wall after at most two points that belong to none.
  std::size_t next_wall(const std::vector<StraightRun>& runs, std::size_t k) const {
    std::size_t between = 0;
    for (std::size_t n = 1; n < runs.size(); ++n) {
      const StraightRun& run = runs[(k + n) % runs.size()];
      if (run.is_wall()) return (k + n) % runs.size();
      between += run.last - run.first + 1;
      if (between > 2) break;
    }
    return k;
  }

  std::optional<glm::dvec2> meeting(const StraightRun& a, const StraightRun& b) const {
    const glm::dvec2 along_a = glm::normalize(at(a.last) - at(a.first));
    const glm::dvec2 along_b = glm::normalize(at(b.last) - at(b.first));
    const double sine = cross2(along_a, along_b);
    constexpr double least_sine = 0.05;  // 3°: the corner of flatter angles lies far off
    if (std::abs(sine) < least_sine) return std::nullopt;
    const glm::dvec2 corner = at(a.last) + along_a * (cross2(at(b.first) - at(a.last), along_b) / sine);
    // Beyond the last point of one wall and before the first of the other, and not farther than a line of the raster
    // and its neighbour.
    const double past = glm::dot(corner - at(a.last), along_a);
    const double before = glm::dot(at(b.first) - corner, along_b);
    const double least = -2.0 * rounding_ / std::abs(sine);
    const double most = 2.0 * spacing_;
    if (past < least || before < least || past > most || before > most) return std::nullopt;
    return corner;
  }

  void find_corners(const std::vector<StraightRun>& runs) {
    corner_after_.assign(runs.size(), std::nullopt);
    begins_at_corner_.assign(runs.size(), false);
    cut_.assign(runs.size(), false);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (!runs[k].is_wall()) continue;
      const std::size_t next = next_wall(runs, k);
      if (next == k) continue;
      corner_after_[k] = meeting(runs[k], runs[next]);
      if (!corner_after_[k]) continue;
      begins_at_corner_[next] = true;
      for (std::size_t n = (k + 1) % runs.size(); n != next; n = (n + 1) % runs.size()) cut_[n] = true;
    }
  }

  const std::vector<glm::dvec2>& points_;
  double spacing_;
  double rounding_;
  std::vector<std::optional<glm::dvec2>> corner_after_;  // of each run
  std::vector<bool> begins_at_corner_;
  std::vector<bool> cut_;  // a corner takes its place
};

}  // namespace

double short_decimal(double value, double rounding) {
  constexpr int most_digits = 9;
  double factor = 1.0;
  for (int digits = 0; digits < most_digits; ++digits, factor *= 10.0) {
    const double rounded = std::round(value * factor) / factor;
    if (std::abs(rounded - value) <= rounding) return rounded;
  }
  return value;
}

std::vector<glm::dvec2> polygon_through(const std::vector<glm::dvec2>& points, double spacing, double rounding) {
  return points.size() < 3 ? points : Corners(points, spacing, rounding).polygon();
}

}  // namespace lichtmc
