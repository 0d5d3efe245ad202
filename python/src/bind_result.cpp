// Results: what they are made of. Their parts are bound in files of their own.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "lichtmc/units.hpp"
#include "result_parts.hpp"
#include "room_parts.hpp"

namespace lichtmc::python {

namespace {

// The walk that stands for a run: that of the tiles, if they were measured.
const WalkReport& main_walk(const Result& result) {
  return result.tiles.empty() ? result.receiver_walk : result.walk;
}

// Any walk that the user has interrupted counts.
StopReason stop_reason(const Result& result) {
  const bool interrupted =
      (!result.tiles.empty() && result.walk.stopped_by == StopReason::interrupt) ||
      (!result.receiver_results.empty() && result.receiver_walk.stopped_by == StopReason::interrupt);
  return interrupted ? StopReason::interrupt : main_walk(result).stopped_by;
}

// Without tiles nothing is known of what becomes of the power.
Balance balance_of(const Result& result) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!result.tiles.empty()) return result.balance;
  return {result.balance.emitted, unknown, unknown, unknown, unknown};
}

double if_tiles(const Result& result, double value) {
  return result.tiles.empty() ? std::numeric_limits<double>::quiet_NaN() : value;
}

void bind_parts_of(nb::class_<RunResult>& of) {
  of.def_prop_ro(
        "room", [](const RunResult& run) { return SharedRoom(run.room); },
        "The room that was simulated, as it was then.")
      .def_prop_ro(
          "tiles", [](const RunResultPtr& run) { return Tiles{run}; }, "The tiles of all surfaces, as arrays.")
      .def_prop_ro(
          "surfaces", [](const RunResultPtr& run) { return Surfaces{run}; },
          "The surfaces by name: figures, and grids of their tiles. Empty if only receivers were measured.")
      .def_prop_ro(
          "receivers", [](const RunResultPtr& run) { return ReceiverResults{measurements_of(run)}; },
          "The receivers, with the points of calculation areas, as arrays. Empty if only tiles were measured.")
      .def_prop_ro(
          "areas", [](const RunResultPtr& run) { return AreaResults{measurements_of(run)}; },
          "The calculation areas by name. Empty if only tiles were measured.")
      .def_prop_ro(
          "balance", [](const RunResult& run) { return balance_of(run.result); }, "Balance of the emitted power.")
      .def_prop_ro(
          "walk", [](const RunResult& run) { return run.result.tiles.empty() ? nullptr : &run.result.walk; },
          nb::rv_policy::reference_internal, nb::sig("def walk(self) -> WalkReport | None"),
          "How the tiles were measured; None if they were not.")
      .def_prop_ro(
          "receiver_walk",
          [](const RunResult& run) {
            return run.result.receiver_results.empty() ? nullptr : &run.result.receiver_walk;
          },
          nb::rv_policy::reference_internal, nb::sig("def receiver_walk(self) -> WalkReport | None"),
          "How the receivers were measured; None if they were not.");
}

void bind_facts_of(nb::class_<RunResult>& of) {
  of.def_prop_ro(
        "unit", [](const RunResult& run) { return power_unit(run.result.quantity); }, "Unit of powers: 'W' or 'lm'.")
      .def_prop_ro(
          "irradiance_unit", [](const RunResult& run) { return irradiance_unit(run.result.quantity); },
          "Unit of irradiances: 'W/m^2' or 'lx'.")
      .def_prop_ro(
          "settings", [](const RunResult& run) { return run.result.settings; },
          "The settings as requested, by attribute or as a dict: simulate(room, **result.settings) repeats the run.")
      .def_prop_ro(
          "engine", [](const RunResult& run) { return to_string(run.result.engine); },
          "'cuboid', 'embree' or 'embree-fast', as used.")
      .def_prop_ro(
          "threads", [](const RunResult& run) { return run.result.threads; }, "Number of threads, as used.")
      .def_prop_ro(
          "histories", [](const RunResult& run) { return main_walk(run.result).histories; },
          "Histories simulated for the tiles, or for the receivers if only these were measured.")
      .def_prop_ro(
          "seconds",
          [](const RunResult& run) {
            const Result& result = run.result;
            return (result.tiles.empty() ? 0.0 : result.walk.seconds) +
                   (result.receiver_results.empty() ? 0.0 : result.receiver_walk.seconds);
          },
          "Wall-clock time of all walks, s.")
      .def_prop_ro(
          "rms_relative_error", [](const RunResult& run) { return main_walk(run.result).rms_relative_error; },
          "Rms relative standard error of the tiles, or of the receivers if only these were measured: 0.01 means 1 %. "
          "See WalkReport.")
      .def_prop_ro(
          "stopped_by", [](const RunResult& run) { return to_string(stop_reason(run.result)); },
          "What ended the run: 'photons', 'target-error', 'max-time' or 'interrupt' (Ctrl-C).")
      .def_prop_ro(
          "incident", [](const RunResult& run) { return if_tiles(run.result, run.result.incident); },
          "Incident power of all tiles, W or lm. NaN: not all surfaces were measured, or none.")
      .def_prop_ro(
          "incident_standard_error",
          [](const RunResult& run) { return if_tiles(run.result, run.result.incident_standard_error); },
          "Standard error of incident, W or lm. NaN: unknown.")
      .def_prop_ro(
          "warnings", [](const RunResult& run) { return run.result.warnings; },
          "What affects the meaning of the figures: a sentence or two each.")
      .def_prop_ro(
          "ignored", [](const RunResult& run) { return texts_of(run.result.ignored); },
          "What the room's file contains and the run did not model: a sentence or two each.")
      .def_prop_ro(
          "overrides", [](const RunResult& run) { return run.result.overrides; },
          "Changes to the room after it was read: a sentence each.")
      .def_prop_ro(
          "choices", [](const RunResult& run) { return run.result.choices; },
          "Why estimators were chosen by estimator='auto': a sentence each.");
}

// The texts that the library prints.
void bind_texts_of(nb::class_<RunResult>& of) {
  const auto measured = [](const RunResult& run) {
    return run.result.tiles.empty() ? Measured::receivers : Measured::tiles;
  };
  of.def(
        "error_text", [measured](const RunResult& run) { return error_text(run.result, measured(run)); },
        "What the error of the tiles, or of the receivers if only these were measured, means: a sentence.")
      .def(
          "unreached_text", [](const RunResult& run) { return unreached_text(run.result); },
          "What the means leave out because no light can reach it: a sentence; empty if light can reach all.")
      .def("__repr__", [](nb::object result) {
        return nb::cast<std::string>(nb::module_::import_("lichtmc._text").attr("result_text")(result));
      });
}

}  // namespace

void bind_result(nb::module_& module) {
  nb::class_<RunResult> result(
      module, "Result",
      "The result of a simulation: irradiances (W/m²) or illuminances (lx) with their standard "
      "errors. It does not change. Arrays are read-only, and keep the result alive.");
  bind_parts_of(result);
  bind_facts_of(result);
  bind_texts_of(result);
}

}  // namespace lichtmc::python
