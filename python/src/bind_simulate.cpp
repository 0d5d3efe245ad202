// Runs, with their progress.
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <functional>
#include <string>

#include "aside.hpp"
#include "bindings.hpp"
#include "lichtmc/simulate.hpp"
#include "run_result.hpp"
#include "simulate.hpp"

namespace lichtmc::python {

namespace {

std::string_view stage_word(Progress::Stage stage) {
  switch (stage) {
    case Progress::Stage::preparation:
      return "preparation";
    case Progress::Stage::direct_light:
      return "direct light";
    case Progress::Stage::pilot:
      return "pilot";
    case Progress::Stage::tiles:
      return "tiles";
    case Progress::Stage::receivers:
      return "receivers";
  }
  return "";
}

// Ends a run between two steps of its preparation, which knows no stop: in a room of millions of triangles it takes
// many seconds. Nothing is simulated yet that would be lost. Ctrl-C, or the exception of a callback, is raised then.
struct StoppedInPreparation {};

}  // namespace

RunResultPtr run_aside(const std::shared_ptr<const KeptRoom>& room, unsigned threads, nb::object on_progress,
                       const std::function<Result(const Control&)>& run, Interrupted interrupted) {
  const auto work = [&](const std::stop_token& stop, const std::function<void(const ProgressReport&)>& tell) {
    const StepListener on_step = [&](std::string_view step) {
      ProgressReport report;
      report.progress.stage = Progress::Stage::preparation;
      report.step = step;
      tell(report);
      if (stop.stop_requested()) throw StoppedInPreparation{};
    };
    step_listener = &on_step;
    Control control;
    control.stop = stop;
    control.prepared = room->prepared(threads);
    control.progress = [&](const Progress& progress) { tell({progress, std::string(progress.step)}); };
    return run(control);
  };
  std::function<void(const ProgressReport&)> on_report;
  if (!on_progress.is_none()) on_report = [&](const ProgressReport& report) { on_progress(report); };
  return make_run_result(room, work_aside<Result, ProgressReport>(work, on_report, interrupted));
}

void bind_simulate(nb::module_& module) {
  nb::class_<ProgressReport>(module, "Progress", "How far a run is, for callbacks.")
      .def_prop_ro(
          "stage", [](const ProgressReport& r) { return std::string(stage_word(r.progress.stage)); },
          "'preparation', 'direct light', 'pilot', 'tiles' or 'receivers'.")
      .def_ro("step", &ProgressReport::step, "What the preparation does: 'Laying out tiles', …; empty in other stages.")
      .def_prop_ro(
          "histories", [](const ProgressReport& r) { return r.progress.histories; },
          "Histories of this stage simulated so far (direct light: tiles or receivers).")
      .def_prop_ro(
          "target", [](const ProgressReport& r) { return r.progress.target; },
          "Histories of this stage if no other stop rule comes first.")
      .def_prop_ro(
          "seconds", [](const ProgressReport& r) { return r.progress.seconds; }, "Since the walk began, s.")
      .def_prop_ro(
          "rms_relative_error", [](const ProgressReport& r) { return r.progress.rms_relative_error; },
          "Relative standard error at the last error check; NaN before the first.")
      .def_prop_ro(
          "seconds_to_target", [](const ProgressReport& r) { return r.progress.seconds_to_target; },
          "Forecast of the time until target_error is met, s; NaN if there is none.")
      .def("__repr__", [](nb::object progress) {
        return nb::cast<std::string>(nb::module_::import_("lichtmc._progress").attr("repr_of")(progress));
      });
  module.def(
      "simulate",
      [](SharedRoom& room, const Settings& settings, nb::object progress) {
        const auto kept = with_areas(room);
        return run_aside(kept, settings.threads, std::move(progress),
                         [&](const Control& control) { return simulate(kept->room, settings, control); });
      },
      nb::arg("room"), nb::arg("settings"), nb::arg("progress").none() = nb::none(),
      "See lichtmc.simulate(), which documents the arguments.");
}

}  // namespace lichtmc::python
