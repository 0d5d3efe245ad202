#include "view/isolines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>

namespace lichtmc {

namespace {

// Convolves a row or column with a Gaussian, in place.
void blur(std::vector<double>& line, const std::vector<double>& kernel, std::vector<double>& result) {
  const auto n = static_cast<std::ptrdiff_t>(line.size());
  const auto reach = static_cast<std::ptrdiff_t>(kernel.size()) - 1;
  result.assign(line.size(), 0.0);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(-reach, -i); k <= std::min(reach, n - 1 - i); ++k)
      result[static_cast<std::size_t>(i)] +=
          kernel[static_cast<std::size_t>(std::abs(k))] * line[static_cast<std::size_t>(i + k)];
  }
  line.swap(result);
}

void blur_both_ways(std::vector<double>& values, std::size_t columns, std::size_t rows,
                    const std::vector<double>& kernel) {
  std::vector<double> line;
  std::vector<double> spare;
  for (std::size_t y = 0; y < rows; ++y) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(y * columns);
    line.assign(begin, begin + static_cast<std::ptrdiff_t>(columns));
    blur(line, kernel, spare);
    std::copy(line.begin(), line.end(), begin);
  }
  for (std::size_t x = 0; x < columns; ++x) {
    line.resize(rows);
    for (std::size_t y = 0; y < rows; ++y) line[y] = values[y * columns + x];
    blur(line, kernel, spare);
    for (std::size_t y = 0; y < rows; ++y) values[y * columns + x] = line[y];
  }
}

// A line segment ends on edges of the grid. Number of an edge: 2 · (number of its point), + 1 for the edge downwards.
using EdgeNumber = std::size_t;

struct Segment {
  EdgeNumber from = 0;
  EdgeNumber to = 0;
};

class MarchingSquares {
 public:
  MarchingSquares(const IrradianceField& field, double level) : field_(&field), level_(level) {
    for (std::size_t y = 0; y + 1 < field.rows; ++y) {
      for (std::size_t x = 0; x + 1 < field.columns; ++x) cross_square(x, y);
    }
  }

  std::vector<Isoline> lines() {
    std::vector<Isoline> lines;
    std::vector<bool> used(segments_.size());
    for (std::size_t p = 0; p < segments_.size(); ++p) {
      if (used[p]) continue;
      used[p] = true;
      std::deque<EdgeNumber> chain{segments_[p].from, segments_[p].to};
      while (extend(chain.back(), used, [&](EdgeNumber e) { chain.push_back(e); })) {
      }
      while (extend(chain.front(), used, [&](EdgeNumber e) { chain.push_front(e); })) {
      }
      Isoline& line = lines.emplace_back();
      line.level = level_;
      for (const EdgeNumber edge : chain) line.points.push_back(place(edge));
    }
    return lines;
  }

 private:
  bool above(std::size_t point) const { return field_->values[point] >= level_; }

  void cross_square(std::size_t x, std::size_t y) {
    const std::size_t columns = field_->columns;
    const std::array<std::size_t, 4> corner{y * columns + x, y * columns + x + 1, (y + 1) * columns + x + 1,
                                            (y + 1) * columns + x};
    for (const std::size_t c : corner) {
      if (!(field_->weight[c] > 0.0)) return;
    }
    const std::array<EdgeNumber, 4> edge{2 * corner[0], 2 * corner[1] + 1, 2 * corner[3], 2 * corner[0] + 1};
    std::array<EdgeNumber, 4> crossed{};
    std::size_t n = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (above(corner[k]) != above(corner[(k + 1) % 4])) crossed[n++] = edge[k];
    }
    if (n == 2) add(crossed[0], crossed[1]);
    if (n != 4) return;
    double mean = 0.0;
    for (const std::size_t c : corner) mean += 0.25 * field_->values[c];
    // A saddle: the mean belongs to corners 0 and 2, or to corners 1 and 3; the lines separate the other two.
    const bool cut_1_and_3 = (mean >= level_) == above(corner[0]);
    add(crossed[0], crossed[cut_1_and_3 ? 1 : 3]);
    add(crossed[2], crossed[cut_1_and_3 ? 3 : 1]);
  }

  void add(EdgeNumber a, EdgeNumber b) {
    at_[a].push_back(segments_.size());
    at_[b].push_back(segments_.size());
    segments_.push_back({a, b});
  }

  template <class Take>
  bool extend(EdgeNumber end, std::vector<bool>& used, const Take& take) {
    for (const std::size_t p : at_[end]) {
      if (used[p]) continue;
      used[p] = true;
      take(segments_[p].from == end ? segments_[p].to : segments_[p].from);
      return true;
    }
    return false;
  }

  glm::dvec2 place(EdgeNumber edge) const {
    const std::size_t columns = field_->columns;
    const std::size_t a = edge / 2;
    const std::size_t b = edge % 2 == 0 ? a + 1 : a + columns;
    const double share = (level_ - field_->values[a]) / (field_->values[b] - field_->values[a]);
    const std::size_t row = a / columns;
    const glm::dvec2 start(static_cast<double>(a % columns), static_cast<double>(row));
    return edge % 2 == 0 ? start + glm::dvec2(share, 0.0) : start + glm::dvec2(0.0, share);
  }

  const IrradianceField* field_;
  double level_;
  std::vector<Segment> segments_;
  std::map<EdgeNumber, std::vector<std::size_t>> at_;  // segments that end on an edge
};

}  // namespace

IrradianceField smoothed(const IrradianceField& field, double radius) {
  std::vector<double> kernel;
  for (int k = 0; k <= std::max(1.0, 3.0 * radius); ++k) kernel.push_back(std::exp(-0.5 * k * k / (radius * radius)));
  IrradianceField result = field;
  for (std::size_t k = 0; k < field.values.size(); ++k)
    result.values[k] = field.weight[k] > 0.0 ? field.weight[k] * field.values[k] : 0.0;
  std::vector<double> weight = field.weight;
  blur_both_ways(result.values, field.columns, field.rows, kernel);
  blur_both_ways(weight, field.columns, field.rows, kernel);
  for (std::size_t k = 0; k < weight.size(); ++k)
    result.values[k] = weight[k] > 0.0 ? result.values[k] / weight[k] : 0.0;
  return result;
}

std::vector<double> round_levels(double low, double high, bool logarithmic) {
  std::vector<double> levels;
  if (logarithmic) {
    // At most two decades: below, the lines would be too close to each other.
    const double least = std::max(low, 0.01 * high);
    for (int exponent = static_cast<int>(std::floor(std::log10(least))); std::pow(10.0, exponent) < high; ++exponent) {
      const double decade = std::pow(10.0, exponent);
      for (const double step : {1.0, 2.0, 5.0}) {
        if (step * decade > least && step * decade < high) levels.push_back(step * decade);
      }
    }
    return levels;
  }
  const double rough = (high - low) / 6.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = decade * (rough > 5.0 * decade ? 10.0 : rough > 2.0 * decade ? 5.0 : rough > decade ? 2.0 : 1.0);
  for (double k = std::floor(low / step) + 1.0; k * step < high; k += 1.0) levels.push_back(k * step);
  return levels;
}

std::vector<Isoline> lines_of(const IrradianceField& field, double level) {
  return MarchingSquares(field, level).lines();
}

}  // namespace lichtmc
