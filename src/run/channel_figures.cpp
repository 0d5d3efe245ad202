#include "run/channel_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/lanes.hpp"

namespace lichtmc {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double turn = 2.0 * std::numbers::pi;

}  // namespace

DelayMoments& DelayMoments::operator+=(const DelayMoments& other) {
  weight += other.weight;
  first += other.first;
  second += other.second;
  return *this;
}

DelayMoments DelayMoments::operator-(const DelayMoments& other) const {
  return {weight - other.weight, first - other.first, second - other.second};
}

DelayMoments DelayMoments::operator*(double factor) const {
  return {weight * factor, first * factor, second * factor};
}

double DelayMoments::mean_s() const {
  return weight > 0.0 ? first / weight : not_known;
}

double DelayMoments::rms_spread_s() const {
  if (!(weight > 0.0)) return not_known;
  const double mean = first / weight;
  return std::sqrt(std::max(0.0, second / weight - mean * mean));
}

double squared_rms_spread_s(const std::vector<double>& gain, const std::vector<double>* variance, double width_s) {
  DelayMoments sum;
  for (std::size_t b = 0; b < gain.size(); ++b) {
    const double t = (static_cast<double>(b) + 0.5) * width_s;
    const double weight = gain[b] * gain[b] - (variance != nullptr ? (*variance)[b] : 0.0);
    sum += DelayMoments{weight, weight * t, weight * t * t};
  }
  return sum.rms_spread_s();
}

namespace {

// Adds gain · phasor to the sums of all frequencies, and turns the phasors by one bin.
LICHTMC_LANES void add_bin(std::size_t n, double gain, const double* LICHTMC_APART step_real,
                           const double* LICHTMC_APART step_imaginary, double* LICHTMC_APART phasor_real,
                           double* LICHTMC_APART phasor_imaginary, double* LICHTMC_APART real,
                           double* LICHTMC_APART imaginary) {
  for (std::size_t f = 0; f < n; ++f) {
    const double r = phasor_real[f];
    const double i = phasor_imaginary[f];
    real[f] += gain * r;
    imaginary[f] += gain * i;
    phasor_real[f] = r * step_real[f] - i * step_imaginary[f];
    phasor_imaginary[f] = r * step_imaginary[f] + i * step_real[f];
  }
}

}  // namespace

std::vector<std::complex<double>> transform(const std::vector<double>& gain, double width_s,
                                            const std::vector<double>& frequencies_hz) {
  const std::size_t n = frequencies_hz.size();
  enum { step_real, step_imaginary, phasor_real, phasor_imaginary, real, imaginary, arrays };
  std::array<std::vector<double>, arrays> of;
  for (std::vector<double>& one : of) one.resize(whole_lanes(n), 0.0);
  // From the first bin with light to the last.
  std::size_t first = 0;
  std::size_t last = gain.size();
  while (first < last && gain[first] == 0.0) ++first;
  while (last > first && gain[last - 1] == 0.0) --last;
  for (std::size_t f = 0; f < n; ++f) {
    const double angle = -turn * frequencies_hz[f] * width_s;
    const double begin = angle * (static_cast<double>(first) + 0.5);
    of[step_real][f] = std::cos(angle);
    of[step_imaginary][f] = std::sin(angle);
    of[phasor_real][f] = std::cos(begin);
    of[phasor_imaginary][f] = std::sin(begin);
  }
  for (std::size_t b = first; b < last; ++b) {
    add_bin(n, gain[b], of[step_real].data(), of[step_imaginary].data(), of[phasor_real].data(),
            of[phasor_imaginary].data(), of[real].data(), of[imaginary].data());
  }
  std::vector<std::complex<double>> response;
  response.reserve(n);
  for (std::size_t f = 0; f < n; ++f) {
    const double half = 0.5 * turn * frequencies_hz[f] * width_s;
    const double spread = half > 0.0 ? std::sin(half) / half : 1.0;
    response.emplace_back(spread * of[real][f], spread * of[imaginary][f]);
  }
  return response;
}

void add_path(std::vector<std::complex<double>>& response, double gain, double time_s,
              const std::vector<double>& frequencies_hz) {
  if (response.empty()) return;
  // Frequencies are evenly spaced: one multiplication each.
  const double step_hz = response.size() > 1 ? frequencies_hz[1] - frequencies_hz[0] : 0.0;
  const std::complex<double> step = std::polar(1.0, -turn * step_hz * time_s);
  std::complex<double> phasor = std::polar(gain, -turn * frequencies_hz[0] * time_s);
  for (std::complex<double>& one : response) {
    one += phasor;
    phasor = {phasor.real() * step.real() - phasor.imag() * step.imag(),
              phasor.real() * step.imag() + phasor.imag() * step.real()};
  }
}

double frequency_of_level(const std::vector<std::complex<double>>& response, const std::vector<double>& frequencies_hz,
                          double level) {
  const std::size_t n = response.size();
  std::size_t after = 0;
  while (after < n && std::abs(response[after]) >= level) ++after;
  if (after == n || after == 0) return not_known;
  // Lagrange's polynomial through up to four neighbours; frequencies are evenly spaced.
  const std::size_t count = std::min<std::size_t>(4, n);
  const std::size_t first = std::min(after >= 2 ? after - 2 : 0, n - count);
  const auto squared = [&](double x) {  // x: position between the frequencies, in steps from the first
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      double factor = 1.0;
      for (std::size_t k = 0; k < count; ++k) {
        if (k != i) factor *= (x - static_cast<double>(k)) / (static_cast<double>(i) - static_cast<double>(k));
      }
      sum += factor * std::norm(response[first + i]);
    }
    return sum;
  };
  auto low = static_cast<double>(after - 1 - first);
  double high = low + 1.0;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (squared(middle) >= level * level ? low : high) = middle;
  }
  const double step = n > 1 ? frequencies_hz[1] - frequencies_hz[0] : 0.0;
  return frequencies_hz[first] + 0.5 * (low + high) * step;
}

}  // namespace lichtmc
