#include "lichtmc/intensity_cut.hpp"

#include <algorithm>
#include <cmath>

#include <glm/vec3.hpp>

#include "chance/candela_grid.hpp"

namespace lichtmc {

namespace {

// The angles at which the slope of the intensity may change.
std::vector<double> corners_of(const CandelaTable::Grid& grid) {
  std::vector<double> corners{-180.0, -90.0, 0.0, 90.0, 180.0};
  const auto add = [&corners](double angle) {
    if (angle <= 180.0) corners.insert(corners.end(), {angle, -angle});
  };
  for (const double vertical : grid.vertical_deg) add(std::abs(vertical));
  if (grid.type != PhotometricType::c) {
    for (const double vertical : grid.vertical_deg) add(180.0 - std::abs(vertical));  // behind: H = 180°
    for (const double horizontal : grid.horizontal_deg) add(std::abs(horizontal));
  }
  std::sort(corners.begin(), corners.end());
  // Differences by rounding would make intervals without a middle.
  constexpr double rounding_deg = 1e-9;
  const auto end = std::unique(corners.begin(), corners.end(), [](double a, double b) { return b - a < rounding_deg; });
  corners.erase(end, corners.end());
  corners.back() = 180.0;
  return corners;
}

}  // namespace

IntensityCut intensity_cut(const CandelaTable& table, double plane_deg) {
  const double plane = plane_deg * radians_per_degree;
  // The planes 0 and 90 exactly: directions beside them would be beside the edge of some tables.
  const double x = plane_deg == 90.0 ? 0.0 : std::cos(plane);
  const double y = plane_deg == 0.0 ? 0.0 : std::sin(plane);
  const auto at = [&](double angle_deg) {
    const double angle = angle_deg * radians_per_degree;
    return table.candela(glm::dvec3(x * std::sin(angle), y * std::sin(angle), std::cos(angle)));
  };
  IntensityCut cut;
  const std::vector<double> corners = corners_of(table.grid());
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    // Two points within the interval, where it is linear, give its ends: at the corners themselves a step, and planes
    // that differ at a pole, would have one value only.
    const double first = at(0.75 * corners[k] + 0.25 * corners[k + 1]);
    const double last = at(0.25 * corners[k] + 0.75 * corners[k + 1]);
    const double from = std::max(0.0, 1.5 * first - 0.5 * last);
    const double to = std::max(0.0, 1.5 * last - 0.5 * first);
    constexpr double rounding = 1e-12;
    if (cut.empty() || std::abs(cut.back().candela - from) > rounding * std::max(cut.back().candela, from))
      cut.push_back({corners[k], from});
    cut.push_back({corners[k + 1], to});
  }
  return cut;
}

IntensityPoint highest_of(const IntensityCut& cut) {
  constexpr double equal = 1.0 - 1e-9;  // mirrored peaks differ by rounding
  double highest = 0.0;
  for (const IntensityPoint& point : cut) highest = std::max(highest, point.candela);
  IntensityPoint best{0.0, highest};
  bool found = false;
  for (const IntensityPoint& point : cut) {
    if (point.candela < equal * highest) continue;
    const double gap = std::abs(point.angle_deg) - std::abs(best.angle_deg);
    if (!found || gap < -1e-9 || (gap <= 1e-9 && point.angle_deg > best.angle_deg)) best.angle_deg = point.angle_deg;
    found = true;
  }
  return best;
}

namespace {

// Where the intensity falls below a level, from a point on, in one direction round the cut; the distance in degrees,
// 360 if it does not.
double distance_above(const IntensityCut& cut, std::size_t start, int step, double level) {
  const std::size_t n = cut.size();
  double gone = 0.0;
  std::size_t at = start;
  for (std::size_t k = 0; k < n && gone < 360.0; ++k) {
    // The first point and the last one have the same direction.
    const std::size_t next = step > 0 ? (at + 1) % n : (at + n - 1) % n;
    const bool turns = (step > 0 && next == 0) || (step < 0 && at == 0);
    const double length = turns ? 0.0 : std::abs(cut[next].angle_deg - cut[at].angle_deg);
    if (cut[next].candela < level) {
      const double share = (cut[at].candela - level) / (cut[at].candela - cut[next].candela);
      return gone + share * length;
    }
    gone += length;
    at = next;
  }
  return 360.0;
}

}  // namespace

BeamWidth beam_width(const IntensityCut& cut, double share) {
  const IntensityPoint highest = highest_of(cut);
  if (!(highest.candela > 0.0)) return {0.0, 0.0, 0};
  // Values that equal the level, on a plateau, are above it whatever their rounding.
  constexpr double rounding = 1e-11;
  const double level = share * highest.candela * (1.0 - rounding);
  std::size_t start = 0;
  for (std::size_t k = 0; k < cut.size(); ++k) {
    const bool here = cut[k].angle_deg == highest.angle_deg;
    if (here && (cut[start].angle_deg != highest.angle_deg || cut[k].candela > cut[start].candela)) start = k;
  }
  const double before = distance_above(cut, start, -1, level);
  const double after = distance_above(cut, start, 1, level);
  if (before >= 360.0 || after >= 360.0) return {};
  std::size_t falls = 0;
  for (std::size_t k = 0; k < cut.size(); ++k) {
    const double next = cut[(k + 1) % cut.size()].candela;
    if (cut[k].candela >= level && next < level) ++falls;
  }
  return {highest.angle_deg - before, highest.angle_deg + after, falls};
}

}  // namespace lichtmc
