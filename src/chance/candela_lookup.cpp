#include "chance/candela_lookup.hpp"

#include <algorithm>
#include <cmath>

#include "base/lanes.hpp"
#include "chance/lane_math.hpp"

namespace lichtmc {

namespace {

constexpr double most_bins = 65536.0;
constexpr double degrees = 1.0 / radians_per_degree;

// How a direction is turned into the angles of the table.
struct Turn {
  bool mirror_x, mirror_y, mirror_z;
  double side_x;
  double offset;        // ψ of the vertical angle 0
  double from, period;  // type C: the first horizontal angle, 360°; else 0
};

Turn turn_of(const CandelaTable::Grid& grid, const Mirrors& mirrors) {
  const bool type_c = grid.type == PhotometricType::c;
  return {
      mirrors.x,           mirrors.y, mirrors.z, mirrors.side_x, polar_offset_deg(grid), grid.horizontal_deg.front(),
      type_c ? 360.0 : 0.0};
}

// The vertical and the horizontal angle of a polar vector, in degrees.
inline void angles_of(const Turn& turn, double px, double py, double pz, double& vertical, double& horizontal) {
  const double x = turn.mirror_x ? turn.side_x * std::abs(px) : px;
  const double y = turn.mirror_y ? std::abs(py) : py;
  const double z = turn.mirror_z ? -std::abs(pz) : pz;
  vertical = lane_atan2(std::sqrt(x * x + y * y), z) * degrees - turn.offset;
  const double around = lane_atan2(y, x) * degrees;
  const double below = around < turn.from - table_rounding_deg ? turn.period : 0.0;
  const double above = around > turn.from + turn.period + table_rounding_deg ? turn.period : 0.0;
  horizontal = around + (turn.period > 0.0 ? below - above : 0.0);
}

}  // namespace

CandelaLookup::Angles::Angles(const std::vector<double>& angles)
    : first(angles.front()), last(angles.back()), from(angles) {
  if (angles.size() == 1) {
    guide = {0, 0};
    from.push_back(first + 360.0);
    last = from.back();
  }
  double narrowest = last - first;
  for (std::size_t k = 0; k + 1 < from.size(); ++k) {
    narrowest = std::min(narrowest, from[k + 1] - from[k]);
    per_degree.push_back(1.0 / (from[k + 1] - from[k]));
  }
  const double bins = std::min(most_bins, std::ceil((last - first) / narrowest * 1.000001));
  bins_per_degree = bins / (last - first);
  one_step = bins < most_bins;
  guide.clear();
  std::uint32_t k = 0;
  for (double bin = 0.0; bin <= bins; ++bin) {
    const double at = first + bin / bins_per_degree;
    while (k + 2 < from.size() && from[k + 1] <= at) ++k;
    guide.push_back(k);
  }
}

CandelaLookup::CandelaLookup(const CandelaTable::Grid& grid)
    : grid_(&grid),
      mirrors_(mirrors_of(grid)),
      vertical_(grid.vertical_deg),
      horizontal_(grid.horizontal_deg),
      next_plane_(grid.horizontal_deg.size() == 1 ? 0 : grid.vertical_deg.size()) {}

double CandelaLookup::candela(const glm::dvec3& direction) const {
  const glm::dvec3 p = to_polar(*grid_, direction);
  double vertical = 0.0;
  double horizontal = 0.0;
  angles_of(turn_of(*grid_, mirrors_), p.x, p.y, p.z, vertical, horizontal);
  const auto misses = [](const Angles& angles, double at) {
    return at < angles.first - table_rounding_deg || at > angles.last + table_rounding_deg;
  };
  const bool all_round = grid_->type == PhotometricType::c;
  if (misses(vertical_, vertical) || (!all_round && misses(horizontal_, horizontal))) return 0.0;
  const auto locate = [](const Angles& angles, double at, double& fraction) {
    const double within = std::clamp(at, angles.first, angles.last);
    std::size_t k = angles.guide[static_cast<std::size_t>((within - angles.first) * angles.bins_per_degree)];
    while (k + 2 < angles.from.size() && angles.from[k + 1] <= within) ++k;
    fraction = (within - angles.from[k]) * angles.per_degree[k];
    return k;
  };
  double along = 0.0;
  double across = 0.0;
  const std::size_t row = locate(vertical_, vertical, along);
  const std::size_t plane = next_plane_ == 0 ? 0 : locate(horizontal_, horizontal, across);
  const double* values = &grid_->candela[plane * next_plane_ + row];
  const double first = values[0] + along * (values[1] - values[0]);
  const double second = values[next_plane_] + along * (values[next_plane_ + 1] - values[next_plane_]);
  return first + across * (second - first);
}

namespace {

struct Guide {
  double first, last, bins_per_degree;
  const std::uint32_t* guide;
  const double* from;
  const double* per_degree;
  std::uint32_t last_interval;
};

LICHTMC_LANES void look_up(std::size_t n, const Turn& turn, const Guide& vertical, const Guide& horizontal,
                           const double* LICHTMC_APART values, std::uint32_t next_plane, double all_round,
                           const double* LICHTMC_APART px, double sign_x, const double* LICHTMC_APART py, double sign_y,
                           const double* LICHTMC_APART pz, double sign_z, double* LICHTMC_APART candela) {
  const std::uint32_t* LICHTMC_APART v_guide = vertical.guide;
  const std::uint32_t* LICHTMC_APART h_guide = horizontal.guide;
  const double* LICHTMC_APART v_from = vertical.from;
  const double* LICHTMC_APART h_from = horizontal.from;
  const double* LICHTMC_APART v_per = vertical.per_degree;
  const double* LICHTMC_APART h_per = horizontal.per_degree;
  const Turn turned = turn;
  const double v_first = vertical.first, v_last = vertical.last, v_bins = vertical.bins_per_degree;
  const double h_first = horizontal.first, h_last = horizontal.last, h_bins = horizontal.bins_per_degree;
  const std::uint32_t v_most = vertical.last_interval;
  const std::uint32_t h_most = horizontal.last_interval;
  for (std::size_t i = 0; i < n; ++i) {
    double v = 0.0;
    double h = 0.0;
    angles_of(turned, sign_x * px[i], sign_y * py[i], sign_z * pz[i], v, h);
    const bool v_inside = v >= v_first - table_rounding_deg && v <= v_last + table_rounding_deg;
    const bool h_inside = h >= h_first - table_rounding_deg - all_round && h <= h_last + table_rounding_deg + all_round;
    const double v_at = v < v_first ? v_first : (v > v_last ? v_last : v);
    const double h_at = h < h_first ? h_first : (h > h_last ? h_last : h);
    const std::uint32_t v_guess = v_guide[static_cast<std::int32_t>((v_at - v_first) * v_bins)];
    const std::uint32_t h_guess = h_guide[static_cast<std::int32_t>((h_at - h_first) * h_bins)];
    const std::uint32_t v_k = v_guess + (v_guess < v_most && v_from[v_guess + 1] <= v_at ? 1U : 0U);
    const std::uint32_t h_k = h_guess + (h_guess < h_most && h_from[h_guess + 1] <= h_at ? 1U : 0U);
    const double along = (v_at - v_from[v_k]) * v_per[v_k];
    const double across = (h_at - h_from[h_k]) * h_per[h_k];
    const std::uint32_t place = h_k * next_plane + v_k;
    const double first = values[place] + along * (values[place + 1] - values[place]);
    const double second =
        values[place + next_plane] + along * (values[place + next_plane + 1] - values[place + next_plane]);
    const double value = first + across * (second - first);
    candela[i] = v_inside && h_inside ? value : 0.0;
  }
}

}  // namespace

void CandelaLookup::candela(std::size_t n, const double* x, const double* y, const double* z, double* candela) const {
  if (!vertical_.one_step || !horizontal_.one_step) {
    for (std::size_t i = 0; i < n; ++i) candela[i] = this->candela({x[i], y[i], z[i]});
    return;
  }
  // Which component of a direction is which of the polar vector, and its sign.
  const glm::dvec3 of_x = to_polar(*grid_, {1.0, 0.0, 0.0});
  const glm::dvec3 of_y = to_polar(*grid_, {0.0, 1.0, 0.0});
  const glm::dvec3 of_z = to_polar(*grid_, {0.0, 0.0, 1.0});
  const auto source = [&](int k) { return of_x[k] != 0.0 ? x : (of_y[k] != 0.0 ? y : z); };
  const auto sign = [&](int k) { return of_x[k] + of_y[k] + of_z[k]; };
  const auto guide = [](const Angles& angles) {
    return Guide{angles.first,
                 angles.last,
                 angles.bins_per_degree,
                 angles.guide.data(),
                 angles.from.data(),
                 angles.per_degree.data(),
                 static_cast<std::uint32_t>(angles.from.size() - 2)};
  };
  look_up(n, turn_of(*grid_, mirrors_), guide(vertical_), guide(horizontal_), grid_->candela.data(),
          static_cast<std::uint32_t>(next_plane_), grid_->type == PhotometricType::c ? 1e3 : 0.0, source(0), sign(0),
          source(1), sign(1), source(2), sign(2), candela);
}

}  // namespace lichtmc
