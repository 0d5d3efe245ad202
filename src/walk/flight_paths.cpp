#include "walk/flight_paths.hpp"

#include <cmath>

#include "base/lanes.hpp"

namespace lichtmc {

namespace {

struct Points {
  const double* LICHTMC_APART x;
  const double* LICHTMC_APART y;
  const double* LICHTMC_APART z;
};

// Where flights end, and how long they are.
LICHTMC_LANES void end_flights(std::size_t n, const FlightEnds& ends, const std::uint32_t* LICHTMC_APART photon,
                               const Points& starts, double* LICHTMC_APART end_x, double* LICHTMC_APART end_y,
                               double* LICHTMC_APART end_z, double* LICHTMC_APART length) {
  const FlightEnds from = ends;
  const Points start = starts;
  for (std::size_t i = 0; i < n; ++i) {
    const double px = double{from.x[i]} + double{from.length[i]} * double{from.dx[i]};
    const double py = double{from.y[i]} + double{from.length[i]} * double{from.dy[i]};
    const double pz = double{from.z[i]} + double{from.length[i]} * double{from.dz[i]};
    const double x = from.origin_x + from.x_x * px + from.x_y * py + from.x_z * pz;
    const double y = from.origin_y + from.y_x * px + from.y_y * py + from.y_z * pz;
    const double z = from.origin_z + from.z_x * px + from.z_y * py + from.z_z * pz;
    const std::uint32_t facet = from.facet[i];
    const double nx = from.normal_x[facet];
    const double ny = from.normal_y[facet];
    const double nz = from.normal_z[facet];
    const double height = nx * x + ny * y + nz * z - from.offset[facet];
    const std::uint32_t k = photon[i];
    const double ex = x - height * nx;
    const double ey = y - height * ny;
    const double ez = z - height * nz;
    const double dx = ex - start.x[k];
    const double dy = ey - start.y[k];
    const double dz = ez - start.z[k];
    end_x[i] = ex;
    end_y[i] = ey;
    end_z[i] = ez;
    length[i] = std::sqrt(dx * dx + dy * dy + dz * dz);
  }
}

}  // namespace

FlightPaths::FlightPaths(const FacetPlanes* planes) : planes_(planes) {
  if (planes == nullptr) return;
  for (auto* numbers : {&x_, &y_, &z_, &length_}) numbers->resize(batch_histories);
  for (auto* numbers : {&end_x_, &end_y_, &end_z_, &flight_}) numbers->resize(whole_lanes(batch_histories));
}

void FlightPaths::land(const Wave& wave) {
  const std::size_t n = wave.rays.size;
  end_flights(n, planes_->ends_of(wave.rays), wave.photon.data(), {x_.data(), y_.data(), z_.data()}, end_x_.data(),
              end_y_.data(), end_z_.data(), flight_.data());
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t photon = wave.photon[i];
    x_[photon] = end_x_[i];
    y_[photon] = end_y_[i];
    z_[photon] = end_z_[i];
    length_[photon] += flight_[i];
  }
}

}  // namespace lichtmc
