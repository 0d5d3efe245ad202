#include "run/channel_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "run/channel_figures.hpp"
#include "run/channel_sight.hpp"
#include "run/jackknife.hpp"

namespace lichtmc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The frequencies at which the response is computed from bins: up to a fourth of the rate of the coarse bins, whose
// differences give its error.
std::vector<double> usual_frequencies(const ChannelAxes& axes) {
  constexpr std::size_t steps = 100;
  const double highest = 0.25 / (axes.bin_width_s * static_cast<double>(std::uint64_t{1} << axes.coarse_shift));
  std::vector<double> frequencies;
  for (std::size_t k = 0; k <= steps; ++k) frequencies.push_back(highest * static_cast<double>(k) / steps);
  return frequencies;
}

// All channels of one receiver.
class ReceiverChannels {
 public:
  ReceiverChannels(const ChannelInput& input, const Jackknife& jackknife, std::size_t receiver, ImpulseResponses& out)
      : in_(input), axes_(input.axes), jackknife_(jackknife), receiver_(receiver), out_(out) {
    if (jackknife.all() > 2) student_ = student_factor(static_cast<double>(jackknife.all()) - 1.0);
  }

  void compute() {
    const Room& room = in_.context.room;
    const Receiver& receiver = room.receivers[receiver_];
    const Stream stream(in_.context.settings.seed, WalkDirection::backward);
    LineOfSight sight;
    sight.first.resize(axes_.groups);
    if (receiver.half_angle_deg > 0.0) {
      sight =
          line_of_sight(room, axes_, in_.light, *in_.context.scene.tracer, in_.receivers[receiver_], stream, receiver_);
    }
    match_direct(sight, in_.direct[receiver_]);
    for (std::uint32_t group = 0; group < axes_.groups; ++group) {
      const double power = out_.powers[group];
      gain_ = power > 0.0 ? receiver.area_m2 * receiver.optical_gain() / power : 0.0;
      group_ = group;
      pair_ = axes_.pair(receiver_, group);
      compute_pair(sight_of_group(sight, group, gain_, axes_, out_.frequencies_hz), sight.first[group]);
    }
  }

 private:
  // A gain and its standard error from sums over rounds.
  Figure gain_of(const BackwardSums& sums) const {
    const double unit = in_.scale.unit * gain_;
    const auto n = static_cast<long double>(jackknife_.all());
    Figure figure{static_cast<double>(static_cast<long double>(sums.sum) / n) * unit, nan};
    if (jackknife_.all() >= 2) figure.standard_error = sums.error_of_mean(jackknife_.all()) * unit * student_;
    return figure;
  }

  static Figure sum_of(const Figure& a, const Figure& b) {
    return {a.value + b.value, std::hypot(a.standard_error, b.standard_error)};
  }

  DelayMoments moments_of(std::size_t j) const {
    const MomentSums& sums = in_.sums.moments[pair_ * jackknife_groups + j];
    const double unit = in_.scale.unit * gain_;
    const double second = in_.scale.length_m / speed_of_light;
    return {static_cast<double>(sums.weight) * unit, static_cast<double>(sums.first) * unit * second,
            static_cast<double>(sums.second) * unit * second * second};
  }

  // The gains in the bins of a row, the last for later light.
  std::vector<Figure> gains_of(std::size_t row) const {
    std::vector<Figure> gains(axes_.bins_of_row());
    const BackwardSums* sums = in_.sums.bins.data() + row * axes_.bins_of_row();
    for (std::size_t b = 0; b < gains.size(); ++b) gains[b] = gain_of(sums[b]);
    return gains;
  }

  std::vector<Figure> gains_of(const SightOfChannel& sight) const {
    std::vector<Figure> gains(axes_.bins_of_row(), Figure{0.0, 0.0});
    for (const auto& [bin, gain] : sight.exact_bins) gains[bin].value += gain;
    for (const auto& [bin, sets] : sight.bins) {
      const Figure sampled = mean_of_sets(sets);
      gains[bin].value += sampled.value;
      gains[bin].standard_error = sampled.standard_error;
    }
    return gains;
  }

  // h of every order and of all. diffuse: the gains of all reflections.
  void fill_bins(const SightOfChannel& sight, const std::vector<Figure>& diffuse, Channel& channel) {
    const std::vector<Figure> of_sight = gains_of(sight);
    const std::size_t first_order = out_.pair(group_, receiver_) * out_.columns();
    for (std::uint32_t order = 0; order < out_.columns(); ++order) {
      const std::size_t row = axes_.row(pair_, order == 0 ? 0 : axes_.column_of(order));
      const bool is_all = order > 0 && axes_.columns == 1;
      const std::vector<Figure> gains = order == 0 ? of_sight : is_all ? diffuse : gains_of(row);
      for (std::size_t b = 0; b < axes_.bins; ++b)
        set(out_.h, out_.standard_error, out_.row(group_, receiver_, order) + b, gains[b]);
      out_.order_beyond[first_order + order] = gains[axes_.bins];
      out_.order_gain[first_order + order] = order == 0 ? sight_gain(sight) : gain_of(in_.sums.columns[row]);
      const double first = in_.sums.earliest[row].length_m() / speed_of_light;
      if (order > 0 && std::isfinite(first)) out_.order_first_s[first_order + order] = first;
    }
    for (std::size_t b = 0; b < axes_.bins; ++b)
      set(out_.h_all, out_.standard_error_all, out_.row(group_, receiver_) + b, sum_of(of_sight[b], diffuse[b]));
    channel.beyond = sum_of(of_sight[axes_.bins], diffuse[axes_.bins]);
  }

  void set(std::vector<double>& values, std::vector<double>& errors, std::size_t k, const Figure& gain) const {
    values[k] = gain.value / axes_.bin_width_s;
    errors[k] = gain.standard_error / axes_.bin_width_s;
  }

  Figure sight_gain(const SightOfChannel& sight) const {
    if (!sight.sampled) return {sight.moments.weight, 0.0};
    if (axes_.groups == 1) return {sight.moments.weight, in_.direct[receiver_].standard_error * gain_};
    std::array<double, jackknife_groups> weights{};
    for (std::size_t k = 0; k < weights.size(); ++k) weights[k] = sight.of_set[k].weight;
    return {sight.moments.weight, mean_of_sets(weights).standard_error};
  }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  // Calls add(number of the pair's group of rounds) for all but one; returns the factor of their sums to gains.
  template <class Add>
  double add_groups(std::size_t without, const Add& add) const {
    std::uint64_t rounds = 0;
    for (const std::size_t j : jackknife_.groups()) {
      if (j == without) continue;
      rounds += jackknife_.rounds_of(j);
      add(pair_ * jackknife_groups + j);
    }
    return in_.scale.unit * gain_ / static_cast<double>(rounds);
  }

  // Bins of the diffuse part as gains, coarse ones: of all rounds or without a group.
  std::vector<double> coarse_bins(std::size_t without) const {
    std::vector<double> sums(axes_.coarse_bins, 0.0);
    const double factor = add_groups(without, [&](std::size_t group) {
      const uint128* own = in_.sums.coarse.data() + group * axes_.coarse_bins;
      for (std::size_t b = 0; b < sums.size(); ++b) sums[b] += static_cast<double>(own[b]);
    });
    for (double& one : sums) one *= factor;
    return sums;
  }
  double coarse_width_s() const {
    return axes_.bin_width_s * static_cast<double>(std::uint64_t{1} << axes_.coarse_shift);
  }

  // The diffuse response accumulated path by path: of all rounds or without a group.
  Response accumulated(std::size_t without) const {
    Response sums(axes_.frequency_count);
    const double factor = add_groups(without, [&](std::size_t group) {
      const int128* own = in_.sums.response.data() + group * axes_.frequency_count * 2;
      for (std::size_t f = 0; f < sums.size(); ++f)
        sums[f] += std::complex<double>(static_cast<double>(own[2 * f]), static_cast<double>(own[2 * f + 1]));
    });
    for (std::complex<double>& one : sums) one *= factor;
    return sums;
  }

  // By how much a set of the 32 counts in the jackknife over g groups of rounds, so that it gives the variance of the
  // mean of all sets: with the pseudo-values (g − 1) l d_j of their deviations d_j it gives l² (g − 1) mean(d²), to be
  // mean(d²)/31. With 32 groups it is that of leaving out a set, 1/31.
  double sight_leverage() const {
    const double groups = std::max(2.0, static_cast<double>(jackknife_.groups().size()));
    return 1.0 / std::sqrt((jackknife_groups - 1.0) * (groups - 1.0));
  }

  void add_sight(Response& response, const SightOfChannel& sight, std::size_t without) const {
    for (std::size_t f = 0; f < response.size(); ++f) response[f] += sight.response[f];
    if (!sight.sampled || without == none) return;
    for (std::size_t f = 0; f < response.size(); ++f)
      response[f] += (sight.mean_of_sets[f] - sight.response_of_set[without][f]) * sight_leverage();
  }

  // H(f), its error, and the bandwidths.
  // gains_without: H(0) without each group of rounds.
  void fill_response(const SightOfChannel& sight, const std::vector<Figure>& diffuse,
                     const std::vector<double>& gains_without, Channel& channel) const {
    const std::vector<double>& frequencies = out_.frequencies_hz;
    if (frequencies.empty()) return;
    Response whole;
    std::vector<Response> without;
    if (out_.from_bins) {
      whole = transform(values_of(diffuse), axes_.bin_width_s, frequencies);
      const Response coarse = transform(coarse_bins(none), coarse_width_s(), frequencies);
      for (const std::size_t j : jackknife_.groups()) {
        without.push_back(transform(coarse_bins(j), coarse_width_s(), frequencies));
        for (std::size_t f = 0; f < coarse.size(); ++f) without.back()[f] += whole[f] - coarse[f];
      }
    } else {
      whole = accumulated(none);
      for (const std::size_t j : jackknife_.groups()) without.push_back(accumulated(j));
    }
    add_sight(whole, sight, none);
    for (std::size_t k = 0; k < without.size(); ++k) add_sight(without[k], sight, jackknife_.groups()[k]);

    const std::size_t first = out_.pair(group_, receiver_) * frequencies.size();
    std::vector<double> of_groups(without.size());
    for (std::size_t f = 0; f < frequencies.size(); ++f) {
      for (std::size_t k = 0; k < without.size(); ++k) of_groups[k] = std::abs(without[k][f]);
      out_.response[first + f] = whole[f];
      out_.magnitude_error[first + f] = jackknife_.figure(std::abs(whole[f]), of_groups).standard_error;
    }
    // H(0) of the same parts; with frequencies of the user's choice 0 may not be among them.
    const auto at_level = [&](double level, Figure& figure) {
      const auto of = [&](const Response& response, double dc) {
        return frequency_of_level(response, frequencies, level * dc);
      };
      const double dc = out_.from_bins ? std::abs(whole[0]) : channel.gain.value;
      for (std::size_t k = 0; k < without.size(); ++k) {
        const double own = out_.from_bins ? std::abs(without[k][0]) : gains_without[k];
        of_groups[k] = of(without[k], own);
      }
      figure = jackknife_.figure(of(whole, dc), of_groups);
    };
    at_level(std::sqrt(0.5), channel.bandwidth_electrical_hz);
    at_level(0.5, channel.bandwidth_optical_hz);
  }

  // The bins of the time span.
  std::vector<double> values_of(const std::vector<Figure>& gains) const {
    std::vector<double> values(axes_.bins);
    for (std::size_t b = 0; b < values.size(); ++b) values[b] = gains[b].value;
    return values;
  }

  void fill_squared(const SightOfChannel& sight, const std::vector<Figure>& gains, Channel& channel) const {
    const double width = axes_.bin_width_s;
    const std::vector<double> diffuse = values_of(gains);
    std::vector<double> variance(axes_.bins);
    for (std::size_t b = 0; b < variance.size(); ++b) variance[b] = gains[b].standard_error * gains[b].standard_error;
    const auto with_sight = [&](std::vector<double> bins) {
      for (const auto& [bin, gain] : sight.exact_bins) {
        if (bin < bins.size()) bins[bin] += gain;
      }
      for (const auto& [bin, sets] : sight.bins) {
        if (bin < bins.size()) bins[bin] += std::accumulate(sets.begin(), sets.end(), 0.0) / jackknife_groups;
      }
      return bins;
    };
    std::vector<double> of_all;
    std::vector<double> of_diffuse;
    const double share = static_cast<double>(jackknife_.groups().size());
    std::vector<double> more = variance;  // of the means without a group
    for (double& one : more) one *= share / (share - 1.0);
    for (const std::size_t j : jackknife_.groups()) {
      const std::vector<double> bins = coarse_bins(j);  // as fine as the others: see ChannelAxes
      of_diffuse.push_back(squared_rms_spread_s(bins, &more, width));
      of_all.push_back(squared_rms_spread_s(with_sight(bins), &more, width));
    }
    channel.squared_diffuse_rms_delay_spread_s =
        jackknife_.figure(squared_rms_spread_s(diffuse, &variance, width), of_diffuse);
    channel.squared_rms_delay_spread_s =
        jackknife_.figure(squared_rms_spread_s(with_sight(diffuse), &variance, width), of_all);
  }

  void fill_arrivals(const FirstSight& first, Channel& channel) const {
    double reflected = std::numeric_limits<double>::infinity();
    for (std::uint32_t column = 0; column < axes_.columns; ++column)
      reflected = std::min(reflected, in_.sums.earliest[axes_.row(pair_, column)].length_m());
    if (std::isfinite(reflected)) channel.first_reflection_s = reflected / speed_of_light;
    const double length = std::min(first.length_m, reflected);
    channel.first_arrival_is_exact = first.exact && first.length_m <= reflected;
    if (std::isfinite(length)) channel.first_arrival_s = length / speed_of_light;
    if (std::isfinite(first.length_m))
      out_.order_first_s[out_.pair(group_, receiver_) * out_.columns()] = first.length_m / speed_of_light;
  }

  // Figures of the moments, and their errors. Returns the gains without each group of rounds.
  std::vector<double> fill_delays(const SightOfChannel& sight, Channel& channel) const {
    const auto n = static_cast<double>(jackknife_.all());
    DelayMoments sum;
    for (const std::size_t j : jackknife_.groups()) sum += moments_of(j);
    const DelayMoments diffuse = sum * (1.0 / n);
    DelayMoments whole = diffuse;
    whole += sight.moments;
    enum { mean, rms, diffuse_mean, diffuse_rms, k_factor, figures };
    std::array<std::vector<double>, figures> without;
    std::vector<double> gains;
    for (const std::size_t j : jackknife_.groups()) {
      const DelayMoments rest = (sum - moments_of(j)) * (1.0 / (n - static_cast<double>(jackknife_.rounds_of(j))));
      const DelayMoments own_sight = sight.without_set(j, sight_leverage());
      DelayMoments all = rest;
      all += own_sight;
      without[mean].push_back(all.mean_s());
      without[rms].push_back(all.rms_spread_s());
      without[diffuse_mean].push_back(rest.mean_s());
      without[diffuse_rms].push_back(rest.rms_spread_s());
      without[k_factor].push_back(own_sight.weight / rest.weight);
      gains.push_back(all.weight);
    }
    channel.mean_delay_s = jackknife_.figure(whole.mean_s(), without[mean]);
    channel.mean_excess_delay_s = {channel.mean_delay_s.value - channel.first_arrival_s,
                                   channel.mean_delay_s.standard_error};
    channel.rms_delay_spread_s = jackknife_.figure(whole.rms_spread_s(), without[rms]);
    channel.diffuse_mean_delay_s = jackknife_.figure(diffuse.mean_s(), without[diffuse_mean]);
    channel.diffuse_rms_delay_spread_s = jackknife_.figure(diffuse.rms_spread_s(), without[diffuse_rms]);
    if (diffuse.weight > 0.0)
      channel.rician_k = jackknife_.figure(sight.moments.weight / diffuse.weight, without[k_factor]);
    return gains;
  }

  void compute_pair(const SightOfChannel& sight, const FirstSight& first) {
    Channel& channel = out_.channels[out_.pair(group_, receiver_)];
    channel.emitter = group_;
    channel.receiver = receiver_;
    const std::vector<Figure> diffuse = gains_of(axes_.row(pair_, axes_.all_column()));
    fill_bins(sight, diffuse, channel);
    channel.line_of_sight = sight_gain(sight);
    channel.diffuse = gain_of(in_.sums.columns[axes_.row(pair_, axes_.all_column())]);
    channel.gain = sum_of(channel.line_of_sight, channel.diffuse);
    if (axes_.groups == 1) match_gain(channel);
    fill_arrivals(first, channel);
    const std::vector<double> gains_without = fill_delays(sight, channel);
    fill_response(sight, diffuse, gains_without, channel);
    if (in_.context.settings.channel.squared_weights) fill_squared(sight, diffuse, channel);
  }

  // All emitters together are the receiver's gain: the same digits.
  void match_gain(Channel& channel) const {
    const ReceiverResult& receiver = in_.irradiance[receiver_];
    channel.line_of_sight.value = receiver.direct * gain_;
    channel.diffuse.value = receiver.indirect * gain_;
    channel.gain = {receiver.irradiance * gain_, receiver.standard_error * gain_};
  }

  const ChannelInput& in_;
  const ChannelAxes& axes_;
  const Jackknife& jackknife_;
  std::size_t receiver_;
  ImpulseResponses& out_;
  double student_ = 1.0;  // of errors from all rounds
  // Of the channel that is computed:
  std::uint32_t group_ = 0;
  std::size_t pair_ = 0;
  double gain_ = 0.0;  // received power over emitted power, for an irradiance of 1
};

}  // namespace

ImpulseResponses channel_results(const ChannelInput& input) {
  const Room& room = input.context.room;
  const ChannelAxes& axes = input.axes;
  ImpulseResponses out;
  out.bin_width_s = axes.bin_width_s;
  out.bins = axes.bins;
  out.time_span_was_chosen = !input.context.settings.channel.time_span_s;
  out.orders = axes.orders;
  out.emitters = axes.group_names;
  out.powers.resize(axes.groups, 0.0);
  out.delays_s.resize(axes.groups, -1.0);
  for (std::size_t n = 0; n < room.emitters.size(); ++n) {
    out.powers[axes.group_of_emitter[n]] += room.emitters[n].power;
    double& delay = out.delays_s[axes.group_of_emitter[n]];
    const double own = room.emitters[n].delay_s;
    delay = delay == -1.0 || delay == own ? own : nan;
  }
  for (const Receiver& receiver : room.receivers) out.receivers.push_back(receiver.name);
  const std::size_t pairs = axes.groups * room.receivers.size();
  out.h.resize(pairs * out.columns() * out.bins);
  out.standard_error.resize(out.h.size());
  out.h_all.resize(pairs * out.bins);
  out.standard_error_all.resize(out.h_all.size());
  out.order_gain.resize(pairs * out.columns());
  out.order_beyond.resize(pairs * out.columns());
  out.order_first_s.resize(pairs * out.columns(), nan);
  out.channels.resize(pairs);
  out.from_bins = axes.frequency_count == 0;
  if (out.from_bins) out.frequencies_hz = usual_frequencies(axes);
  for (std::size_t f = 0; f < axes.frequency_count; ++f) out.frequencies_hz.push_back(axes.frequencies[f]);
  out.response.resize(pairs * out.frequencies_hz.size());
  out.magnitude_error.resize(out.response.size(), nan);
  const Jackknife jackknife(rounds_by_turns(input.rounds, jackknife_groups));
  out.groups = jackknife.groups().size();
  for_each_on_threads(input.context.threads, room.receivers.size(),
                      [&](std::size_t k) { ReceiverChannels(input, jackknife, k, out).compute(); });
  return out;
}

}  // namespace lichtmc
