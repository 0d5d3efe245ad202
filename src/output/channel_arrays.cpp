#include "output/channel_arrays.hpp"

#include <limits>
#include <utility>

#include "output/channel_figures.hpp"

namespace lichtmc {

namespace {

struct Dimensions {
  std::string names;
  std::vector<std::size_t> sizes;
};

class ArrayList {
 public:
  explicit ArrayList(const Result& result) : result_(&result), responses_(&*result.channels) {
    const std::size_t emitters = responses_->emitters.size();
    const std::size_t receivers = responses_->receivers.size();
    const std::size_t orders = responses_->columns();
    of_bins_ = {"emitter, receiver, bin", {emitters, receivers, responses_->bins}};
    of_orders_ = {"emitter, receiver, order", {emitters, receivers, orders}};
    of_order_bins_ = {"emitter, receiver, order, bin", {emitters, receivers, orders, responses_->bins}};
    of_pairs_ = {"emitter, receiver", {emitters, receivers}};
    of_frequencies_ = {"emitter, receiver, frequency", {emitters, receivers, responses_->frequencies_hz.size()}};
  }

  std::vector<NamedArray> make() {
    add_responses();
    add_times();
    add_orders();
    add_frequencies();
    add_emitters();
    add_receivers();
    add_derived();
    return std::move(arrays_);
  }

 private:
  void borrow(std::string name, std::string unit, const Dimensions& of, std::string what,
              std::span<const double> values) {
    arrays_.push_back({std::move(name), std::move(unit), of.names, std::move(what), of.sizes, {}, values});
  }
  void own(std::string name, std::string unit, const Dimensions& of, std::string what, std::vector<double> values) {
    arrays_.push_back({std::move(name), std::move(unit), of.names, std::move(what), of.sizes, std::move(values), {}});
  }
  // An array with one number for each of `things`.
  template <class Things, class Of>
  void collect(std::string name, std::string unit, const Dimensions& of, std::string what, const Things& things,
               const Of& value_of) {
    std::vector<double> values;
    values.reserve(things.size());
    for (const auto& thing : things) values.push_back(value_of(thing));
    own(std::move(name), std::move(unit), of, std::move(what), std::move(values));
  }
  void figures(const std::string& name, const std::string& unit, const Dimensions& of, const std::string& what,
               const std::vector<Figure>& all) {
    collect(name, unit, of, what, all, [](const Figure& figure) { return figure.value; });
    collect(name + std::string(standard_error_suffix), unit, of, "standard error of " + name, all,
            [](const Figure& figure) { return figure.standard_error; });
  }

  void add_responses() {
    borrow("h", "1/s", of_order_bins_,
           "impulse response by number of reflections: density of the gain, received power per time and per power of "
           "that emitter",
           responses_->h);
    borrow("standard_error", "1/s", of_order_bins_, "standard error of h", responses_->standard_error);
    borrow("h_all", "1/s", of_bins_, "impulse response, all orders together", responses_->h_all);
    borrow("standard_error_all", "1/s", of_bins_, "standard error of h_all", responses_->standard_error_all);
  }

  void add_times() {
    const std::size_t bins = responses_->bins;
    std::vector<double> edges_s, edges_m, middles;
    for (std::size_t k = 0; k <= bins; ++k) {
      edges_s.push_back(static_cast<double>(k) * responses_->bin_width_s);
      edges_m.push_back(edges_s.back() * speed_of_light);
      if (k < bins) middles.push_back((static_cast<double>(k) + 0.5) * responses_->bin_width_s);
    }
    own("t", "s", {"bin", {bins}}, "middle of each bin; t = 0 is the emission", std::move(middles));
    own("bin_edges_s", "s", {"edge", {bins + 1}}, "bin i has the times from edge i up to, without, edge i + 1",
        std::move(edges_s));
    own("bin_edges_m", "m", {"edge", {bins + 1}}, "the same as lengths of paths from emitters without a delay",
        std::move(edges_m));
    own("bin_width_s", "s", {}, "width of a bin", {responses_->bin_width_s});
    own("speed_of_light", "m/s", {}, "speed of light in vacuum", {speed_of_light});
  }

  void add_orders() {
    figures("order_gain", "1", of_orders_, "gain of each order, light of all times", responses_->order_gain);
    figures("order_beyond_time_span", "1", of_orders_, "its part later than the time span", responses_->order_beyond);
    borrow("order_first_arrival_s", "s", of_orders_,
           "earliest contribution of each order that was met, an upper bound of the first arrival; NaN: none",
           responses_->order_first_s);
  }

  void add_frequencies() {
    const std::size_t count = responses_->frequencies_hz.size();
    if (count == 0) return;
    const std::string how = responses_->from_bins ? ", computed from h" : ", summed path by path";
    borrow("frequencies_hz", "Hz", {"frequency", {count}}, "frequencies of the response", responses_->frequencies_hz);
    collect("response_real", "1", of_frequencies_, "real part of H(f), the integral of h exp(-2 pi i f t)" + how,
            responses_->response, [](const std::complex<double>& value) { return value.real(); });
    collect("response_imag", "1", of_frequencies_, "imaginary part of H(f)" + how, responses_->response,
            [](const std::complex<double>& value) { return value.imag(); });
    if (!responses_->magnitude_error.empty())
      borrow("magnitude_standard_error", "1", of_frequencies_, "standard error of |H(f)|", responses_->magnitude_error);
  }

  void add_emitters() {
    const Dimensions of{"emitter", {responses_->emitters.size()}};
    borrow("emitter_power", std::string(power_unit(result_->quantity)), of, "power of the emitters of each channel",
           responses_->powers);
    borrow("emitter_delay_s", "s", of, "delay of their emission, which h includes; NaN: it differs between them",
           responses_->delays_s);
  }

  void add_receivers() {
    // The receivers of the channels of the first emitter.
    std::vector<const Receiver*> receivers;
    for (std::size_t r = 0; r < responses_->receivers.size(); ++r)
      receivers.push_back(&result_->receivers[responses_->channels[r].receiver]);
    const Dimensions of{"receiver", {receivers.size()}};
    const Dimensions of_axes{"receiver, axis", {receivers.size(), 3}};
    const auto vectors = [&](glm::dvec3 Receiver::*member) {
      std::vector<double> values;
      for (const Receiver* r : receivers) values.insert(values.end(), {(r->*member).x, (r->*member).y, (r->*member).z});
      return values;
    };
    own("receiver_position_m", "m", of_axes, "position; glTF axes, Y up", vectors(&Receiver::position));
    own("receiver_normal", "1", of_axes, "axis of the field of view, of any length", vectors(&Receiver::normal));
    collect("receiver_area_m2", "m^2", of, "area", receivers, [](const Receiver* r) { return r->area_m2; });
    collect("receiver_half_angle_deg", "degrees", of, "half angle of the field of view", receivers,
            [](const Receiver* r) { return r->half_angle_deg; });
    collect("receiver_concentrator_index", "1", of, "refractive index of the concentrator; NaN: none", receivers,
            [](const Receiver* r) { return r->concentrator_index.value_or(std::numeric_limits<double>::quiet_NaN()); });
    collect("receiver_filter_gain", "1", of, "gain of the filter", receivers,
            [](const Receiver* r) { return r->filter_gain; });
    collect("receiver_optical_gain", "1", of, "gain of concentrator and filter, which h includes", receivers,
            [](const Receiver* r) { return r->optical_gain(); });
  }

  void add_derived() {
    const std::string group(derived_group);
    for (const ChannelFigure& figure : channel_figures(result_->settings.channel)) {
      const std::string name = group + std::string(figure.name);
      const std::string unit(figure.unit);
      collect(name, unit, of_pairs_, std::string(figure.description), responses_->channels,
              [&](const Channel& channel) { return figure.of(channel).value; });
      if (!figure.has_error) continue;
      collect(name + std::string(standard_error_suffix), unit, of_pairs_,
              "standard error of " + std::string(figure.name), responses_->channels,
              [&](const Channel& channel) { return figure.of(channel).standard_error; });
    }
    collect(group + "first_arrival_is_exact", "1", of_pairs_, "1: first_arrival_s is exact; 0: it is an upper bound",
            responses_->channels, [](const Channel& channel) { return channel.first_arrival_is_exact ? 1.0 : 0.0; });
  }

  const Result* result_;
  const ImpulseResponses* responses_;
  Dimensions of_bins_, of_orders_, of_order_bins_, of_pairs_, of_frequencies_;
  std::vector<NamedArray> arrays_;
};

}  // namespace

std::vector<NamedArray> channel_arrays(const Result& result) {
  return ArrayList(result).make();
}

std::vector<std::string> order_names(const ImpulseResponses& responses) {
  std::vector<std::string> names;
  for (std::size_t order = 0; order < responses.columns(); ++order) names.push_back(responses.order_name(order));
  return names;
}

}  // namespace lichtmc
