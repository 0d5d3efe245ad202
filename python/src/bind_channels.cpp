// Impulse responses of a result.
#include <nanobind/stl/complex.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "figures.hpp"
#include "lichtmc/channel.hpp"
#include "run_result.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

struct Channels {
  RunResultPtr run;

  const ImpulseResponses& responses() const { return *run->result.channels; }
  std::size_t emitters() const { return responses().emitters.size(); }
  std::size_t receivers() const { return responses().receivers.size(); }
};

auto of_pairs(Figure Channel::*member) {
  return [member](const Channels& channels) {
    return figures_of(channels.run, channels.responses().channels, member, {channels.emitters(), channels.receivers()});
  };
}

View<double> number_of_pairs(const Channels& channels, double Channel::*member) {
  const std::vector<Channel>& all = channels.responses().channels;
  constexpr std::int64_t step = sizeof(Channel) / sizeof(double);
  return strided(channels.run, all.empty() ? nullptr : &(all.front().*member),
                 std::array<std::size_t, 2>{channels.emitters(), channels.receivers()},
                 std::array<std::int64_t, 2>{static_cast<std::int64_t>(channels.receivers()) * step, step});
}

Figures of_orders(const Channels& channels, const std::vector<Figure>& figures) {
  return {channels.run,
          figures.empty() ? nullptr : figures.data(),
          sizeof(Figure) / sizeof(double),
          {channels.emitters(), channels.receivers(), channels.responses().columns()}};
}

// emitter, receiver, order, bin.
View<double> by_order(const Channels& channels, const std::vector<double>& values) {
  const ImpulseResponses& all = channels.responses();
  return shaped(channels.run, values,
                std::array<std::size_t, 4>{channels.emitters(), channels.receivers(), all.columns(), all.bins});
}

// emitter, receiver, then `last`.
template <class Scalar>
View<Scalar> by_pair(const Channels& channels, const std::vector<Scalar>& values, std::size_t last) {
  return shaped(channels.run, values, std::array<std::size_t, 3>{channels.emitters(), channels.receivers(), last});
}

View<double> bin_middles(const Channels& channels) {
  const ImpulseResponses& all = channels.responses();
  std::vector<double> middles(all.bins);
  for (std::size_t i = 0; i < all.bins; ++i) middles[i] = (static_cast<double>(i) + 0.5) * all.bin_width_s;
  return owned(std::move(middles), std::array<std::size_t, 1>{all.bins});
}

void bind_axes(nb::class_<Channels>& of) {
  of.def_prop_ro("time", &bin_middles, has_owner,
                 "Middles of the bins, s, float64 (bins,): the time since the emission of the pulse.")
      .def_prop_ro(
          "bin_width", [](const Channels& channels) { return channels.responses().bin_width_s; }, "Width of a bin, s.")
      .def_prop_ro(
          "time_span",
          [](const Channels& channels) {
            return static_cast<double>(channels.responses().bins) * channels.responses().bin_width_s;
          },
          "End of the last bin, s. Later light is in `beyond`.")
      .def_prop_ro(
          "emitters", [](const Channels& channels) { return channels.responses().emitters; },
          "Names of the emitters, in the order of the first axis; 'all' if they are not kept apart.")
      .def_prop_ro(
          "receivers", [](const Channels& channels) { return channels.responses().receivers; },
          "Names of the receivers, in the order of the second axis.")
      .def_prop_ro(
          "orders",
          [](const Channels& channels) {
            const ImpulseResponses& all = channels.responses();
            std::vector<std::string> names;
            for (std::size_t order = 0; order < all.columns(); ++order) names.push_back(all.order_name(order));
            return names;
          },
          "Numbers of reflections, in the order of the third axis: '0', '1', …, and '2+' for the rest.")
      .def_prop_ro(
          "powers",
          [](const Channels& channels) {
            return shaped(channels.run, channels.responses().powers, std::array<std::size_t, 1>{channels.emitters()});
          },
          has_owner, "Powers of the emitters, W or lm, float64 (E,).")
      .def_prop_ro(
          "delays",
          [](const Channels& channels) {
            return shaped(channels.run, channels.responses().delays_s, std::array<std::size_t, 1>{channels.emitters()});
          },
          has_owner, "Delays of the emitters, s, float64 (E,). NaN: the emitters of a name have different ones.");
}

void bind_responses(nb::class_<Channels>& of) {
  of.def_prop_ro(
        "h", [](const Channels& channels) { return by_order(channels, channels.responses().h); }, has_owner,
        "Impulse response by order of reflection, 1/s, float64 (E, R, O, B): emitter, receiver, order, bin. "
        "Received power per time over the energy of a short pulse at t = 0.")
      .def_prop_ro(
          "standard_error",
          [](const Channels& channels) { return by_order(channels, channels.responses().standard_error); }, has_owner,
          "Standard errors of h, 1/s, float64 (E, R, O, B).")
      .def_prop_ro(
          "h_all",
          [](const Channels& channels) {
            return by_pair(channels, channels.responses().h_all, channels.responses().bins);
          },
          has_owner, "Impulse response of all orders together, 1/s, float64 (E, R, B).")
      .def_prop_ro(
          "standard_error_all",
          [](const Channels& channels) {
            return by_pair(channels, channels.responses().standard_error_all, channels.responses().bins);
          },
          has_owner, "Standard errors of h_all, 1/s, float64 (E, R, B).")
      .def_prop_ro(
          "frequencies",
          [](const Channels& channels) {
            return shaped(channels.run, channels.responses().frequencies_hz,
                          std::array<std::size_t, 1>{channels.responses().frequencies_hz.size()});
          },
          has_owner,
          "Frequencies of the response, Hz, float64 (F,): those asked for, or those at which it was "
          "computed from h.")
      .def_prop_ro(
          "response",
          [](const Channels& channels) {
            return by_pair(channels, channels.responses().response, channels.responses().frequencies_hz.size());
          },
          has_owner, "Frequency response H(f), complex128 (E, R, F). H(0) is the gain.")
      .def_prop_ro(
          "magnitude_error",
          [](const Channels& channels) {
            return by_pair(channels, channels.responses().magnitude_error, channels.responses().frequencies_hz.size());
          },
          has_owner, "Standard errors of |H(f)|, float64 (E, R, F).")
      .def_prop_ro(
          "from_bins", [](const Channels& channels) { return channels.responses().from_bins; },
          "Whether the response is the transform of h; otherwise it was accumulated path by path.");
}

void bind_derived(nb::class_<Channels>& of) {
  of.def_prop_ro(
        "gain", of_pairs(&Channel::gain),
        "H(0), received power over emitted power; in dB 10 log10. Figures of shape (E, R), as all that follow.")
      .def_prop_ro("line_of_sight", of_pairs(&Channel::line_of_sight), "Gain of the light without reflection.")
      .def_prop_ro("diffuse", of_pairs(&Channel::diffuse), "Gain of the light with at least one reflection.")
      .def_prop_ro("rician_k", of_pairs(&Channel::rician_k), "line_of_sight / diffuse.")
      .def_prop_ro("mean_delay", of_pairs(&Channel::mean_delay_s), "∫ t h dt / ∫ h dt, s.")
      .def_prop_ro("mean_excess_delay", of_pairs(&Channel::mean_excess_delay_s), "mean_delay − first_arrival, s.")
      .def_prop_ro("rms_delay_spread", of_pairs(&Channel::rms_delay_spread_s), "√(∫ (t − mean)² h dt / ∫ h dt), s.")
      .def_prop_ro("diffuse_mean_delay", of_pairs(&Channel::diffuse_mean_delay_s),
                   "mean_delay of the light with at least one reflection, s.")
      .def_prop_ro("diffuse_rms_delay_spread", of_pairs(&Channel::diffuse_rms_delay_spread_s),
                   "rms_delay_spread of the light with at least one reflection, s.")
      .def_prop_ro("squared_rms_delay_spread", of_pairs(&Channel::squared_rms_delay_spread_s),
                   "rms_delay_spread with the weights h², s. NaN unless the run had squared_weights=True.")
      .def_prop_ro("squared_diffuse_rms_delay_spread", of_pairs(&Channel::squared_diffuse_rms_delay_spread_s),
                   "diffuse_rms_delay_spread with the weights h², s. NaN unless the run had squared_weights=True.")
      .def_prop_ro("bandwidth_electrical", of_pairs(&Channel::bandwidth_electrical_hz),
                   "Lowest frequency at which |H(f)| is H(0)/√2, Hz: −3 dB of electrical power. NaN: |H(f)| does not "
                   "fall that low at the frequencies looked at.")
      .def_prop_ro("bandwidth_optical", of_pairs(&Channel::bandwidth_optical_hz),
                   "Lowest frequency at which |H(f)| is H(0)/2, Hz: −3 dB of optical power. NaN as above.")
      .def_prop_ro("beyond", of_pairs(&Channel::beyond), "Gain of the light later than the time span.")
      .def_prop_ro(
          "order_gain", [](const Channels& channels) { return of_orders(channels, channels.responses().order_gain); },
          "Gain of each order of reflection. Figures of shape (E, R, O).")
      .def_prop_ro(
          "order_beyond",
          [](const Channels& channels) { return of_orders(channels, channels.responses().order_beyond); },
          "Part of order_gain later than the time span. Figures of shape (E, R, O).")
      .def_prop_ro(
          "first_arrival",
          [](const Channels& channels) { return number_of_pairs(channels, &Channel::first_arrival_s); }, has_owner,
          "First arrival of light, s, float64 (E, R): exact with a line of sight, else the earliest "
          "contribution that was met, an upper bound. NaN: no light arrives.")
      .def_prop_ro(
          "first_reflection",
          [](const Channels& channels) { return number_of_pairs(channels, &Channel::first_reflection_s); }, has_owner,
          "The earliest reflected contribution that was met, s, float64 (E, R); NaN: none.");
}

}  // namespace

void bind_channels(nb::module_& module) {
  nb::class_<Channels> channels(
      module, "Channels",
      "The impulse responses from emitters to receivers, and what follows from them. Arrays show the memory of the "
      "result without copies, read-only; E emitters (1 unless the run had per_emitter=True), R receivers, O orders of "
      "reflection, B bins, F frequencies. Gains are received over emitted power, whatever the unit of power.");
  bind_axes(channels);
  bind_responses(channels);
  bind_derived(channels);
  channels.def("__repr__", [](const Channels& of) {
    const ImpulseResponses& all = of.responses();
    return "Channels(" + std::to_string(of.emitters()) + (of.emitters() == 1 ? " emitter" : " emitters") + ", " +
           std::to_string(of.receivers()) + (of.receivers() == 1 ? " receiver" : " receivers") + ", " +
           std::to_string(all.columns()) + " orders, " + std::to_string(all.bins) + " bins of " +
           nb::repr(nb::float_(all.bin_width_s)).c_str() + " s)";
  });
  nb::borrow<nb::class_<RunResult>>(nb::type<RunResult>())
      .def_prop_ro(
          "channels",
          [](const RunResultPtr& run) {
            return run->result.channels ? std::optional<Channels>(Channels{run}) : std::nullopt;
          },
          "Impulse responses at the receivers; None unless the run had impulse_response=….");
}

}  // namespace lichtmc::python
