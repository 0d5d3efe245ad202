// The figures of one channel that follow from its moments, its bins and its frequency response. docs/channel.md has the
// definitions.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "lichtmc/channel.hpp"

namespace lichtmc {

// Σ w, Σ w t and Σ w t² over paths; w gains, t in s.
struct DelayMoments {
  double weight = 0.0;
  double first = 0.0;
  double second = 0.0;

  DelayMoments& operator+=(const DelayMoments& other);
  DelayMoments operator-(const DelayMoments& other) const;
  DelayMoments operator*(double factor) const;
  double mean_s() const;        // NaN without light
  double rms_spread_s() const;  // NaN without light
};

// The rms delay spread of bins with the weights h², h = gain/width in each bin. variance: of each h, whose sum with h²
// the noise adds; null: none. Negative weights remain: they are the noise of empty bins.
double squared_rms_spread_s(const std::vector<double>& gain, const std::vector<double>* variance, double width_s);

// H(f) of gains in bins: those of a bin are spread evenly over its width.
std::vector<std::complex<double>> transform(const std::vector<double>& gain, double width_s,
                                            const std::vector<double>& frequencies_hz);
// Adds the response of a path.
void add_path(std::vector<std::complex<double>>& response, double gain, double time_s,
              const std::vector<double>& frequencies_hz);

// The lowest frequency at which |H(f)| falls to a level, by cubic interpolation of |H|² between the frequencies; NaN if
// it does not.
double frequency_of_level(const std::vector<std::complex<double>>& response, const std::vector<double>& frequencies_hz,
                          double level);

}  // namespace lichtmc
