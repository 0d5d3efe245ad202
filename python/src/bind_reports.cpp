// How a result came about: balance of the powers, reports of the walks.
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <array>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "lichtmc/result.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

std::string repr_of(const Balance& balance) {
  const auto text = [](double power) { return std::string(nb::repr(nb::float_(power)).c_str()); };
  return "Balance(emitted=" + text(balance.emitted) + ", absorbed=" + text(balance.absorbed) +
         ", escaped=" + text(balance.escaped) + ", residual=" + text(balance.residual) +
         ", lost=" + text(balance.lost) + ")";
}

std::string repr_of(const WalkReport& report) {
  return "WalkReport(" + std::string(to_string(report.estimator)) + ", " + std::to_string(report.histories) +
         " histories, " + std::to_string(report.impacts) +
         " impacts, rms_relative_error=" + nb::repr(nb::float_(report.rms_relative_error)).c_str() + ")";
}

View<double> convergence(const WalkReport& report) {
  std::vector<double> values;
  for (const ConvergencePoint& point : report.convergence)
    values.insert(values.end(), {static_cast<double>(point.histories), point.seconds, point.rms_relative_error});
  return owned(std::move(values), std::array<std::size_t, 2>{report.convergence.size(), 3});
}

void bind_balance(nb::module_& module) {
  nb::class_<Balance>(module, "Balance",
                      "Balance of the emitted power in W or lm: emitted = absorbed + escaped + residual + lost. Only a "
                      "forward walk for the tiles determines it; without one all but `emitted` are NaN.")
      .def_ro("emitted", &Balance::emitted, "Power of all emitters, W or lm.")
      .def_ro("absorbed", &Balance::absorbed, "Absorbed by the surfaces, W or lm.")
      .def_ro("escaped", &Balance::escaped, "Left the room through openings, W or lm.")
      .def_ro("residual", &Balance::residual,
              "Cut off by max_bounces, W or lm; for the estimator 'weight' without it: net effect of Russian roulette, "
              "0 on average.")
      .def_ro("lost", &Balance::lost, "Numerical errors: photons that left a closed room, W or lm.")
      .def("__repr__", [](const Balance& balance) { return repr_of(balance); });
}

}  // namespace

void bind_reports(nb::module_& module) {
  bind_balance(module);
  nb::class_<WalkReport>(module, "WalkReport", "How the results of one walk were computed.")
      .def_prop_ro(
          "estimator", [](const WalkReport& report) { return to_string(report.estimator); },
          "'weight', 'collision' or 'absorption', as used.")
      .def_ro("choice", &WalkReport::choice, "Why this estimator was chosen; empty if it was given.")
      .def_prop_ro(
          "receiver_walk", [](const WalkReport& report) { return to_string(report.receiver_walk); },
          "For receivers: 'two-way', 'next-event' or 'backward', as used.")
      .def_prop_ro(
          "stopped_by", [](const WalkReport& report) { return to_string(report.stopped_by); },
          "'photons', 'target-error', 'max-time' or 'interrupt'.")
      .def_ro("histories", &WalkReport::histories,
              "Histories; for receivers of all together: a photon counts for each receiver that it serves.")
      .def_ro("rounds", &WalkReport::rounds,
              "For receivers: rounds of histories, from whose differences the standard errors follow.")
      .def_ro("photons_per_round", &WalkReport::photons_per_round,
              "For receivers: photons from the emitters in a round.")
      .def_ro("walks_per_round", &WalkReport::walks_per_round, "For receivers: walks from each receiver in a round.")
      .def_ro("impacts", &WalkReport::impacts, "Flights that ended on a surface.")
      .def_ro("rays", &WalkReport::rays, "Flights traced, with shadow rays.")
      .def_ro("connections", &WalkReport::connections, "Connections of impacts of photons with receivers.")
      .def_ro("shadow_rays", &WalkReport::shadow_rays, "Rays that test whether an emitter is visible.")
      .def_ro("seconds", &WalkReport::seconds, "Wall-clock time, s, with that of direct light.")
      .def_ro("direct_seconds", &WalkReport::direct_seconds, "Part of it for direct light, s.")
      .def_ro(
          "rms_relative_error", &WalkReport::rms_relative_error,
          "Rms of the relative standard errors, 0.01 means 1 %: of the tiles, weighted by area, or of the receivers; "
          "each relative to the irradiance or to error_floor, whichever is greater. With calculation areas the "
          "largest error of their means and minima.")
      .def_ro("rms_relative_error_without_floor", &WalkReport::rms_relative_error_without_floor,
              "The same of all tiles or receivers with an irradiance above 0, relative to it.")
      .def_ro("error_floor", &WalkReport::error_floor, "As used, W/m² or lx.")
      .def_ro("figure_of_merit", &WalkReport::figure_of_merit, "1/(rms_relative_error² · seconds), 1/s.")
      .def_ro("histories_to_target", &WalkReport::histories_to_target,
              "Forecast of the histories that target_error requires; NaN without one.")
      .def_prop_ro("convergence", &convergence, has_owner,
                   "All error checks, float64 (k, 3): histories, seconds since the walk began, rms relative error. A "
                   "copy.")
      .def("__repr__", [](const WalkReport& report) { return repr_of(report); });
}

}  // namespace lichtmc::python
