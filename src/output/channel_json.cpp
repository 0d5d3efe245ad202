#include "output/channel_json.hpp"

#include <string>

#include "output/channel_figures.hpp"

namespace lichtmc {

namespace {

void add_figure(Json& json, const std::string& name, const Figure& figure) {
  json[name] = number(figure.value);
  json[name + std::string(standard_error_suffix)] = number(figure.standard_error);
}

}  // namespace

Json impulse_responses_of(const Result& result) {
  const ImpulseResponses& responses = *result.channels;
  Json emitters = Json::array();
  for (std::size_t e = 0; e < responses.emitters.size(); ++e) {
    emitters.push_back({{"name", responses.emitters[e]},
                        {"power", number(responses.powers[e])},
                        {"delay_s", number(responses.delays_s[e])}});
  }
  const std::size_t frequencies = responses.frequencies_hz.size();
  return {{"bin_width_s", number(responses.bin_width_s)},
          {"bins", responses.bins},
          {"time_span_s", number(static_cast<double>(responses.bins) * responses.bin_width_s)},
          {"time_span_was_chosen", responses.time_span_was_chosen},
          {"orders", responses.orders},
          {"emitters", emitters},
          {"frequencies", frequencies},
          {"response_from_bins", frequencies > 0 ? Json(responses.from_bins) : Json(nullptr)},
          {"groups", responses.groups}};
}

Json channel_of(const Result& result, std::size_t pair) {
  const ImpulseResponses& responses = *result.channels;
  const Channel& channel = responses.channels[pair];
  Json json{{"emitter", responses.emitters[channel.emitter]},
            {"receiver", responses.receivers[pair % responses.receivers.size()]}};
  for (const ChannelFigure& figure : channel_figures(result.settings.channel)) {
    const std::string name(figure.name);
    if (figure.has_error)
      add_figure(json, name, figure.of(channel));
    else
      json[name] = number(figure.of(channel).value);
    if (name == "first_arrival_s") json["first_arrival"] = std::string(first_arrival_word(channel));
  }
  Json orders = Json::array();
  for (std::size_t order = 0; order < responses.columns(); ++order) {
    const std::size_t k = pair * responses.columns() + order;
    Json one{{"order", responses.order_name(order)}};
    add_figure(one, "gain", responses.order_gain[k]);
    add_figure(one, "beyond_time_span", responses.order_beyond[k]);
    one["first_arrival_s"] = number(responses.order_first_s[k]);
    orders.push_back(one);
  }
  json["orders"] = orders;
  return json;
}

}  // namespace lichtmc
