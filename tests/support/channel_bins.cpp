#include "support/channel_bins.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>

namespace lichtmc::test {

Bins bins_of(const ImpulseResponses& found, std::size_t emitter, std::size_t receiver,
             std::optional<std::size_t> order) {
  const std::size_t first = order ? found.row(emitter, receiver, *order) : found.row(emitter, receiver);
  Bins bins;
  for (std::size_t k = first; k < first + found.bins; ++k) {
    bins.gain.push_back(found.bin_width_s * (order ? found.h[k] : found.h_all[k]));
    bins.error.push_back(found.bin_width_s * (order ? found.standard_error[k] : found.standard_error_all[k]));
  }
  return bins;
}

Bins bins_of(const std::map<std::string, std::vector<double>>& table, const std::string& column) {
  Bins bins{table.at(column), {}};
  const auto errors = table.find("se_" + column);
  bins.error = errors == table.end() ? std::vector<double>(bins.gain.size(), 0.0) : errors->second;
  return bins;
}

std::vector<Compared> against(const Bins& found, const Bins& expected) {
  constexpr double small = 0.1;
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < std::min(found.gain.size(), expected.gain.size()); ++k) {
    const double least = small * std::min(found.gain[k], expected.gain[k]);
    if (found.error[k] > 0.0 && found.error[k] < least && expected.error[k] < least)
      figures.push_back({found.gain[k], found.error[k], expected.gain[k], expected.error[k]});
  }
  return figures;
}

Bins with_times(const Bins& bins, double factor, double later_bins) {
  const std::size_t n = bins.gain.size();
  Bins moved{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  for (std::size_t k = 0; k < n; ++k) {
    const double begin = factor * static_cast<double>(k) + later_bins;
    const double end = begin + factor;
    for (auto to = static_cast<std::size_t>(begin); to < n && static_cast<double>(to) < end; ++to) {
      const auto low = static_cast<double>(to);
      const double share = (std::min(end, low + 1.0) - std::max(begin, low)) / factor;
      moved.gain[to] += share * bins.gain[k];
      moved.error[to] += share * share * bins.error[k] * bins.error[k];
    }
  }
  for (double& error : moved.error) error = std::sqrt(error);
  return moved;
}

namespace {

bool same(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}
bool same(const std::complex<double>& a, const std::complex<double>& b) {
  return same(a.real(), b.real()) && same(a.imag(), b.imag());
}
bool same(const Figure& a, const Figure& b) {
  return same(a.value, b.value) && same(a.standard_error, b.standard_error);
}
bool same(const std::string& a, const std::string& b) {
  return a == b;
}

bool same(const Channel& a, const Channel& b) {
  for (const auto figure : {&Channel::gain, &Channel::line_of_sight, &Channel::diffuse, &Channel::rician_k,
                            &Channel::mean_delay_s, &Channel::mean_excess_delay_s, &Channel::rms_delay_spread_s,
                            &Channel::diffuse_mean_delay_s, &Channel::diffuse_rms_delay_spread_s,
                            &Channel::squared_rms_delay_spread_s, &Channel::squared_diffuse_rms_delay_spread_s,
                            &Channel::bandwidth_electrical_hz, &Channel::bandwidth_optical_hz, &Channel::beyond}) {
    if (!same(a.*figure, b.*figure)) return false;
  }
  return a.emitter == b.emitter && a.receiver == b.receiver && same(a.first_arrival_s, b.first_arrival_s) &&
         a.first_arrival_is_exact == b.first_arrival_is_exact && same(a.first_reflection_s, b.first_reflection_s);
}

template <class T>
bool all_same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return same(x, y); });
}

}  // namespace

bool same_channels(const Result& one, const Result& other) {
  if (one.channels.has_value() != other.channels.has_value()) return false;
  if (!one.channels) return true;
  const ImpulseResponses& a = *one.channels;
  const ImpulseResponses& b = *other.channels;
  return same(a.bin_width_s, b.bin_width_s) && a.bins == b.bins && a.orders == b.orders && a.groups == b.groups &&
         a.from_bins == b.from_bins && a.time_span_was_chosen == b.time_span_was_chosen &&
         all_same(a.emitters, b.emitters) && all_same(a.powers, b.powers) && all_same(a.delays_s, b.delays_s) &&
         all_same(a.receivers, b.receivers) && all_same(a.h, b.h) && all_same(a.standard_error, b.standard_error) &&
         all_same(a.h_all, b.h_all) && all_same(a.standard_error_all, b.standard_error_all) &&
         all_same(a.order_gain, b.order_gain) && all_same(a.order_beyond, b.order_beyond) &&
         all_same(a.order_first_s, b.order_first_s) && all_same(a.frequencies_hz, b.frequencies_hz) &&
         all_same(a.response, b.response) && all_same(a.magnitude_error, b.magnitude_error) &&
         all_same(a.channels, b.channels);
}

}  // namespace lichtmc::test
