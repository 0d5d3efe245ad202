// Settings of a run, from the keyword arguments of simulate().
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bindings.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/settings.hpp"
#include "named_values.hpp"
#include "settings.hpp"

namespace lichtmc::python {

namespace {

using Histories = std::array<std::uint64_t, 2>;
using Frequencies = std::array<double, 3>;

// The limit of photons: without any stop rule a million, as in C++; with another rule none.
std::uint64_t photon_limit(std::optional<std::uint64_t> photons, bool other_rule) {
  if (photons) return *photons;
  return other_rule ? no_photon_limit : Settings{}.photons;
}

void set_histories(Settings& settings, const Histories& histories) {
  const auto [first, last] = histories;
  if (last <= first)
    throw InputError("The range of histories (" + std::to_string(first) + ", " + std::to_string(last) +
                     ") is empty (allowed: a first history, and a larger number behind the last one). Give a larger "
                     "second number.");
  settings.first_history = first;
  settings.photons = last - first;
  settings.part = true;
}

template <class Value>
nb::object number_or_none(const std::optional<Value>& value) {
  return value ? nb::cast(*value) : nb::none();
}

}  // namespace

nb::dict keywords_of(const Settings& s) {
  nb::dict words;
  const bool limited = !s.part && s.photons != no_photon_limit;
  words["photons"] = limited ? nb::cast(s.photons) : nb::none();
  words["target_error"] = number_or_none(s.target_error);
  words["max_time"] = number_or_none(s.max_seconds);
  words["seed"] = s.seed;
  words["threads"] = s.threads;
  words["estimator"] = to_string(s.estimator);
  words["engine"] = to_string(s.engine);
  words["tile"] = s.tile_edge_m;
  words["only"] = to_string(s.measured);
  words["tile_walk"] = to_string(s.tile_walk);
  words["receiver_walk"] = to_string(s.receiver_walk);
  words["direct"] = to_string(s.direct);
  words["max_bounces"] = number_or_none(s.max_bounces);
  words["error_floor"] = number_or_none(s.error_floor);
  words["error_floor_share"] = s.error_floor_share;
  words["histories"] = s.part ? nb::object(nb::make_tuple(s.first_history, s.first_history + s.photons)) : nb::none();
  words["impulse_response"] = number_or_none(s.channel.bin_width_s);
  words["time_span"] = number_or_none(s.channel.time_span_s);
  words["orders"] = s.channel.orders;
  const FrequencyRange& range = s.channel.frequencies;
  words["frequencies"] =
      range.size() > 0 ? nb::object(nb::make_tuple(range.first_hz, range.last_hz, range.step_hz)) : nb::none();
  words["squared_weights"] = s.channel.squared_weights;
  words["per_emitter"] = s.per_emitter || s.channel.per_emitter;
  return words;
}

void bind_settings(nb::module_& module) {
  nb::class_<Settings> settings(module, "Settings",
                                "The settings of a run: the arguments of simulate(), under their names.");
  const auto add = [&settings](const char* name, const auto& value) {
    settings.def_prop_ro(name, value, "See simulate().");
  };
  add("photons", [](const Settings& s) -> std::optional<std::uint64_t> {
    if (s.part || s.photons == no_photon_limit) return std::nullopt;
    return s.photons;
  });
  add("target_error", [](const Settings& s) { return s.target_error; });
  add("max_time", [](const Settings& s) { return s.max_seconds; });
  add("seed", [](const Settings& s) { return s.seed; });
  add("threads", [](const Settings& s) { return s.threads; });
  add("estimator", [](const Settings& s) { return to_string(s.estimator); });
  add("engine", [](const Settings& s) { return to_string(s.engine); });
  add("tile", [](const Settings& s) { return s.tile_edge_m; });
  add("only", [](const Settings& s) { return to_string(s.measured); });
  add("tile_walk", [](const Settings& s) { return to_string(s.tile_walk); });
  add("receiver_walk", [](const Settings& s) { return to_string(s.receiver_walk); });
  add("direct", [](const Settings& s) { return to_string(s.direct); });
  add("max_bounces", [](const Settings& s) { return s.max_bounces; });
  add("error_floor", [](const Settings& s) { return s.error_floor; });
  add("error_floor_share", [](const Settings& s) { return s.error_floor_share; });
  add("histories", [](const Settings& s) -> std::optional<Histories> {
    if (!s.part) return std::nullopt;
    return Histories{s.first_history, s.first_history + s.photons};
  });
  add("impulse_response", [](const Settings& s) { return s.channel.bin_width_s; });
  add("time_span", [](const Settings& s) { return s.channel.time_span_s; });
  add("orders", [](const Settings& s) { return s.channel.orders; });
  add("frequencies", [](const Settings& s) -> std::optional<Frequencies> {
    const FrequencyRange& range = s.channel.frequencies;
    if (range.size() == 0) return std::nullopt;
    return Frequencies{range.first_hz, range.last_hz, range.step_hz};
  });
  add("squared_weights", [](const Settings& s) { return s.channel.squared_weights; });
  add("per_emitter", [](const Settings& s) { return s.per_emitter || s.channel.per_emitter; });
  module.def(
      "make_settings",
      [](std::optional<std::uint64_t> photons, std::optional<double> target_error, std::optional<double> max_time,
         std::uint64_t seed, unsigned threads, std::string_view estimator, std::string_view engine, double tile,
         std::string_view only, std::string_view tile_walk, std::string_view receiver_walk, std::string_view direct,
         std::optional<std::uint32_t> max_bounces, std::optional<double> error_floor, double error_floor_share,
         std::optional<Histories> histories, std::optional<double> impulse_response, std::optional<double> time_span,
         std::uint32_t orders, std::optional<Frequencies> frequencies, bool squared_weights, bool per_emitter) {
        Settings s;
        if (photons && histories)
          throw InputError(
              "photons and histories both set the number of histories (allowed: one of them). Leave one out.");
        s.photons = photon_limit(photons, target_error.has_value() || max_time.has_value());
        if (histories) set_histories(s, *histories);
        s.target_error = target_error;
        s.max_seconds = max_time;
        s.seed = seed;
        s.threads = threads;
        s.estimator = named("estimator", estimator,
                            {Estimator::automatic, Estimator::weight, Estimator::collision, Estimator::absorption});
        s.engine = named("engine", engine, {Engine::automatic, Engine::cuboid, Engine::embree, Engine::embree_fast});
        s.tile_edge_m = tile;
        s.measured = named("only", only, {Measured::all, Measured::tiles, Measured::receivers});
        s.tile_walk = named("tile_walk", tile_walk, {WalkDirection::forward, WalkDirection::backward});
        s.receiver_walk =
            named("receiver_walk", receiver_walk,
                  {ReceiverWalk::automatic, ReceiverWalk::two_way, ReceiverWalk::next_event, ReceiverWalk::backward});
        s.direct = named("direct", direct, {Direct::sampled, Direct::analytic});
        s.max_bounces = max_bounces;
        s.error_floor = error_floor;
        s.error_floor_share = error_floor_share;
        s.channel.bin_width_s = impulse_response;
        s.channel.time_span_s = time_span;
        s.channel.orders = orders;
        if (frequencies) s.channel.frequencies = {(*frequencies)[0], (*frequencies)[1], (*frequencies)[2]};
        s.channel.squared_weights = squared_weights;
        // With impulse responses every emitter has a channel of its own instead.
        (impulse_response ? s.channel.per_emitter : s.per_emitter) = per_emitter;
        return s;
      },
      nb::kw_only(), nb::arg("photons").none(), nb::arg("target_error").none(), nb::arg("max_time").none(),
      nb::arg("seed"), nb::arg("threads"), nb::arg("estimator"), nb::arg("engine"), nb::arg("tile"), nb::arg("only"),
      nb::arg("tile_walk"), nb::arg("receiver_walk"), nb::arg("direct"), nb::arg("max_bounces").none(),
      nb::arg("error_floor").none(), nb::arg("error_floor_share"), nb::arg("histories").none(),
      nb::arg("impulse_response").none(), nb::arg("time_span").none(), nb::arg("orders"), nb::arg("frequencies").none(),
      nb::arg("squared_weights"), nb::arg("per_emitter"),
      "The settings with these arguments of simulate(), which documents them.");
}

}  // namespace lichtmc::python
