// Settings of a run, from the keyword arguments of simulate().
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/settings.hpp"
#include "named_values.hpp"

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

// The methods that **settings and dict(settings) need.
void bind_keys(nb::class_<Settings>& settings, const std::vector<std::string>& names) {
  settings
      .def(
          "keys", [names](const Settings& /*s*/) { return names; }, "The names of the settings.")
      .def("__len__", [names](const Settings& /*s*/) { return names.size(); })
      .def(
          "__getitem__",
          [names](nb::object s, const std::string& name) {
            if (std::find(names.begin(), names.end(), name) == names.end()) {
              const std::string text = "There is no setting '" + name + "'. Their names are in .keys().";
              throw nb::key_error(text.c_str());
            }
            return nb::object(s.attr(name.c_str()));
          },
          nb::arg("name"), nb::sig("def __getitem__(self, name: str) -> typing.Any"), "By name.")
      .def("__iter__",
           [](nb::object s) -> nb::typed<nb::iterator, std::string> {
             return nb::steal<nb::iterator>(PyObject_GetIter(nb::object(s.attr("keys")()).ptr()));
           })
      .def("__repr__", [](nb::object s) {
        return "Settings(" + std::string(nb::repr(nb::module_::import_("builtins").attr("dict")(s)).c_str()) + ")";
      });
}

}  // namespace

void bind_settings(nb::module_& module) {
  nb::class_<Settings> settings(module, "Settings",
                                "The settings of a run: the arguments of simulate() as attributes or, as in a dict, by "
                                "name: simulate(room, **result.settings) repeats a run.");
  std::vector<std::string> names;
  const auto add = [&](const char* name, const auto& value) {
    settings.def_prop_ro(name, value, "See simulate().");
    names.emplace_back(name);
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
  bind_keys(settings, names);
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
