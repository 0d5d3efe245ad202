#include "chance/candela_sampler.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/lanes.hpp"
#include "chance/directions.hpp"

namespace lichtmc {

namespace {

constexpr double widest_row_deg = 2.5;
// At a pole the density may grow as ψ²: there rows end at these fractions of the first one.
constexpr std::array<double, 3> towards_pole{1.0 / 64.0, 1.0 / 16.0, 1.0 / 4.0};
constexpr std::size_t block = 256;  // photons whose cells are gathered at a time: 11 kB

// Where the linear density from c0 to c1 over 0 … 1 has the fraction v of its integral.
template <class Real>
Real invert_linear(Real c0, Real c1, Real v) {
  constexpr Real tiny = Real(1e-30);
  return v * (c0 + c1) / (c0 + std::sqrt(c0 * c0 + v * (c1 * c1 - c0 * c0)) + tiny);
}

}  // namespace

double CandelaSampler::Row::sine_at(double s) const {
  return sine * std::cos(width * s) + cosine * std::sin(width * s);
}

double CandelaSampler::Row::cosine_at(double s) const {
  return cosine * std::cos(width * s) - sine * std::sin(width * s);
}

double CandelaSampler::Row::integral(double first, double last, double s) const {
  if (!(s > 0.0)) return 0.0;
  return std::abs(weighted_interval(first, last, sine_at(0.5 * s), cosine_at(0.5 * s), 0.5 * (width * s)));
}

CandelaSampler::CandelaSampler(const CandelaTable::Grid& grid) : grid_(&grid), mirrors_(mirrors_of(grid)) {
  set_rows();
  set_cells();
}

void CandelaSampler::set_rows() {
  const std::vector<double>& vertical = grid_->vertical_deg;
  const double offset = polar_offset_deg(*grid_);
  std::vector<double> ends{vertical.front() + offset};           // ψ in degrees
  std::vector<std::pair<std::size_t, double>> places{{0, 0.0}};  // interval of the table and fraction in it
  for (std::size_t i = 0; i + 1 < vertical.size(); ++i) {
    const double from = vertical[i] + offset;
    const double width = vertical[i + 1] - vertical[i];
    const auto add = [&](double fraction) {
      ends.push_back(fraction == 1.0 ? vertical[i + 1] + offset : from + fraction * width);
      places.emplace_back(i, fraction);
    };
    const auto parts = static_cast<int>(std::ceil(width / widest_row_deg));
    for (int k = 0; k < parts; ++k) {
      const double step = 1.0 / parts;
      if (k == 0 && from == 0.0) {
        for (const double part : towards_pole) add(part * step);
      }
      if (k + 1 == parts && from + width == 180.0) {
        for (auto part = towards_pole.rbegin(); part != towards_pole.rend(); ++part) add(1.0 - *part * step);
      }
      add(k + 1 == parts ? 1.0 : (k + 1) * step);
    }
  }
  boundaries_ = ends.size();
  for (std::uint32_t r = 0; r + 1 < boundaries_; ++r) {
    const double low = ends[r] * radians_per_degree;
    const double high = ends[r + 1] * radians_per_degree;
    const bool from_below = ends[r] + ends[r + 1] <= 180.0;
    // sin π and cos π/2 are not 0 in double; at the poles they must be.
    const double sine = from_below ? std::sin(low) : std::sin((180.0 - ends[r + 1]) * radians_per_degree);
    const double cosine = from_below ? std::cos(low) : std::cos(high);
    rows_.push_back(
        {sine, cosine, from_below ? high - low : low - high, from_below ? r : r + 1, from_below ? r + 1 : r});
  }
  const std::size_t table_rows = vertical.size();
  for (std::size_t j = 0; j < grid_->horizontal_deg.size(); ++j) {
    const double* plane = &grid_->candela[j * table_rows];
    for (const auto& [i, fraction] : places)
      values_.push_back(static_cast<float>(plane[i] + fraction * (plane[i + 1] - plane[i])));
  }
}

void CandelaSampler::set_cells() {
  const std::vector<double>& angles = grid_->horizontal_deg;
  const bool one = angles.size() == 1;
  const std::size_t planes = one ? 1 : angles.size() - 1;
  for (std::size_t j = 0; j < planes; ++j) {
    const double turn = one ? 0.0 : angles[j] / 360.0;
    from_turn_.push_back(static_cast<float>(turn - std::floor(turn)));
    turns_.push_back(one ? 1.0F : static_cast<float>((angles[j + 1] - angles[j]) / 360.0));
  }
  double sum = 0.0;
  std::vector<double> fluxes;
  for (std::size_t j = 0; j < planes; ++j) {
    const float* low = &values_[j * boundaries_];
    const float* high = one ? low : low + boundaries_;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const Row& row = rows_[r];
      const double first = 0.5 * (double{low[row.begin]} + high[row.begin]);
      const double last = 0.5 * (double{low[row.end]} + high[row.end]);
      const double flux = turns_[j] * row.integral(first, last, 1.0);
      if (!(flux > 0.0)) continue;
      fluxes.push_back(flux);
      cells_.push_back({sum, 0.0F, static_cast<std::uint16_t>(j), static_cast<std::uint16_t>(r)});
      sum += flux;
    }
  }
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    cells_[k].from /= sum;
    cells_[k].per_flux = static_cast<float>(sum / fluxes[k]);
  }
  cells_.push_back({2.0, 0.0F, 0, 0});
  const auto bits = static_cast<unsigned>(std::clamp<int>(static_cast<int>(std::bit_width(cells_.size())), 8, 16));
  guide_shift_ = 32 - bits;
  std::uint32_t k = 0;
  for (std::size_t bin = 0; bin < std::size_t{1} << bits; ++bin) {
    while (cells_[k + 1].from <= std::ldexp(static_cast<double>(bin), -static_cast<int>(bits))) ++k;
    guide_.push_back(k);
  }
}

const CandelaSampler::Cell& CandelaSampler::choose(double u, std::uint32_t first_bits) const {
  std::size_t k = guide_[first_bits >> guide_shift_];
  while (cells_[k + 1].from <= u) ++k;
  return cells_[k];
}

// G(s) = ∫ (a + b t)(q0 + q1 t + q2 t² + …) dt over 0 … s, the sine by Taylor's series; solved for G(s) = v G(1) by
// Newton's method, kept between two bounds.
glm::dvec3 CandelaSampler::sample(double u, double turns) const {
  const Cell& cell = choose(u, static_cast<std::uint32_t>(u * 0x1p32));
  const Row& row = rows_[cell.row];
  const float* low = &values_[cell.plane * boundaries_];
  const float* high = grid_->horizontal_deg.size() == 1 ? low : low + boundaries_;
  const double share = std::clamp((u - cell.from) * cell.per_flux, 0.0, 1.0);
  const double v = row.width > 0.0 ? share : 1.0 - share;
  const double a = 0.5 * (double{low[row.begin]} + high[row.begin]);
  const double b = 0.5 * (double{low[row.end]} + high[row.end]) - a;
  const auto integral = [&](double s) { return row.integral(a, a + b * s, s); };
  const double wanted = v * integral(1.0);
  double least = 0.0;
  double most = 1.0;
  double s = invert_linear(a * row.sine, (a + b) * row.sine_at(1.0), v);
  for (int k = 0; k < 60 && most - least > 1e-15; ++k) {
    const double excess = integral(s) - wanted;
    (excess > 0.0 ? most : least) = s;
    const double next = s - excess / std::max(1e-300, (a + b * s) * row.sine_at(s) * std::abs(row.width));
    const double before = s;
    s = next > least && next < most ? next : 0.5 * (least + most);
    if (std::abs(s - before) < 1e-15) break;
  }

  const int copies = mirrors_.copies();
  const auto copy = std::min(static_cast<int>(turns * copies), copies - 1);
  const double w = turns * copies - copy;
  const auto at = [&](const float* plane) {
    return plane[row.begin] + s * (double{plane[row.end]} - plane[row.begin]);
  };
  const double f = invert_linear(at(low), at(high), w);
  const double azimuth = 2.0 * std::numbers::pi * (from_turn_[cell.plane] + f * turns_[cell.plane]);
  const double sine = row.sine_at(s);
  glm::dvec3 p(sine * std::cos(azimuth), sine * std::sin(azimuth), row.cosine_at(s));
  int bit = copy;
  for (const auto& [mirrored, component] : {std::pair{mirrors_.x, &p.x}, {mirrors_.y, &p.y}, {mirrors_.z, &p.z}}) {
    if (!mirrored) continue;
    if ((bit & 1) != 0) *component = -*component;
    bit >>= 1;
  }
  return from_polar(*grid_, p);
}

// Cells of some photons, as arrays.
struct CandelaSampler::Gathered {
  std::array<float, block> share;
  std::array<float, block> sine;
  std::array<float, block> cosine;
  std::array<float, block> width;
  std::array<float, block> here_0;
  std::array<float, block> there_0;
  std::array<float, block> here_1;
  std::array<float, block> there_1;
  std::array<float, block> from_turn;
  std::array<float, block> turns;
};

void CandelaSampler::gather(std::size_t n, const std::uint32_t* polar, Gathered& cells) const {
  const std::size_t next = grid_->horizontal_deg.size() == 1 ? 0 : boundaries_;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = (polar[i] + 0.5) * 0x1p-32;
    const Cell& cell = choose(u, polar[i]);
    const Row& row = rows_[cell.row];
    const auto share = static_cast<float>((u - cell.from) * cell.per_flux);
    cells.share[i] = row.width > 0.0 ? share : 1.0F - share;
    cells.sine[i] = static_cast<float>(row.sine);
    cells.cosine[i] = static_cast<float>(row.cosine);
    cells.width[i] = static_cast<float>(row.width);
    const float* plane = &values_[cell.plane * boundaries_];
    cells.here_0[i] = plane[row.begin];
    cells.there_0[i] = plane[row.end];
    cells.here_1[i] = plane[next + row.begin];
    cells.there_1[i] = plane[next + row.end];
    cells.from_turn[i] = from_turn_[cell.plane];
    cells.turns[i] = turns_[cell.plane];
  }
}

namespace {

// The arrays of Gathered: members of a structure would hide from the compiler that they do not overlap.
struct Source {
  const float* LICHTMC_APART share;
  const float* LICHTMC_APART sine;
  const float* LICHTMC_APART cosine;
  const float* LICHTMC_APART width;
  const float* LICHTMC_APART here_0;
  const float* LICHTMC_APART there_0;
  const float* LICHTMC_APART here_1;
  const float* LICHTMC_APART there_1;
  const float* LICHTMC_APART from_turn;
  const float* LICHTMC_APART turns;
};

LICHTMC_LANES void invert(std::size_t n, const Source& from, const std::uint32_t* LICHTMC_APART azimuth,
                          std::uint32_t shift, std::uint32_t mask_x, std::uint32_t mask_y, std::uint32_t mask_z,
                          float sign_x, float sign_y, float sign_z, float* LICHTMC_APART x, float* LICHTMC_APART y,
                          float* LICHTMC_APART z) {
  const float* LICHTMC_APART share = from.share;
  const float* LICHTMC_APART sines = from.sine;
  const float* LICHTMC_APART cosines = from.cosine;
  const float* LICHTMC_APART widths = from.width;
  const float* LICHTMC_APART here_0 = from.here_0;
  const float* LICHTMC_APART there_0 = from.there_0;
  const float* LICHTMC_APART here_1 = from.here_1;
  const float* LICHTMC_APART there_1 = from.there_1;
  const float* LICHTMC_APART from_turn = from.from_turn;
  const float* LICHTMC_APART turns = from.turns;
  for (std::size_t i = 0; i < n; ++i) {
    // Density over s: (a + b s)(q0 + q1 s + q2 s² + q3 s³).
    const float a = 0.5F * (here_0[i] + here_1[i]);
    const float b = 0.5F * (there_0[i] + there_1[i]) - a;
    const float w = widths[i];
    const float q0 = sines[i];
    const float q1 = cosines[i] * w;
    const float q2 = -0.5F * q0 * w * w;
    const float q3 = (-1.0F / 6.0F) * q1 * w * w;
    const float p0 = a * q0;
    const float p1 = a * q1 + b * q0;
    const float p2 = a * q2 + b * q1;
    const float p3 = a * q3 + b * q2;
    const float p4 = b * q3;
    const float whole = p0 + (1.0F / 2.0F) * p1 + (1.0F / 3.0F) * p2 + (1.0F / 4.0F) * p3 + (1.0F / 5.0F) * p4;
    const float last = p0 + p1 + p2 + p3 + p4;
    const float v = share[i] < 0.0F ? 0.0F : (share[i] > 1.0F ? 1.0F : share[i]);
    const float wanted = v * whole;
    constexpr float tiny = 1e-30F;
    const float squared = p0 * p0 + v * (last * last - p0 * p0);
    float s = v * (p0 + last) / (p0 + std::sqrt(squared > 0.0F ? squared : 0.0F) + tiny);
    for (int step = 0; step < 3; ++step) {
      const float density = p0 + s * (p1 + s * (p2 + s * (p3 + s * p4)));
      const float integral =
          s * (p0 + s * ((1.0F / 2.0F) * p1 +
                         s * ((1.0F / 3.0F) * p2 + s * ((1.0F / 4.0F) * p3 + s * ((1.0F / 5.0F) * p4)))));
      const float next = s - (integral - wanted) / (density > tiny ? density : tiny);
      s = next < 0.0F ? 0.0F : (next > 1.0F ? 1.0F : next);
    }

    const float t = w * s;
    const float less = t * t * (-0.5F + t * t * (1.0F / 24.0F));  // cos t − 1
    const float sine_t = t * (1.0F - t * t * (1.0F / 6.0F));
    const float sine = q0 + (q0 * less + cosines[i] * sine_t);
    const float cosine = cosines[i] + (cosines[i] * less - q0 * sine_t);

    const float c0 = here_0[i] + s * (there_0[i] - here_0[i]);
    const float c1 = here_1[i] + s * (there_1[i] - here_1[i]);
    const float r = (static_cast<float>((azimuth[i] << shift) >> 8) + 0.5F) * 0x1p-24F;
    const float root = c0 * c0 + r * (c1 * c1 - c0 * c0);
    const float f = r * (c0 + c1) / (c0 + std::sqrt(root > 0.0F ? root : 0.0F) + tiny);
    float sine_azimuth = 0.0F;
    float cosine_azimuth = 0.0F;
    sine_cosine(from_turn[i] + f * turns[i], sine_azimuth, cosine_azimuth);
    x[i] = ((azimuth[i] & mask_x) != 0 ? -sign_x : sign_x) * (sine * cosine_azimuth);
    y[i] = ((azimuth[i] & mask_y) != 0 ? -sign_y : sign_y) * (sine * sine_azimuth);
    z[i] = ((azimuth[i] & mask_z) != 0 ? -sign_z : sign_z) * cosine;
  }
}

}  // namespace

void CandelaSampler::sample(std::size_t n, const std::uint32_t* polar, const std::uint32_t* azimuth, float* x, float* y,
                            float* z) const {
  std::uint32_t shift = 0;
  const auto next_mask = [&shift](bool mirrored) { return mirrored ? 0x80000000U >> shift++ : 0U; };
  const std::uint32_t mask_x = next_mask(mirrors_.x);
  const std::uint32_t mask_y = next_mask(mirrors_.y);
  const std::uint32_t mask_z = next_mask(mirrors_.z);
  // Where the components of the polar vector go.
  const glm::dvec3 of_x = from_polar(*grid_, {1.0, 0.0, 0.0});
  const glm::dvec3 of_y = from_polar(*grid_, {0.0, 1.0, 0.0});
  const glm::dvec3 of_z = from_polar(*grid_, {0.0, 0.0, 1.0});
  const auto output = [&](const glm::dvec3& axis) { return axis.x != 0.0 ? x : (axis.y != 0.0 ? y : z); };
  const auto sign = [](const glm::dvec3& axis) { return static_cast<float>(axis.x + axis.y + axis.z); };
  Gathered cells;
  const Source source{cells.share.data(),     cells.sine.data(),    cells.cosine.data(), cells.width.data(),
                      cells.here_0.data(),    cells.there_0.data(), cells.here_1.data(), cells.there_1.data(),
                      cells.from_turn.data(), cells.turns.data()};
  for (std::size_t begin = 0; begin < n; begin += block) {
    const std::size_t some = std::min(block, n - begin);
    gather(some, polar + begin, cells);
    invert(some, source, azimuth + begin, shift, mask_x, mask_y, mask_z, sign(of_x), sign(of_y), sign(of_z),
           output(of_x) + begin, output(of_y) + begin, output(of_z) + begin);
  }
}

}  // namespace lichtmc
