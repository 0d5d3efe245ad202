#include "lichtmc/candela_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/message.hpp"
#include "chance/candela_grid.hpp"
#include "chance/candela_lookup.hpp"
#include "chance/candela_sampler.hpp"
#include "chance/candela_zones.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

constexpr double pi = std::numbers::pi;

// The flux of a cell, in lm.
double cell_flux(const CandelaTable::Grid& grid, std::size_t j, std::size_t next, std::size_t i, double width) {
  const double from = (grid.vertical_deg[i] + polar_offset_deg(grid)) * radians_per_degree;
  const double to = (grid.vertical_deg[i + 1] + polar_offset_deg(grid)) * radians_per_degree;
  const double middle = 0.5 * (from + to);
  return width * weighted_interval(0.5 * (value(grid, j, i) + value(grid, next, i)),
                                   0.5 * (value(grid, j, i + 1) + value(grid, next, i + 1)), std::sin(middle),
                                   std::cos(middle), 0.5 * (to - from));
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("A candela table cannot be used: " + what +
                   " Give angles and values as lichtmc/candela_table.hpp says.");
}

}  // namespace

std::string_view name_of(PhotometricType type) {
  switch (type) {
    case PhotometricType::c:
      return "C";
    case PhotometricType::b:
      return "B";
    case PhotometricType::a:
      return "A";
  }
  return "";
}

std::string_view name_of(PhotometricSymmetry symmetry) {
  switch (symmetry) {
    case PhotometricSymmetry::none:
      return "none";
    case PhotometricSymmetry::rotational:
      return "rotational";
    case PhotometricSymmetry::c0_c180:
      return "C0-C180";
    case PhotometricSymmetry::c90_c270:
      return "C90-C270";
    case PhotometricSymmetry::quadrants:
      return "quadrants";
    case PhotometricSymmetry::horizontal:
      return "H";
    case PhotometricSymmetry::vertical:
      return "V";
    case PhotometricSymmetry::both:
      return "H and V";
  }
  return "";
}

CandelaTable::CandelaTable(Grid grid) : grid_(std::move(grid)) {
  check();
  for_each_cell(grid_, [this](std::size_t j, std::size_t next, std::size_t i, double width) {
    flux_ += cell_flux(grid_, j, next, i, width);
  });
  flux_ *= mirrors_of(grid_).copies();
  if (!(flux_ > 0.0) || !std::isfinite(flux_))
    refuse("its flux is " + to_text(flux_) + " lm (allowed: a finite number above 0).");
  find_peak();
  find_extent();
  find_ends();
  lookup_ = std::make_unique<CandelaLookup>(grid_);
}

CandelaTable::~CandelaTable() = default;

void CandelaTable::check() const {
  const auto check_angles = [](const std::vector<double>& angles, double low, double high, const char* which) {
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const bool rises = k == 0 || angles[k] > angles[k - 1];
      if (!rises || !(angles[k] >= low && angles[k] <= high))
        refuse(std::string(which) + " angle " + std::to_string(k + 1) + " is " + to_text(angles[k]) +
               "° (allowed: rising, " + to_text(low) + " to " + to_text(high) + "°).");
    }
  };
  const bool type_c = grid_.type == PhotometricType::c;
  const std::size_t planes = grid_.horizontal_deg.size();
  const bool rotational = grid_.symmetry == PhotometricSymmetry::rotational;
  const bool by_type =
      type_c ? grid_.symmetry <= PhotometricSymmetry::quadrants
             : grid_.symmetry == PhotometricSymmetry::none || grid_.symmetry >= PhotometricSymmetry::horizontal;
  if (!by_type) refuse("its symmetry is not one of its type.");
  if (grid_.vertical_deg.size() < 2) refuse("it has fewer than 2 vertical angles.");
  if (planes == 0 || (planes == 1) != rotational) refuse("it has one plane, and only then, if it is rotational.");
  if (grid_.candela.size() != planes * grid_.vertical_deg.size())
    refuse("its number of values is not that of its angles.");
  check_angles(grid_.vertical_deg, type_c ? 0.0 : -90.0, type_c ? 180.0 : 90.0, "vertical");
  check_angles(grid_.horizontal_deg, -360.0, 720.0, "horizontal");
  if (grid_.symmetry == PhotometricSymmetry::none && type_c &&
      std::abs(grid_.horizontal_deg.back() - grid_.horizontal_deg.front() - 360.0) > table_rounding_deg)
    refuse("its planes do not cover 360°.");
  for (const double candela : grid_.candela) {
    if (!(candela >= 0.0) || !std::isfinite(candela))
      refuse("an intensity is " + to_text(candela) + " cd (allowed: a finite number, 0 or more).");
  }
}

double CandelaTable::candela(const glm::dvec3& direction) const {
  return lookup_->candela(direction);
}

void CandelaTable::candela(std::size_t n, const double* x, const double* y, const double* z, double* candela) const {
  lookup_->candela(n, x, y, z, candela);
}

double CandelaTable::flux_towards_aim() const {
  // The part of the table on that side: of type C by γ, of the others by H.
  if (grid_.type == PhotometricType::c) return flux_between(grid_, 0.0, 90.0);
  double sum = 0.0;
  for_each_cell(grid_, [&](std::size_t j, std::size_t next, std::size_t i, double /*width*/) {
    // |H| ≤ 90° within the cell: the values at its ends, by the same interpolation.
    const double from = std::clamp(grid_.horizontal_deg[j], -90.0, 90.0);
    const double to = std::clamp(grid_.horizontal_deg[next], -90.0, 90.0);
    if (!(to > from)) return;
    const double whole = grid_.horizontal_deg[next] - grid_.horizontal_deg[j];
    const double place = (0.5 * (from + to) - grid_.horizontal_deg[j]) / whole;
    const auto mean_of = [&](std::size_t row) {
      return value(grid_, j, row) + place * (value(grid_, next, row) - value(grid_, j, row));
    };
    const double low = (grid_.vertical_deg[i] + 90.0) * radians_per_degree;
    const double high = (grid_.vertical_deg[i + 1] + 90.0) * radians_per_degree;
    const double middle = 0.5 * (low + high);
    sum += (to - from) * radians_per_degree *
           weighted_interval(mean_of(i), mean_of(i + 1), std::sin(middle), std::cos(middle), 0.5 * (high - low));
  });
  return sum * mirrors_of(grid_).copies();
}

void CandelaTable::find_peak() {
  const auto highest = std::max_element(grid_.candela.begin(), grid_.candela.end());
  const auto place = static_cast<std::size_t>(highest - grid_.candela.begin());
  const std::size_t rows = grid_.vertical_deg.size();
  peak_ = {*highest, grid_.horizontal_deg[place / rows], grid_.vertical_deg[place % rows]};
  if (grid_.type != PhotometricType::c) return;
  const auto turned = [](double angle) {
    return angle < 0.0 ? angle + 360.0 : (angle >= 360.0 ? angle - 360.0 : angle);
  };
  const double own = turned(peak_.horizontal_deg);
  peak_.horizontal_deg = mirrors_of(grid_).x ? std::min(own, turned(180.0 - own)) : own;
}

// The edge, and the steepest slope: along ψ, and along φ over sin ψ where that is not 0.
void CandelaTable::find_extent() {
  double steepest = 0.0;
  double edge = 0.0;
  for_each_cell(grid_, [&](std::size_t j, std::size_t next, std::size_t i, double width) {
    const double corners[4] = {value(grid_, j, i), value(grid_, next, i), value(grid_, j, i + 1),
                               value(grid_, next, i + 1)};
    if (*std::max_element(corners, corners + 4) == 0.0) return;
    const double rise = (grid_.vertical_deg[i + 1] - grid_.vertical_deg[i]) * radians_per_degree;
    steepest = std::max({steepest, std::abs(corners[2] - corners[0]) / rise, std::abs(corners[3] - corners[1]) / rise});
    for (std::size_t k = 0; k < 2; ++k) {
      const double sine = std::sin((grid_.vertical_deg[i + k] + polar_offset_deg(grid_)) * radians_per_degree);
      if (sine > 1e-3) steepest = std::max(steepest, std::abs(corners[2 * k + 1] - corners[2 * k]) / (width * sine));
    }
    if (grid_.type == PhotometricType::c) {
      edge = std::max(edge, grid_.vertical_deg[i + 1] * radians_per_degree);
      return;
    }
    // cos θ = cos V cos H is least at a corner or, behind the luminaire, at V = 0.
    const double level = std::clamp(0.0, grid_.vertical_deg[i], grid_.vertical_deg[i + 1]);
    for (const double v : {grid_.vertical_deg[i], level, grid_.vertical_deg[i + 1]}) {
      for (const double h : {grid_.horizontal_deg[j], grid_.horizontal_deg[next]})
        edge = std::max(edge, std::acos(std::clamp(std::cos(v * radians_per_degree) * std::cos(h * radians_per_degree),
                                                   -1.0, 1.0)));
    }
  });
  half_angle_ = std::min(edge, pi);
  width_ = steepest > 0.0 ? std::min(pi, peak_.candela / steepest) : pi;
  if (grid_.type != PhotometricType::c || grid_.vertical_deg.back() * radians_per_degree != half_angle_) return;
  // The table ends above 0.
  const std::size_t rows = grid_.vertical_deg.size();
  for (std::size_t j = 0; j < grid_.horizontal_deg.size(); ++j)
    sharp_edge_ = sharp_edge_ || (half_angle_ < pi && value(grid_, j, rows - 1) > 0.0);
}

// At poles and where the table is mirrored or goes all round, it does not end.
void CandelaTable::find_ends() {
  const std::size_t rows = grid_.vertical_deg.size();
  const std::size_t planes = grid_.horizontal_deg.size();
  const auto row_shines = [&](std::size_t i) {
    for (std::size_t j = 0; j < planes; ++j) {
      if (value(grid_, j, i) > 0.0) return true;
    }
    return false;
  };
  const auto plane_shines = [&](std::size_t j) {
    const auto begin = grid_.candela.begin() + static_cast<std::ptrdiff_t>(j * rows);
    return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(rows), [](double candela) { return candela > 0.0; });
  };
  const Mirrors mirrors = mirrors_of(grid_);
  const double offset = polar_offset_deg(grid_);
  first_row_shines_ = !mirrors.z && grid_.vertical_deg.front() + offset > 0.0 && row_shines(0);
  last_row_shines_ = grid_.vertical_deg.back() + offset < 180.0 && row_shines(rows - 1);
  if (grid_.type == PhotometricType::c) return;
  const bool all_round = grid_.horizontal_deg.front() <= -180.0 && grid_.horizontal_deg.back() >= 180.0;
  first_plane_shines_ = !all_round && !mirrors.y && plane_shines(0);
  last_plane_shines_ = !all_round && !(mirrors.y && grid_.horizontal_deg.back() >= 180.0) && plane_shines(planes - 1);
}

namespace {

// The angles of a table that a cone of directions may contain, in degrees.
struct Around {
  double vertical_from, vertical_to;
  double horizontal_from, horizontal_to;
  double sine;  // the greatest of ψ
};
Around around(const CandelaTable::Grid& grid, const glm::dvec3& direction, double radius) {
  const glm::dvec3 p = mirrors_of(grid).into_table(to_polar(grid, direction));
  const double across = std::hypot(p.x, p.y);
  const double polar = std::atan2(across, p.z);
  const double low = std::max(0.0, polar - radius);
  const double high = std::min(pi, polar + radius);
  const double offset = polar_offset_deg(grid);
  const double sine = low <= 0.5 * pi && high >= 0.5 * pi ? 1.0 : std::max(std::sin(low), std::sin(high));
  // A cone about a pole contains all φ; else sin Δφ = sin(radius)/sin ψ.
  const double turn = std::atan2(p.y, p.x) / radians_per_degree;
  const bool holds_pole = radius >= std::min(polar, pi - polar);
  const double reach = holds_pole ? 360.0 : std::asin(std::min(1.0, std::sin(radius) / across)) / radians_per_degree;
  return {low / radians_per_degree - offset, high / radians_per_degree - offset, turn - reach, turn + reach, sine};
}

// The least distance of adjacent angles, in degrees, of the intervals that meet a range.
double least_step(const std::vector<double>& angles, double from, double to) {
  double least = 360.0;
  auto above = std::upper_bound(angles.begin(), angles.end(), from);
  if (above == angles.begin()) ++above;
  for (; above != angles.end() && *(above - 1) <= to; ++above) least = std::min(least, *above - *(above - 1));
  return least;
}

}  // namespace

double CandelaTable::step_near(const glm::dvec3& direction, double radius) const {
  const Around range = around(grid_, direction, radius);
  double step = least_step(grid_.vertical_deg, range.vertical_from, range.vertical_to);
  if (grid_.horizontal_deg.size() > 1) {
    // Of type C all planes: they go all round. Near a pole the distance of planes vanishes, and their differences with
    // it: there vertical angles count.
    const bool type_c = grid_.type == PhotometricType::c;
    const double planes = type_c ? least_step(grid_.horizontal_deg, -1e3, 1e3)
                                 : least_step(grid_.horizontal_deg, range.horizontal_from, range.horizontal_to);
    step = std::min(step, std::max(0.5 * step, planes * range.sine));
  }
  return std::min(pi, step * radians_per_degree);
}

bool CandelaTable::ends_near(const glm::dvec3& direction, double radius) const {
  if (!first_row_shines_ && !last_row_shines_ && !first_plane_shines_ && !last_plane_shines_) return false;
  const Around range = around(grid_, direction, radius);
  const auto meets = [](double end, double from, double to) { return from <= end && end <= to; };
  return (first_row_shines_ && meets(grid_.vertical_deg.front(), range.vertical_from, range.vertical_to)) ||
         (last_row_shines_ && meets(grid_.vertical_deg.back(), range.vertical_from, range.vertical_to)) ||
         (first_plane_shines_ && meets(grid_.horizontal_deg.front(), range.horizontal_from, range.horizontal_to)) ||
         (last_plane_shines_ && meets(grid_.horizontal_deg.back(), range.horizontal_from, range.horizontal_to));
}

const CandelaSampler& CandelaTable::sampler() const {
  std::call_once(sampler_once_, [this] { sampler_ = std::make_unique<CandelaSampler>(grid_); });
  return *sampler_;
}

glm::dvec3 CandelaTable::sample(double u, double turns) const {
  return sampler().sample(u, turns);
}

}  // namespace lichtmc
