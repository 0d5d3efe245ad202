// Artificial impulse responses of 2 emitters and 3 receivers with everything that is difficult to write.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "support/small_result.hpp"

namespace lichtmc::test {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Orders 0, 1, 2 and the rest; 10 bins of 1 ns. Every value of h differs from all others. The last receiver gets no
// light from the first emitter.
inline ImpulseResponses make_small_responses() {
  ImpulseResponses r;
  r.bin_width_s = 1e-9;
  r.bins = 10;
  r.orders = 2;
  r.emitters = {"a \"b\", c", "Leuchte Ø 𝄞"};
  r.powers = {0.75, 0.25};
  r.delays_s = {5e-9, unknown};
  r.receivers = {"first", "second, half", "dark"};
  r.groups = 32;
  r.frequencies_hz = {0.0, 1e6};
  const std::size_t pairs = r.emitters.size() * r.receivers.size();
  double next = 1.0;
  for (std::size_t p = 0; p < pairs; ++p) {
    const bool dark = p == 2;
    std::vector<double> sums(r.bins, 0.0);
    for (std::size_t order = 0; order < r.columns(); ++order) {
      for (std::size_t bin = 0; bin < r.bins; ++bin) {
        const double h = dark || bin < order ? 0.0 : (next += 1.0) / 3.0;
        r.h.push_back(h);
        r.standard_error.push_back(h > 0.0 ? 0.01 * h : 0.0);
        sums[bin] += h;
      }
      r.order_gain.push_back({0.1 * static_cast<double>(order + p), 1e-3});
      r.order_beyond.push_back({1e-9, unknown});
      r.order_first_s.push_back(dark ? unknown : 1e-9 * static_cast<double>(order));
    }
    for (const double sum : sums) {
      r.h_all.push_back(sum);
      r.standard_error_all.push_back(0.02 * sum);
    }
    r.response.insert(r.response.end(), {{1e-6, 0.0}, {0.8e-6, -0.3e-6}});
    r.magnitude_error.insert(r.magnitude_error.end(), {1e-9, 2e-9});
    Channel c;
    c.emitter = p / r.receivers.size();
    c.receiver = p % r.receivers.size();
    if (!dark) {
      const double k = static_cast<double>(p + 1);
      c.gain = {1e-6 * k, 1e-9};
      c.line_of_sight = {4e-7 * k, 0.0};
      c.diffuse = {6e-7 * k, 1e-9};
      c.rician_k = {2.0 / 3.0, 1e-3};
      c.first_arrival_s = 7.25e-9;
      c.first_arrival_is_exact = p == 0;
      c.first_reflection_s = 9e-9;
      c.mean_delay_s = {2e-8, 1e-10};
      c.mean_excess_delay_s = {1.275e-8, 1e-10};
      c.rms_delay_spread_s = {1.1e-8 * k, 2e-10};
      c.diffuse_mean_delay_s = {2.5e-8, 1e-10};
      c.diffuse_rms_delay_spread_s = {1.3e-8, 1e-10};
      c.squared_rms_delay_spread_s = {1e-9, 1e-11};
      c.bandwidth_electrical_hz = {8.3e6, 2e4};
      c.beyond = {1e-9 * k, 1e-11};
    } else {
      c.gain = c.line_of_sight = c.diffuse = c.beyond = {0.0, 0.0};
    }
    r.channels.push_back(c);
  }
  return r;
}

// make_result() with receivers and these responses.
inline Result make_channel_result() {
  Result result = make_result();
  result.settings.channel.bin_width_s = 1e-9;
  result.settings.channel.orders = 2;
  result.settings.channel.per_emitter = true;
  result.channels = make_small_responses();
  for (std::size_t k = 0; k < result.channels->receivers.size(); ++k) {
    Receiver receiver{result.channels->receivers[k], {0.25, 0.5, 0.125 * static_cast<double>(k)}};
    receiver.half_angle_deg = 60.0;
    receiver.area_m2 = 1e-4;
    if (k == 1) receiver.concentrator_index = 1.5;
    receiver.filter_gain = 0.5;
    result.receivers.push_back(receiver);
    result.receiver_results.push_back({2.0, 1.0, 1.0, 0.1, 1e-6});
  }
  result.receiver_walk.histories = 4096;
  result.receiver_walk.rounds = 64;
  return result;
}

}  // namespace lichtmc::test
