#include "walk/channel_scores.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "base/lanes.hpp"
#include "room/bounds.hpp"
#include "walk/backward.hpp"
#include "walk/channel_sums.hpp"

namespace lichtmc {

namespace {

// Cells are in many places: the memory of this many next ones is fetched before they are needed.
constexpr std::size_t prefetch_ahead = 12;

constexpr std::size_t moments = 3;  // of a group: Σ w, Σ w L, Σ w L²

// Receivers in lanes.
struct Places {
  const double* LICHTMC_APART x;
  const double* LICHTMC_APART y;
  const double* LICHTMC_APART z;
};

struct Departure {
  double x, y, z, length_m, unit, bins_per_m, last_bin;
};

// Path lengths from an impact to receivers, their bins, and the sums of w and w L^n.
LICHTMC_LANES void arrive_lanes(std::size_t n, const Departure& start, const Places& at,
                                const float* LICHTMC_APART value, double* LICHTMC_APART length,
                                std::uint32_t* LICHTMC_APART bin, double* LICHTMC_APART sum_0,
                                double* LICHTMC_APART sum_1, double* LICHTMC_APART sum_2,
                                double* LICHTMC_APART earliest) {
  const Departure from = start;
  const Places to = at;
  for (std::size_t k = 0; k < n; ++k) {
    const double dx = to.x[k] - from.x;
    const double dy = to.y[k] - from.y;
    const double dz = to.z[k] - from.z;
    const double path = from.length_m + std::sqrt(dx * dx + dy * dy + dz * dz);
    const double weight = from.unit * double{value[k]};
    const double position = path * from.bins_per_m;
    length[k] = path;
    bin[k] = static_cast<std::uint32_t>(static_cast<std::int32_t>(position < from.last_bin ? position : from.last_bin));
    sum_0[k] += weight;
    sum_1[k] += weight * path;
    sum_2[k] += weight * path * path;
    earliest[k] = weight > 0.0 && path < earliest[k] ? path : earliest[k];
  }
}

LICHTMC_LANES void add_weights(std::size_t n, double unit, const float* LICHTMC_APART value,
                               double* LICHTMC_APART sums) {
  for (std::size_t k = 0; k < n; ++k) sums[k] += unit * double{value[k]};
}

}  // namespace

ChannelScale::ChannelScale(const Room& room) : unit(0x1p-8 * BackwardScale(room).unit) {
  const Bounds bounds = bounds_of(room);
  length_m = std::exp2(std::ceil(std::log2(glm::length(bounds.high - bounds.low))));
}

ChannelScores::ChannelScores(const ChannelAxes& axes, const ChannelScale& scale, const ReferencePoint* receivers,
                             const std::vector<std::uint32_t>& order)
    : axes_(&axes), scale_(scale), number_(order), size_(order.size()), whole_(whole_lanes(size_)) {
  position_.resize(size_);
  for (auto* coordinates : {&x_, &y_, &z_}) coordinates->resize(whole_, 0.0);
  for (std::uint32_t k = 0; k < size_; ++k) {
    position_[number_[k]] = k;
    const glm::dvec3& point = receivers[number_[k]].point;
    x_[k] = point.x;
    y_[k] = point.y;
    z_[k] = point.z;
  }
  const std::size_t pairs = size_ * axes.groups;
  const std::size_t rows = pairs * axes.columns;
  cells_.resize(rows * axes.bins_of_row());
  ranges_.resize(rows);
  moments_.resize(axes.groups * moments * whole_, 0.0);
  earliest_.resize(std::size_t{axes.groups} * axes.columns * whole_, std::numeric_limits<double>::infinity());
  column_cells_.resize(rows);
  if (axes.columns > 1) column_.resize(earliest_.size(), 0.0);
  bin_.resize(whole_);
  length_.resize(whole_);
  moment_sums_.resize(pairs * jackknife_groups * moments);
  coarse_.resize(pairs * jackknife_groups * axes.coarse_bins);
  response_.resize(pairs * axes.frequency_count * 2, 0.0);
  response_sums_.resize(pairs * jackknife_groups * axes.frequency_count * 2);
  has_responded_.resize(pairs, 0);
}

void ChannelScores::begin(std::uint64_t first_round, std::size_t rounds) {
  first_round_ = first_round;
  if (arrivals_.size() < rounds) arrivals_.resize(rounds);
}

void ChannelScores::open(std::size_t r) {
  round_ = first_round_ + r;
  Arrivals& all = arrivals_[r];
  for (std::size_t k = 0; k < all.size; ++k) {
    const Arrival& one = all.list[k];
    add(position_[one.receiver], axes_->group_of_emitter[one.emitter], axes_->column_of(one.order),
        one.length_m + axes_->delay_m[one.emitter], one.irradiance);
  }
  all.size = 0;
}

std::uint32_t ChannelScores::bin_of(double length_m) const {
  const double position = length_m * axes_->bins_per_m;
  return position < axes_->bins ? static_cast<std::uint32_t>(position) : axes_->bins;
}

void ChannelScores::touch(std::size_t row, std::uint32_t bin, double irradiance) {
  Cell& cell = cells_[row * axes_->bins_of_row() + bin];
  if (cell.open == 0.0) touched_.push_back({static_cast<std::uint32_t>(row), bin});
  cell.open += irradiance;
}

void ChannelScores::add(std::size_t position, std::uint32_t group, std::uint32_t column, double length_m,
                        double irradiance) {
  const std::size_t pair = axes_->pair(position, group);
  const std::uint32_t bin = bin_of(length_m);
  dense(moments_, group, 0, moments)[position] += irradiance;
  dense(moments_, group, 1, moments)[position] += irradiance * length_m;
  dense(moments_, group, 2, moments)[position] += irradiance * length_m * length_m;
  double& earliest = dense(earliest_, group, column, axes_->columns)[position];
  earliest = std::min(earliest, length_m);
  touch(axes_->row(pair, axes_->all_column()), bin, irradiance);
  if (axes_->columns > 1) {
    dense(column_, group, column, axes_->columns)[position] += irradiance;
    touch(axes_->row(pair, column), bin, irradiance);
  }
  if (axes_->frequency_count > 0) add_response(pair, length_m, irradiance);
}

void ChannelScores::add_impact(const ImpactPath& path, std::size_t begin, std::size_t end, const float* value,
                               double unit) {
  const ChannelAxes& axes = *axes_;
  const std::uint32_t group = axes.group_of_emitter[path.emitter];
  const std::uint32_t column = axes.column_of(path.order);
  const Departure start{path.point.x, path.point.y,    path.point.z,         path.length_m,
                        unit,         axes.bins_per_m, double{1} * axes.bins};
  const std::size_t n = whole_lanes(end - begin);
  arrive_lanes(n, start, {x_.data() + begin, y_.data() + begin, z_.data() + begin}, value, length_.data(), bin_.data(),
               dense(moments_, group, 0, moments) + begin, dense(moments_, group, 1, moments) + begin,
               dense(moments_, group, 2, moments) + begin, dense(earliest_, group, column, axes.columns) + begin);
  const std::size_t stride = axes.bins_of_row() * axes.columns * axes.groups;
  Cell* cells = cells_.data() + axes.row(axes.pair(begin, group), axes.all_column()) * axes.bins_of_row();
  auto row = static_cast<std::uint32_t>(axes.row(axes.pair(begin, group), axes.all_column()));
  for (std::size_t k = 0; k < end - begin; ++k) {
    const std::size_t ahead = std::min(k + prefetch_ahead, end - begin - 1);
    if (value[ahead] > 0.0F) __builtin_prefetch(&cells[ahead * stride + bin_[ahead]], 1);
    if (value[k] > 0.0F) {
      Cell& cell = cells[k * stride + bin_[k]];
      if (cell.open == 0.0) touched_.push_back({row, bin_[k]});
      cell.open += unit * double{value[k]};
    }
    row += axes.columns * axes.groups;
  }
  if (axes.columns > 1) {
    add_weights(n, unit, value, dense(column_, group, column, axes.columns) + begin);
    for (std::size_t k = 0; k < end - begin; ++k) {
      if (value[k] > 0.0F) touch(axes.row(axes.pair(begin + k, group), column), bin_[k], unit * double{value[k]});
    }
  }
  if (axes.frequency_count == 0) return;
  for (std::size_t k = 0; k < end - begin; ++k) {
    if (value[k] > 0.0F) add_response(axes.pair(begin + k, group), length_[k], unit * double{value[k]});
  }
}

namespace {

// Adds w exp(−2πi f t) at evenly spaced frequencies. Four phasors in turn, each multiplied by that of four steps.
void add_phasors(std::size_t n, double weight, double phase_0, double step, double* LICHTMC_APART real,
                 double* LICHTMC_APART imaginary) {
  constexpr std::size_t lanes = 4;
  double c[lanes];
  double s[lanes];
  for (std::size_t l = 0; l < lanes; ++l) {
    c[l] = weight * std::cos(phase_0 + static_cast<double>(l) * step);
    s[l] = weight * std::sin(phase_0 + static_cast<double>(l) * step);
  }
  const double turn_c = std::cos(static_cast<double>(lanes) * step);
  const double turn_s = std::sin(static_cast<double>(lanes) * step);
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) {
      real[k + l] += c[l];
      imaginary[k + l] += s[l];
      const double next = c[l] * turn_c - s[l] * turn_s;
      s[l] = c[l] * turn_s + s[l] * turn_c;
      c[l] = next;
    }
  }
  for (std::size_t l = 0; k + l < n; ++l) {
    real[k + l] += c[l];
    imaginary[k + l] += s[l];
  }
}

}  // namespace

void ChannelScores::add_response(std::size_t pair, double length_m, double irradiance) {
  if (has_responded_[pair] == 0) {
    has_responded_[pair] = 1;
    responded_.push_back(static_cast<std::uint32_t>(pair));
  }
  const std::size_t n = axes_->frequency_count;
  const double angle = -2.0 * std::numbers::pi * length_m / speed_of_light;
  double* real = response_.data() + pair * n * 2;
  add_phasors(n, irradiance, angle * axes_->frequencies.first_hz, angle * axes_->frequencies.step_hz, real, real + n);
}

std::uint64_t ChannelScores::units(double irradiance) {
  const double units = irradiance / scale_.unit;
  if (units < ChannelScale::largest_score) return static_cast<std::uint64_t>(units + 0.5);
  ++capped_;
  return static_cast<std::uint64_t>(ChannelScale::largest_score);
}

// Moments of second order may exceed 64 bits.
uint128 ChannelScores::wide_units(double moment) {
  constexpr double largest = 0x1p100;
  return static_cast<uint128>(std::min(moment / scale_.unit, largest) + 0.5);
}

void ChannelScores::close() {
  const auto jackknife = static_cast<std::uint32_t>(round_ % jackknife_groups);
  const std::uint32_t all = axes_->all_column();
  for (std::size_t k = 0; k < touched_.size(); ++k) {
    const Touched& ahead = touched_[std::min(k + prefetch_ahead, touched_.size() - 1)];
    __builtin_prefetch(&cells_[ahead.row * axes_->bins_of_row() + ahead.bin], 1);
    const Touched& one = touched_[k];
    Cell& cell = cells_[one.row * axes_->bins_of_row() + one.bin];
    const std::uint64_t score = units(cell.open);
    cell.open = 0.0;
    cell.add(score);
    Range& range = ranges_[one.row];
    range.low = std::min(range.low, one.bin);
    range.high = std::max(range.high, one.bin);
    if (one.bin == axes_->bins || one.row % axes_->columns != all) continue;
    const std::size_t pair = one.row / axes_->columns;
    coarse_[(pair * jackknife_groups + jackknife) * axes_->coarse_bins + (one.bin >> axes_->coarse_shift)] += score;
  }
  touched_.clear();
  close_moments(jackknife);
  if (axes_->frequency_count > 0) close_response(jackknife);
}

void ChannelScores::close_moments(std::uint32_t jackknife) {
  for (std::uint32_t group = 0; group < axes_->groups; ++group) {
    double factor = 1.0;
    for (std::size_t which = 0; which < moments; ++which) {
      double* of_round = dense(moments_, group, which, moments);
      for (std::size_t k = 0; k < size_; ++k) {
        if (of_round[k] == 0.0) continue;
        const std::size_t pair = axes_->pair(k, group);
        moment_sums_[(pair * jackknife_groups + jackknife) * moments + which] += wide_units(of_round[k] * factor);
        if (which == 0) column_cells_[axes_->row(pair, axes_->all_column())].add(units(of_round[k]));
        of_round[k] = 0.0;
      }
      factor /= scale_.length_m;
    }
    for (std::uint32_t column = 0; column < axes_->all_column(); ++column) {
      double* of_round = dense(column_, group, column, axes_->columns);
      for (std::size_t k = 0; k < size_; ++k) {
        if (of_round[k] == 0.0) continue;
        column_cells_[axes_->row(axes_->pair(k, group), column)].add(units(of_round[k]));
        of_round[k] = 0.0;
      }
    }
  }
}

void ChannelScores::close_response(std::uint32_t jackknife) {
  const std::size_t n = axes_->frequency_count;
  for (const std::uint32_t pair : responded_) {
    double* of_round = response_.data() + pair * n * 2;
    int128* sums = response_sums_.data() + (pair * jackknife_groups + jackknife) * n * 2;
    for (std::size_t f = 0; f < n; ++f) {
      sums[2 * f] += static_cast<int128>(std::nearbyint(of_round[f] / scale_.unit));
      sums[2 * f + 1] += static_cast<int128>(std::nearbyint(of_round[n + f] / scale_.unit));
    }
    std::fill_n(of_round, n * 2, 0.0);
    has_responded_[pair] = 0;
  }
  responded_.clear();
}

namespace {

// Adds some sums to others and clears them.
template <class Own, class Other>
void move_all(std::vector<Own>& from, std::size_t from_first, std::vector<Other>& to, std::size_t to_first,
              std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    to[to_first + i] += from[from_first + i];
    from[from_first + i] = 0;
  }
}

void move_cell(ChannelScores::Cell& from, BackwardSums& to) {
  to.sum += from.sum;
  to.squares += from.squares;
  from = {};
}

}  // namespace

void ChannelScores::hand_over(std::size_t first, ChannelSums& sums, std::uint64_t& capped) {
  for (std::size_t k = 0; k < size_; ++k) {
    for (std::uint32_t group = 0; group < axes_->groups; ++group) {
      for (std::uint32_t column = 0; column < axes_->columns; ++column) hand_over_row(k, group, column, first, sums);
      hand_over_groups(axes_->pair(k, group), axes_->pair(first + number_[k], group), sums);
    }
  }
  capped += std::exchange(capped_, 0);
}

void ChannelScores::hand_over_row(std::size_t position, std::uint32_t group, std::uint32_t column, std::size_t first,
                                  ChannelSums& sums) {
  const std::size_t from = axes_->row(axes_->pair(position, group), column);
  const std::size_t to = axes_->row(axes_->pair(first + number_[position], group), column);
  Cell* cells = cells_.data() + from * axes_->bins_of_row();
  BackwardSums* bins = sums.bins.data() + to * axes_->bins_of_row();
  const Range range = std::exchange(ranges_[from], {});
  for (std::size_t b = range.low; b <= range.high; ++b) move_cell(cells[b], bins[b]);
  move_cell(column_cells_[from], sums.columns[to]);
  double& earliest = dense(earliest_, group, column, axes_->columns)[position];
  sums.earliest[to] += Earliest{std::bit_cast<std::uint64_t>(earliest)};
  earliest = std::numeric_limits<double>::infinity();
}

void ChannelScores::hand_over_groups(std::size_t from, std::size_t to, ChannelSums& sums) {
  for (std::size_t j = 0; j < jackknife_groups; ++j) {
    MomentSums& all = sums.moments[to * jackknife_groups + j];
    uint128* own = moment_sums_.data() + (from * jackknife_groups + j) * moments;
    all.weight += std::exchange(own[0], 0);
    all.first += std::exchange(own[1], 0);
    all.second += std::exchange(own[2], 0);
  }
  const std::size_t coarse = std::size_t{jackknife_groups} * axes_->coarse_bins;
  move_all(coarse_, from * coarse, sums.coarse, to * coarse, coarse);
  const std::size_t response = std::size_t{jackknife_groups} * axes_->frequency_count * 2;
  move_all(response_sums_, from * response, sums.response, to * response, response);
}

}  // namespace lichtmc
