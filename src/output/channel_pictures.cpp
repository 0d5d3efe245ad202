#include "output/channel_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/message.hpp"
#include "output/channel_figures.hpp"
#include "output/chart.hpp"
#include "output/readable.hpp"

namespace lichtmc {

namespace {

constexpr double per_ns = 1e9;
constexpr double per_mhz = 1e-6;
constexpr std::size_t max_columns = 1200;  // sufficient for a chart as wide as a page
constexpr std::size_t max_orders = 6;      // shown apart: as many colours as can be distinguished, without the rest

// Some bins as the columns of a chart.
class Columns {
 public:
  explicit Columns(const ImpulseResponses& responses)
      : responses_(&responses), bins_each_((responses.bins + max_columns - 1) / max_columns) {}

  std::size_t bins_each() const { return bins_each_; }
  std::size_t count() const { return (responses_->bins + bins_each_ - 1) / bins_each_; }
  double start_ns(std::size_t column) const {
    return static_cast<double>(std::min(column * bins_each_, responses_->bins)) * responses_->bin_width_s * per_ns;
  }
  // The mean of each column's bins.
  std::vector<double> means(std::span<const double> bins) const {
    std::vector<double> means;
    for (std::size_t first = 0; first < bins.size(); first += bins_each_) {
      const std::size_t end = std::min(bins.size(), first + bins_each_);
      double sum = 0.0;
      for (std::size_t k = first; k < end; ++k) sum += bins[k];
      means.push_back(sum / static_cast<double>(end - first));
    }
    return means;
  }

 private:
  const ImpulseResponses* responses_;
  std::size_t bins_each_;
};

std::string times_label(const ImpulseResponses& responses, const Columns& columns) {
  std::string label = "time after the emission, ns (bins of " + short_number(responses.bin_width_s * per_ns) + " ns";
  if (columns.bins_each() > 1) label += ", means of " + std::to_string(columns.bins_each());
  return label + ")";
}

void mark_line_of_sight(const Channel& channel, LineChart& chart) {
  if (channel.line_of_sight.value > 0.0) chart.x_marks.push_back({channel.first_arrival_s * per_ns, "line of sight"});
}

std::string gain_note(const Channel& channel) {
  const Figure gain = in_db(channel.gain);
  return "H(0): " + with_error(gain.value, gain.standard_error) + " dB (10 log₁₀).";
}

std::vector<std::string> delay_notes(const ImpulseResponses& responses, const Channel& channel) {
  std::vector<std::string> notes{gain_note(channel)};
  const auto in_ns = [](const Figure& figure) {
    return with_error(figure.value * per_ns, figure.standard_error * per_ns) + " ns";
  };
  if (channel.line_of_sight.value > 0.0)
    notes.push_back("Line of sight: " + percent(channel.line_of_sight.value / channel.gain.value) + " of it.");
  notes.push_back("First arrival: " + std::string(channel.first_arrival_is_exact ? "" : "at the latest ") +
                  rounded(channel.first_arrival_s * per_ns, 6) + " ns.");
  notes.push_back("Mean excess delay: " + in_ns(channel.mean_excess_delay_s) +
                  "; rms delay spread: " + in_ns(channel.rms_delay_spread_s) + ", with the weights h.");
  notes.push_back("Later than " + short_number(static_cast<double>(responses.bins) * responses.bin_width_s * per_ns) +
                  " ns: " + percent(channel.beyond.value / channel.gain.value) + " of the gain.");
  return notes;
}

// h(t) of all orders. Steps show that a value belongs to a whole bin.
std::string response_picture(const ImpulseResponses& responses, std::size_t pair) {
  const Channel& channel = responses.channels[pair];
  const Columns columns(responses);
  const std::size_t row = pair * responses.bins;
  const std::vector<double> h = columns.means(std::span(responses.h_all).subspan(row, responses.bins));
  const std::vector<double> error = columns.means(std::span(responses.standard_error_all).subspan(row, responses.bins));
  double high = 0.0;
  double low = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < h.size(); ++k) {
    high = std::max(high, h[k]);
    if (h[k] > 0.0 && !(error[k] >= h[k])) low = std::min(low, h[k]);  // values of one impact would stretch the axis
  }
  ChartSeries series{columns.bins_each() > 1 ? "all orders, with the error of a bin" : "all orders ± standard error",
                     {},
                     false,
                     true,
                     {}};
  low = std::pow(10.0, std::floor(std::log10(low)));  // the lower end of the axis
  // Beside bins without light, light that is not noise goes down to the axis: an instant line of sight is a peak.
  const auto is_peak = [&](std::size_t k) { return h[k] > 3.0 * error[k]; };
  for (std::size_t k = 0; k < h.size(); ++k) {
    const bool rises = h[k] > 0.0 && (k == 0 || !(h[k - 1] > 0.0)) && is_peak(k);
    const bool falls = k > 0 && h[k - 1] > 0.0 && !(h[k] > 0.0) && is_peak(k - 1);
    if (rises || falls) series.points.push_back({columns.start_ns(k), low});
    for (const double x : {columns.start_ns(k), columns.start_ns(k + 1)}) {
      series.points.push_back({x, h[k]});
      series.band.push_back({x, h[k] - error[k], h[k] + error[k]});
    }
  }
  LineChart chart;
  chart.title = "Impulse response " + channel_name(responses, pair);
  chart.x_label = times_label(responses, columns);
  chart.y_label = "h, 1/s (power received per time and per emitted power)";
  chart.x_scale = Scale::linear;
  chart.series = {series};
  chart.y_limits = ChartLimits{low, high};
  chart.notes = delay_notes(responses, channel);
  mark_line_of_sight(channel, chart);
  return to_svg(chart);
}

// The orders that are shown: 0, 1, … and the rest, each as the mean of its columns.
std::vector<std::vector<double>> shown_orders(const ImpulseResponses& responses, std::size_t pair,
                                              const Columns& columns) {
  std::vector<std::vector<double>> orders;
  for (std::size_t order = 0; order < responses.columns(); ++order) {
    const std::size_t row = (pair * responses.columns() + order) * responses.bins;
    std::vector<double> means = columns.means(std::span(responses.h).subspan(row, responses.bins));
    if (orders.size() <= max_orders) {
      orders.push_back(std::move(means));
    } else {
      for (std::size_t k = 0; k < means.size(); ++k) orders.back()[k] += means[k];
    }
  }
  return orders;
}

std::string order_text(const ImpulseResponses& responses, std::size_t order) {
  if (order == 0) return "line of sight";
  const bool rest = order == std::min<std::size_t>(max_orders, responses.orders + 1);
  if (rest) return to_text(order, "reflection") + " and more";
  return to_text(order, "reflection");
}

std::string orders_picture(const ImpulseResponses& responses, std::size_t pair) {
  const Channel& channel = responses.channels[pair];
  const Columns columns(responses);
  const std::vector<std::vector<double>> orders = shown_orders(responses, pair, columns);
  double reflected = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < columns.count(); ++k) {
    double sum = 0.0;
    for (std::size_t order = 1; order < orders.size(); ++order) sum += orders[order][k];
    reflected = std::max(reflected, sum);
    all = std::max(all, sum + orders[0][k]);
  }
  LineChart chart;
  chart.title = "Light by number of reflections " + channel_name(responses, pair);
  chart.x_label = times_label(responses, columns);
  chart.y_label = "h, 1/s";
  chart.x_scale = chart.y_scale = Scale::linear;
  std::vector<double> sum(columns.count(), 0.0);
  for (std::size_t order = 0; order < orders.size(); ++order) {
    ChartArea area{order_text(responses, order), {}};
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const double low = sum[k];
      sum[k] += orders[order][k];
      for (const double x : {columns.start_ns(k), columns.start_ns(k + 1)}) area.range.push_back({x, low, sum[k]});
    }
    chart.areas.push_back(std::move(area));
  }
  // The line of sight would make the rest invisible.
  constexpr double cut_above = 1.5;
  constexpr double space = 1.05;
  const bool cut = reflected > 0.0 && all > cut_above * reflected;
  chart.y_limits = ChartLimits{0.0, space * (cut ? reflected : all)};
  if (cut) chart.notes.push_back("The line of sight reaches up to " + short_number(all) + " /s: it is cut off.");
  chart.notes.push_back("The areas lie on each other: the upper edge is h of all orders.");
  mark_line_of_sight(channel, chart);
  return to_svg(chart);
}

std::string frequency_picture(const ImpulseResponses& responses, std::size_t pair) {
  const std::size_t count = responses.frequencies_hz.size();
  if (count == 0) return {};
  const Channel& channel = responses.channels[pair];
  const double gain = channel.gain.value;
  const auto db = [gain](double magnitude) {
    return magnitude > 0.0 ? 10.0 * std::log10(magnitude / gain) : -std::numeric_limits<double>::infinity();
  };
  constexpr double lowest_db = -30.0;
  ChartSeries series{"|H(f)| / H(0)", {}, false, true, {}};
  double low = -4.0;  // both marks are visible
  for (std::size_t k = 0; k < count; ++k) {
    const double x = responses.frequencies_hz[k] * per_mhz;
    const double magnitude = std::abs(responses.response[pair * count + k]);
    series.points.push_back({x, db(magnitude)});
    low = std::min(low, db(magnitude));
    if (responses.magnitude_error.empty()) continue;
    const double error = responses.magnitude_error[pair * count + k];
    series.band.push_back({x, std::max(lowest_db - 1.0, db(magnitude - error)), db(magnitude + error)});
  }
  series.name += series.band.empty() ? "" : " ± standard error";
  LineChart chart;
  chart.title = "Frequency response " + channel_name(responses, pair);
  chart.x_label = "frequency, MHz";
  chart.y_label = "|H(f)| / H(0), dB of optical power (10 log₁₀)";
  chart.x_scale = chart.y_scale = Scale::linear;
  chart.series = {series};
  chart.y_limits = ChartLimits{std::max(low, lowest_db), 0.0};
  chart.y_marks = {{db(gain / std::sqrt(2.0)), "−3 dB electrical"}, {db(0.5 * gain), "−3 dB optical"}};
  const auto bandwidth = [&](const Figure& figure) {
    return std::isfinite(figure.value)
               ? with_error(figure.value * per_mhz, figure.standard_error * per_mhz) + " MHz."
               : "none up to " + short_number(responses.frequencies_hz.back() * per_mhz) + " MHz.";
  };
  chart.notes = {gain_note(channel),
                 "Bandwidth at −3 dB of electrical power, |H| = H(0)/√2: " + bandwidth(channel.bandwidth_electrical_hz),
                 "At −3 dB of optical power, |H| = H(0)/2: " + bandwidth(channel.bandwidth_optical_hz),
                 responses.from_bins ? "Computed from the bins of h." : "Summed path by path, without bins."};
  return to_svg(chart);
}

}  // namespace

std::string channel_name(const ImpulseResponses& responses, std::size_t pair) {
  const std::string to = "to " + in_quotes(responses.receivers[pair % responses.receivers.size()]);
  const std::string& emitter = responses.emitters[responses.channels[pair].emitter];
  if (responses.emitters.size() == 1 && emitter == "all") return to;
  return "from " + in_quotes(emitter) + " " + to;
}

std::vector<std::size_t> shown_channels(const ImpulseResponses& responses) {
  std::vector<std::size_t> lit;
  for (std::size_t pair = 0; pair < responses.channels.size(); ++pair) {
    if (responses.channels[pair].gain.value > 0.0) lit.push_back(pair);
  }
  if (lit.empty()) return {};
  const auto [lowest, highest] = std::minmax_element(lit.begin(), lit.end(), [&](std::size_t a, std::size_t b) {
    return responses.channels[a].gain.value < responses.channels[b].gain.value;
  });
  if (*lowest == *highest) return {*highest};
  return {*highest, *lowest};
}

ChannelPictures channel_pictures(const Result& result, std::size_t pair) {
  const ImpulseResponses& responses = *result.channels;
  return {pair, response_picture(responses, pair), orders_picture(responses, pair), frequency_picture(responses, pair)};
}

}  // namespace lichtmc
