#include "walk/first_flights.hpp"

#include <algorithm>
#include <cmath>

#include "chance/directions.hpp"
#include "chance/sobol.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

namespace {

// cos²θ is computed from 1 − u, which float represents as precisely near 0 as u: no flight is tangential. About the
// normal as frame_about() does.
LICHTMC_LANES void aim_lanes(std::size_t n, const float* LICHTMC_APART normal_x, const float* LICHTMC_APART normal_y,
                             const float* LICHTMC_APART normal_z, const float* LICHTMC_APART view,
                             const std::uint32_t* LICHTMC_APART polar, const std::uint32_t* LICHTMC_APART azimuth,
                             const float* LICHTMC_APART to_tracer, float* LICHTMC_APART dx, float* LICHTMC_APART dy,
                             float* LICHTMC_APART dz, float* LICHTMC_APART cosines) {
  const float xx = to_tracer[0], xy = to_tracer[1], xz = to_tracer[2];
  const float yx = to_tracer[3], yy = to_tracer[4], yz = to_tracer[5];
  const float zx = to_tracer[6], zy = to_tracer[7], zz = to_tracer[8];
  for (std::size_t i = 0; i < n; ++i) {
    const float u = (static_cast<float>(polar[i]) + 0.5F) * 0x1p-32F;
    const float rest = (static_cast<float>(~polar[i]) + 0.5F) * 0x1p-32F;
    const float sine_polar = std::sqrt(view[i] * u);
    const float cosine_polar = std::sqrt((1.0F - view[i]) + view[i] * rest);
    float sine = 0.0F;
    float cosine = 0.0F;
    sine_cosine(static_cast<float>(azimuth[i]) * 0x1p-32F, sine, cosine);
    const float across = sine_polar * cosine;
    const float along = sine_polar * sine;
    const float x = normal_x[i];
    const float y = normal_y[i];
    const float z = normal_z[i];
    const float sign = z < 0.0F ? -1.0F : 1.0F;
    const float a = -1.0F / (sign + z);
    const float b = x * y * a;
    const float out_x = across * (1.0F + sign * x * x * a) + along * b + cosine_polar * x;
    const float out_y = across * sign * b + along * (sign + y * y * a) + cosine_polar * y;
    const float out_z = across * -sign * x - along * y + cosine_polar * z;
    dx[i] = xx * out_x + yx * out_y + zx * out_z;
    dy[i] = xy * out_x + yy * out_y + zy * out_z;
    dz[i] = xz * out_x + yz * out_y + zz * out_z;
    cosines[i] = cosine_polar;
  }
}

}  // namespace

RoundPoints::RoundPoints(std::uint32_t group, bool has_place) : has_place_(has_place), points_(group) {
  for (std::uint32_t j = 0; j < group; ++j) {
    const auto polar = static_cast<std::uint32_t>((std::uint64_t{j} << 32) / group);
    points_[j] = {polar, j * golden, {sobol(j, 0), sobol(j, 1)}};
  }
  std::sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.azimuth < b.azimuth; });
}

void RoundPoints::begin(const Stream& stream, std::uint64_t set) {
  shift_ = stream.draw(set, 0, Purpose::shift);
  polar_shift_ = shift_[0] / static_cast<std::uint32_t>(points_.size());
  if (has_place_) place_shift_ = stream.draw(set, 0, Purpose::place_shift);
}

FirstFlights::FirstFlights(std::size_t capacity) {
  const std::size_t whole = whole_lanes(capacity);
  for (auto* numbers : {&normal_x_, &normal_y_, &normal_z_, &view_}) numbers->resize(whole);
  for (auto* words : {&polar_, &azimuth_}) words->resize(whole);
}

void FirstFlights::set(std::size_t i, const OriginView& view, std::uint32_t polar, std::uint32_t azimuth) {
  normal_x_[i] = view.normal.x;
  normal_y_[i] = view.normal.y;
  normal_z_[i] = view.normal.z;
  view_[i] = static_cast<float>(view.squared_sine());
  polar_[i] = polar;
  azimuth_[i] = azimuth;
  if (view.law != ReceiverLaw::planar) around_.push_back({i, glm::dvec3(view.normal), glm::dvec3(view.facing)});
}

void FirstFlights::aim(std::size_t n, const glm::dmat3& directions, Rays& rays, float* weights) {
  const glm::mat3 to_tracer(directions);
  aim_lanes(n, normal_x_.data(), normal_y_.data(), normal_z_.data(), view_.data(), polar_.data(), azimuth_.data(),
            &to_tracer[0].x, rays.dx.data(), rays.dy.data(), rays.dz.data(), weights);
  for (const Around& one : around_) {
    const auto unit = [](std::uint32_t word) { return (word + 0.5) * 0x1p-32; };
    const std::size_t i = one.flight;
    const FirstFlight flight = first_flight_around(one.axis, one.facing, unit(polar_[i]), unit(azimuth_[i]));
    rays.set_direction(i, glm::vec3(directions * flight.direction));
    weights[i] = static_cast<float>(flight.weight);
  }
  around_.clear();
}

}  // namespace lichtmc
