#include "room/value_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "room/texture_map.hpp"

namespace lichtmc {

namespace {

// Pixels first … last along an axis.
struct PixelRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

// The pixels along one axis that an interval of texture coordinates is interpolated from; at most two ranges.
struct PixelRanges {
  std::array<PixelRange, 2> ranges;
  std::size_t count = 1;
};

std::uint32_t pixel(double index) {
  return static_cast<std::uint32_t>(index);
}

// A look-up computes its place, in pixels, with rounding errors of some 2⁻⁵² of it; this is far more.
double slack_of(double low, double high, double count) {
  return 1e-12 * (1.0 + count * std::max(std::abs(low), std::abs(high)));
}

PixelRanges pixels_of(double low, double high, std::uint32_t count, Wrap wrap) {
  const double n = count;
  const double slack = slack_of(low, high, n);
  const double first = std::floor(low * n - 0.5 - slack);
  const double last = std::floor(high * n - 0.5 + slack) + 1.0;
  if (wrap == Wrap::clamp) return {{{{pixel(std::clamp(first, 0.0, n - 1.0)), pixel(std::clamp(last, 0.0, n - 1.0))}}}};
  if (!(last - first < n - 1.0)) return {{{{0, count - 1}}}};
  const double period = wrap == Wrap::mirror ? 2.0 * n : n;
  const double a = first - period * std::floor(first / period);
  const double b = a + (last - first);
  if (b < n) return {{{{pixel(a), pixel(b)}}}};
  if (wrap == Wrap::repeat) return {{{{pixel(a), count - 1}, {0, pixel(b - n)}}}, 2};
  const auto mirrored = [n](double k) { return 2.0 * n - 1.0 - k; };
  if (a >= n && b < 2.0 * n) return {{{{pixel(mirrored(b)), pixel(mirrored(a))}}}};
  if (a < n) return {{{{pixel(std::min(a, mirrored(b))), count - 1}}}};
  return {{{{0, pixel(std::max(mirrored(a), b - 2.0 * n))}}}};
}

void widen(ValueRange& range, const ValueRange& by) {
  range.low = std::min(range.low, by.low);
  range.high = std::max(range.high, by.high);
}

constexpr ValueRange none{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

}  // namespace

ValueBounds::ValueBounds(const TextureMap& map) : map_(&map) {
  std::uint32_t columns = map.columns;
  std::uint32_t rows = map.rows;
  for (std::size_t level = 0; columns > 1 || rows > 1; ++level) {
    const std::uint32_t columns_below = columns;
    const std::uint32_t rows_below = rows;
    columns = (columns + 1) / 2;
    rows = (rows + 1) / 2;
    Level next{columns, std::vector<ValueRange>(std::size_t{columns} * rows, none)};
    for (std::uint32_t row = 0; row < rows_below; ++row) {
      for (std::uint32_t column = 0; column < columns_below; ++column)
        widen(next.blocks[std::size_t{row / 2} * columns + column / 2], at(level, column, row));
    }
    levels_.push_back(std::move(next));
  }
}

ValueRange ValueBounds::at(std::size_t level, std::uint32_t column, std::uint32_t row) const {
  if (level == 0) {
    const float value = map_->values[std::size_t{row} * map_->columns + column];
    return {value, value};
  }
  return levels_[level - 1].blocks[std::size_t{row} * levels_[level - 1].columns + column];
}

// Between the centres of four pixels the value is linear along each axis, so that a rectangle has its extreme values at
// its corners.
ValueRange ValueBounds::over(const glm::dvec2& low, const glm::dvec2& high) const {
  const ValueRange all = of_pixels(low, high);
  const glm::dvec2 count(map_->columns, map_->rows);
  double slack = 0.0;
  for (int k = 0; k < 2; ++k) {
    const double first = low[k] * count[k] - 0.5;
    const double last = high[k] * count[k] - 0.5;
    const double cell = std::floor(0.5 * (first + last));
    const double allowed = slack_of(low[k], high[k], count[k]);
    if (!(first >= cell - allowed && last <= cell + 1.0 + allowed)) return all;
    slack = std::max(slack, allowed);
  }
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const double u : {low.x, high.x}) {
    for (const double v : {low.y, high.y}) {
      const double value = value_at(*map_, u, v);
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  // Per pixel the value changes by the range of all pixels at most, along each axis. The float beyond is a bound, too.
  const double rounding = 4.0 * slack * (double{all.high} - double{all.low});
  constexpr float far = std::numeric_limits<float>::max();
  return {std::max(all.low, std::nextafter(static_cast<float>(lowest - rounding), -far)),
          std::min(all.high, std::nextafter(static_cast<float>(highest + rounding), far))};
}

ValueRange ValueBounds::of_pixels(const glm::dvec2& low, const glm::dvec2& high) const {
  const PixelRanges columns = pixels_of(low.x, high.x, map_->columns, map_->wrap_u);
  const PixelRanges rows = pixels_of(low.y, high.y, map_->rows, map_->wrap_v);
  // Blocks so large that three of them reach across every range.
  std::uint32_t longest = 0;
  for (std::size_t k = 0; k < columns.count; ++k)
    longest = std::max(longest, columns.ranges[k].last - columns.ranges[k].first);
  for (std::size_t k = 0; k < rows.count; ++k) longest = std::max(longest, rows.ranges[k].last - rows.ranges[k].first);
  std::size_t level = 0;
  while (level < levels_.size() && (longest >> level) > 2) ++level;
  ValueRange range = none;
  for (std::size_t i = 0; i < columns.count; ++i) {
    for (std::size_t j = 0; j < rows.count; ++j) {
      for (std::uint32_t row = rows.ranges[j].first >> level; row <= rows.ranges[j].last >> level; ++row) {
        for (std::uint32_t column = columns.ranges[i].first >> level; column <= columns.ranges[i].last >> level;
             ++column)
          widen(range, at(level, column, row));
      }
    }
  }
  return range;
}

}  // namespace lichtmc
