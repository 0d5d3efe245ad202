#include "run/channel_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lichtmc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
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
  return weight > 0.0 ? first / weight : nan;
}

double DelayMoments::rms_spread_s() const {
  if (!(weight > 0.0)) return nan;
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

std::vector<std::complex<double>> transform(const std::vector<double>& gain, double width_s,
                                            const std::vector<double>& frequencies_hz) {
  std::vector<std::complex<double>> response;
  response.reserve(frequencies_hz.size());
  for (const double f : frequencies_hz) {
    const std::complex<double> step = std::polar(1.0, -turn * f * width_s);
    std::complex<double> phasor = std::polar(1.0, -0.5 * turn * f * width_s);
    std::complex<double> sum = 0.0;
    for (const double one : gain) {
      sum += one * phasor;
      phasor *= step;
    }
    const double half = 0.5 * turn * f * width_s;
    response.push_back(half > 0.0 ? sum * (std::sin(half) / half) : sum);
  }
  return response;
}

void add_path(std::vector<std::complex<double>>& response, double gain, double time_s,
              const std::vector<double>& frequencies_hz) {
  for (std::size_t f = 0; f < frequencies_hz.size(); ++f)
    response[f] += std::polar(gain, -turn * frequencies_hz[f] * time_s);
}

double frequency_of_level(const std::vector<std::complex<double>>& response, const std::vector<double>& frequencies_hz,
                          double level) {
  const std::size_t n = response.size();
  std::size_t after = 0;
  while (after < n && std::abs(response[after]) >= level) ++after;
  if (after == n || after == 0) return nan;
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
