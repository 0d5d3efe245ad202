#include "output/channel_figures.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace lichtmc {

namespace {

template <Figure Channel::*member>
Figure member_of(const Channel& channel) {
  return channel.*member;
}

// In the order of the columns. The last two require ChannelSettings::squared_weights.
constexpr std::array figures{
    ChannelFigure{"gain", "1", "H(0), received over emitted power: line of sight and diffuse light of all times", true,
                  member_of<&Channel::gain>},
    ChannelFigure{"gain_db", "dB", "10 log10 H(0)", true, [](const Channel& channel) { return in_db(channel.gain); }},
    ChannelFigure{"line_of_sight", "1", "gain of the light without reflections", true,
                  member_of<&Channel::line_of_sight>},
    ChannelFigure{"diffuse", "1", "gain of the light with at least one reflection", true, member_of<&Channel::diffuse>},
    ChannelFigure{"rician_k", "1", "line_of_sight / diffuse, a ratio of powers", true, member_of<&Channel::rician_k>},
    ChannelFigure{"first_arrival_s", "s", "first arrival after the emission, exact or an upper bound", false,
                  [](const Channel& channel) { return Figure{channel.first_arrival_s}; }},
    ChannelFigure{"first_reflection_s", "s", "earliest reflected contribution that was met, an upper bound", false,
                  [](const Channel& channel) { return Figure{channel.first_reflection_s}; }},
    ChannelFigure{"mean_delay_s", "s", "mean delay with the weights h, after the emission", true,
                  member_of<&Channel::mean_delay_s>},
    ChannelFigure{"mean_excess_delay_s", "s", "mean delay after the first arrival", true,
                  member_of<&Channel::mean_excess_delay_s>},
    ChannelFigure{"rms_delay_spread_s", "s", "rms delay spread with the weights h", true,
                  member_of<&Channel::rms_delay_spread_s>},
    ChannelFigure{"diffuse_mean_delay_s", "s", "mean delay of the light with at least one reflection", true,
                  member_of<&Channel::diffuse_mean_delay_s>},
    ChannelFigure{"diffuse_rms_delay_spread_s", "s",
                  "rms delay spread of the light with at least one reflection, with the weights h", true,
                  member_of<&Channel::diffuse_rms_delay_spread_s>},
    ChannelFigure{"bandwidth_electrical_hz", "Hz", "lowest frequency at which |H(f)| is H(0)/sqrt(2)", true,
                  member_of<&Channel::bandwidth_electrical_hz>},
    ChannelFigure{"bandwidth_optical_hz", "Hz", "lowest frequency at which |H(f)| is H(0)/2", true,
                  member_of<&Channel::bandwidth_optical_hz>},
    ChannelFigure{"beyond_time_span", "1", "gain of the light later than the time span", true,
                  member_of<&Channel::beyond>},
    ChannelFigure{"squared_rms_delay_spread_s", "s",
                  "rms delay spread with the weights h^2 of the bins; it depends on the bin width", true,
                  member_of<&Channel::squared_rms_delay_spread_s>},
    ChannelFigure{"squared_diffuse_rms_delay_spread_s", "s", "the same of the light with at least one reflection", true,
                  member_of<&Channel::squared_diffuse_rms_delay_spread_s>},
};

}  // namespace

std::span<const ChannelFigure> channel_figures(const ChannelSettings& settings) {
  return std::span<const ChannelFigure>(figures).first(figures.size() - (settings.squared_weights ? 0 : 2));
}

std::string_view first_arrival_word(const Channel& channel) {
  if (std::isnan(channel.first_arrival_s)) return "none";
  return channel.first_arrival_is_exact ? "exact" : "upper-bound";
}

Figure in_db(const Figure& gain) {
  if (!(gain.value > 0.0)) return {};
  return {10.0 * std::log10(gain.value), 10.0 / std::numbers::ln10 * gain.standard_error / gain.value};
}

}  // namespace lichtmc
