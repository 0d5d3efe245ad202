#include "output/channel_tables.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "base/message.hpp"
#include "output/channel_figures.hpp"
#include "output/table_rows.hpp"

namespace lichtmc {

void write_impulse_responses_csv(const Result& result, const Sink& sink) {
  const ImpulseResponses& responses = *result.channels;
  // The fields before the time, for each emitter, receiver and order; at last all orders together.
  const std::size_t columns = responses.columns() + 1;
  std::vector<std::string> starts;
  for (const std::string& emitter : responses.emitters) {
    for (const std::string& receiver : responses.receivers) {
      const std::string pair = csv_field(emitter) + ',' + csv_field(receiver) + ',';
      for (std::size_t order = 0; order < columns - 1; ++order) starts.push_back(pair + responses.order_name(order));
      starts.push_back(pair + "all");
    }
  }
  std::vector<std::string> times;
  for (std::size_t bin = 0; bin < responses.bins; ++bin)
    times.push_back(to_text((static_cast<double>(bin) + 0.5) * responses.bin_width_s));
  sink("emitter,receiver,order,time_s,h,standard_error\n");
  const auto row = [&](std::size_t i, std::string& rows) {
    const std::size_t start = i / responses.bins;
    const std::size_t bin = i % responses.bins;
    const std::size_t pair = start / columns;
    const std::size_t order = start % columns;
    const bool all = order == columns - 1;
    const std::size_t at = (all ? pair : pair * (columns - 1) + order) * responses.bins + bin;
    append_row(rows, starts[start], times[bin], to_text(all ? responses.h_all[at] : responses.h[at]),
               to_text(all ? responses.standard_error_all[at] : responses.standard_error[at]));
  };
  write_rows(std::max(1U, result.threads), starts.size() * responses.bins, row, sink);
}

void write_channels_csv(const Result& result, const Sink& sink) {
  const ImpulseResponses& responses = *result.channels;
  const auto figures = channel_figures(result.settings.channel);
  std::string line = "emitter,receiver";
  for (const ChannelFigure& figure : figures) {
    const std::string name(figure.name);
    line += ',' + name;
    if (figure.has_error) line += ',' + name + std::string(standard_error_suffix);
    if (name == "first_arrival_s") line += ",first_arrival";
  }
  sink(line + '\n');
  for (std::size_t pair = 0; pair < responses.channels.size(); ++pair) {
    const Channel& channel = responses.channels[pair];
    line = csv_field(responses.emitters[channel.emitter]) + ',' +
           csv_field(responses.receivers[pair % responses.receivers.size()]);
    for (const ChannelFigure& figure : figures) {
      const Figure value = figure.of(channel);
      line += ',' + to_text(value.value);
      if (figure.has_error) line += ',' + to_text(value.standard_error);
      if (figure.name == "first_arrival_s") line += ',' + std::string(first_arrival_word(channel));
    }
    sink(line + '\n');
  }
}

}  // namespace lichtmc
