#include "output/report_channels.hpp"

#include <algorithm>
#include <cmath>

#include "base/message.hpp"
#include "output/channel_figures.hpp"
#include "output/html.hpp"
#include "output/readable.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t max_rows = 16;  // more are not read on a page; channels.csv has all

// A cell with a figure and, below it, its error; sortable.
std::string figure_cell(const Figure& figure, double scale = 1.0) {
  constexpr std::string_view sign = " ± ";
  std::string text = with_error(scale * figure.value, scale * figure.standard_error);
  if (const std::size_t at = text.find(sign); at != std::string::npos)
    text = text.substr(0, at) + "<br>" + element("small", text.substr(at + 1));
  if (!std::isfinite(figure.value)) return element("td", text);
  return element("td", text, " data-value=\"" + to_text(figure.value) + "\"");
}

std::string arrival_cell(const Channel& channel) {
  if (std::isnan(channel.first_arrival_s)) return element("td", "–");
  return element("td", (channel.first_arrival_is_exact ? "" : "≤ ") + rounded(1e9 * channel.first_arrival_s, 6),
                 " data-value=\"" + to_text(channel.first_arrival_s) + "\"");
}

std::string table(const ImpulseResponses& responses) {
  constexpr double ns = 1e9;
  constexpr double mhz = 1e-6;
  std::string rows;
  for (std::size_t pair = 0; pair < std::min(max_rows, responses.channels.size()); ++pair) {
    const Channel& c = responses.channels[pair];
    const Figure beyond{c.beyond.value / c.gain.value, c.beyond.standard_error / c.gain.value};
    rows += "<tr>" + text_cell(responses.emitters[c.emitter]) +
            text_cell(responses.receivers[pair % responses.receivers.size()]) + figure_cell(in_db(c.gain)) +
            figure_cell(in_db(c.line_of_sight)) + figure_cell(c.rician_k) + arrival_cell(c) +
            figure_cell(c.mean_excess_delay_s, ns) + figure_cell(c.rms_delay_spread_s, ns) +
            figure_cell(c.diffuse_rms_delay_spread_s, ns) + figure_cell(c.bandwidth_electrical_hz, mhz) +
            figure_cell(c.bandwidth_optical_hz, mhz) + figure_cell(beyond, 100.0) + "</tr>\n";
  }
  return element(
      "div",
      element("table",
              table_head({"emitter", "receiver", "H(0), dB", "line of sight, dB", "Rician K", "first arrival, ns",
                          "mean excess delay, ns", "rms delay spread, ns", "diffuse rms delay spread, ns",
                          "−3 dB electrical, MHz", "−3 dB optical, MHz", "beyond the time span, %"}) +
                  element("tbody", rows),
              " class=\"sortable\" id=\"channels\""),
      " class=\"scroll\"");
}

// Which channels the table has, and where the others are.
std::string extent_text(const ImpulseResponses& responses) {
  const std::size_t count = responses.channels.size();
  const std::string files =
      "channels.csv contains all figures, impulse_response.csv, channels.h5 and channels.mat contain h(t).";
  if (count <= max_rows) return files;
  return "The first " + std::to_string(max_rows) + " of " + to_text(count, "channel") + ". " + files;
}

std::string beyond_text(const ImpulseResponses& responses) {
  double largest = 0.0;
  for (const Channel& channel : responses.channels) {
    if (channel.gain.value > 0.0) largest = std::max(largest, channel.beyond.value / channel.gain.value);
  }
  const std::string span = short_number(1e9 * static_cast<double>(responses.bins) * responses.bin_width_s) + " ns";
  return "Bins of " + short_number(1e9 * responses.bin_width_s) + " ns up to " + span +
         (responses.time_span_was_chosen ? ", chosen from the size and the reflectances of the room" : "") +
         ": of the gain of a channel at most " + percent(largest) +
         " arrives later. It is part of the figures in the table, and of no bin.";
}

std::string conventions_text(const ImpulseResponses& responses) {
  std::string text =
      "h(t) is the power that a receiver gets per time, divided by the power of the emitter: its integral is the gain "
      "H(0). t = 0 is the emission";
  const bool delayed =
      std::any_of(responses.delays_s.begin(), responses.delays_s.end(), [](double delay) { return !(delay == 0.0); });
  text += delayed ? "; the delays of the emitters are included. " : ". ";
  return text +
         "Decibels are 10 log₁₀ of a ratio of powers. Delays and spreads are moments with the weights h, of light of "
         "all "
         "times and any number of reflections. First arrival: with “≤” the earliest contribution that was met, an "
         "upper "
         "bound. Bandwidths: |H(f)| = H(0)/√2 (electrical) and H(0)/2 (optical). “–”: the figure does not exist; for a "
         "bandwidth, |H(f)| does not fall that low. Errors are standard errors; those of neighbouring bins are "
         "correlated, so that they do not add up in quadrature.";
}

}  // namespace

std::string channels_section(const ReportContent& content) {
  if (!content.result->channels) return {};
  const ImpulseResponses& responses = *content.result->channels;
  std::string html = heading("Channels") + text_element("p", extent_text(responses), " class=\"muted\"") +
                     table(responses) + text_element("p", beyond_text(responses)) +
                     text_element("p", conventions_text(responses), " class=\"muted\"");
  for (std::size_t k = 0; k < content.channels.size(); ++k) {
    const ChannelPictures& pictures = content.channels[k];
    if (content.channels.size() > 1)
      html +=
          text_element("h3", (k == 0 ? "Highest gain: " : "Lowest gain: ") + channel_name(responses, pictures.pair));
    for (const std::string& picture : {pictures.response, pictures.by_order, pictures.frequency}) {
      if (!picture.empty()) html += element("figure", picture);
    }
  }
  return html;
}

}  // namespace lichtmc
