// Optical channels: the impulse response from emitters to receivers, and the figures that are derived from it.
//
// The impulse response h(t) of an emitter and a receiver is the optical power that the receiver gets per time, divided
// by the energy of a short pulse of the emitter at t = 0: a density of the gain, in 1/s, whose integral is the gain
// H(0) (received power over emitted power). A path of length L arrives at t = L/c + delay of the emitter. The unit of
// power (W or lm) cancels out. See docs/channel.md.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lichtmc/figure.hpp"

namespace lichtmc {

inline constexpr double speed_of_light = 299'792'458.0;  // m/s, in vacuum

// The frequencies first, first + step, … up to last, in Hz.
struct FrequencyRange {
  double first_hz = 0.0;  // ≥ 0
  double last_hz = 0.0;   // ≥ first_hz
  double step_hz = 0.0;   // > 0; 0: no frequencies

  std::size_t size() const {
    // A step that divides the range up to rounding reaches its end.
    constexpr double rounding = 1e-9;
    return step_hz > 0.0 ? static_cast<std::size_t>((last_hz - first_hz) / step_hz + rounding) + 1 : 0;
  }
  double operator[](std::size_t k) const { return first_hz + static_cast<double>(k) * step_hz; }
};

// What is resolved in time at the receivers; part of Settings.
struct ChannelSettings {
  std::optional<double> bin_width_s;  // s, > 0; none: no impulse responses are measured
  // s, > 0, rounded up to whole bins: later light is counted apart. None: chosen from the size and the reflectances of
  // the room.
  std::optional<double> time_span_s;
  std::uint32_t orders = 0;      // paths of 0, 1, … `orders` reflections are kept apart from each other and the rest
  bool per_emitter = false;      // each emitter has a channel of its own; emitters of the same name share one
  bool squared_weights = false;  // adds the rms delay spread with the weights h², which depends on the bin width
  FrequencyRange frequencies;    // at which the frequency response is accumulated

  bool wanted() const { return bin_width_s.has_value(); }
};

// The channel from one group of emitters to one receiver. Gains are of power: in dB, 10 log₁₀. Delays count from the
// emission; they include light of any delay and any number of reflections, also beyond the time span.
struct Channel {
  std::size_t emitter = 0;   // index into ImpulseResponses::emitters
  std::size_t receiver = 0;  // index into Result::receivers
  Figure gain;               // H(0) = line of sight + diffuse
  Figure line_of_sight;      // gain of the light without reflections
  Figure diffuse;            // gain of the light with at least one reflection
  Figure rician_k;           // line_of_sight / diffuse
  // The first arrival, s: exact if there is a line of sight to a point of the emitter that is nearest; else the
  // earliest contribution that was met, an upper bound. NaN: no light arrives.
  double first_arrival_s = std::numeric_limits<double>::quiet_NaN();
  bool first_arrival_is_exact = false;
  double first_reflection_s = std::numeric_limits<double>::quiet_NaN();  // the earliest reflected contribution met
  Figure mean_delay_s;                                                   // ∫ t h dt / ∫ h dt
  Figure mean_excess_delay_s;                                            // mean delay − first arrival
  Figure rms_delay_spread_s;                                             // √(∫ (t − mean)² h dt / ∫ h dt)
  Figure diffuse_mean_delay_s;  // the same for the light with at least one reflection
  Figure diffuse_rms_delay_spread_s;
  // With the weights h² instead of h, from the bins: only by ChannelSettings::squared_weights.
  Figure squared_rms_delay_spread_s;
  Figure squared_diffuse_rms_delay_spread_s;
  // The lowest frequency, Hz, at which |H(f)| is H(0)/√2 (−3 dB of electrical power) or H(0)/2 (−3 dB of optical
  // power). NaN: |H(f)| does not fall that low at the frequencies looked at.
  Figure bandwidth_electrical_hz;
  Figure bandwidth_optical_hz;
  Figure beyond;  // gain of the light later than the time span
};

// The impulse responses of all pairs of emitters and receivers. Arrays are in the order emitter, receiver, order, bin,
// the last one fastest.
struct ImpulseResponses {
  double bin_width_s = 0.0;  // bin i has the times [i, i + 1) · bin_width_s
  std::size_t bins = 0;
  bool time_span_was_chosen = false;  // ChannelSettings::time_span_s was not given
  std::uint32_t orders = 0;           // as ChannelSettings::orders
  std::vector<std::string> emitters;  // names; "all" if emitters are not kept apart
  std::vector<double> powers;         // of each, W or lm
  std::vector<double> delays_s;       // of each; NaN if its emitters have different ones
  std::vector<std::string> receivers;

  // h in 1/s: 0, 1, … `orders` reflections, and more than `orders` together.
  std::vector<double> h;
  std::vector<double> standard_error;
  // h of all reflections together, and its standard error: emitter, receiver, bin.
  std::vector<double> h_all;
  std::vector<double> standard_error_all;
  // The gain of each order at all times, and its part later than the time span: emitter, receiver, order.
  std::vector<Figure> order_gain;
  std::vector<Figure> order_beyond;
  // The earliest contribution of each order that was met, s; NaN: none. Order 0: as Channel::first_arrival_s.
  std::vector<double> order_first_s;

  // H(f): emitter, receiver, frequency. The frequencies asked for, or else those at which it was computed from h.
  std::vector<double> frequencies_hz;
  bool from_bins = false;  // whether it is the transform of h, otherwise accumulated path by path
  std::vector<std::complex<double>> response;
  std::vector<double> magnitude_error;  // standard error of |H(f)|

  std::vector<Channel> channels;  // emitter, receiver
  std::uint64_t groups = 0;       // groups of rounds whose differences give the errors of derived figures

  std::size_t columns() const { return std::size_t{orders} + 2; }
  std::size_t pair(std::size_t emitter, std::size_t receiver) const { return emitter * receivers.size() + receiver; }
  // The first bin of an order in `h`, and in `h_all`.
  std::size_t row(std::size_t emitter, std::size_t receiver, std::size_t order) const {
    return (pair(emitter, receiver) * columns() + order) * bins;
  }
  std::size_t row(std::size_t emitter, std::size_t receiver) const { return pair(emitter, receiver) * bins; }
  // "0", "1", … and "6+" for the rest.
  std::string order_name(std::size_t order) const { return std::to_string(order) + (order > orders ? "+" : ""); }
};

}  // namespace lichtmc
