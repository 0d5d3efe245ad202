// Results.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>

#include "bindings.hpp"
#include "lichtmc/units.hpp"
#include "run_result.hpp"

namespace lichtmc::python {

void bind_result(nb::module_& module) {
  nb::class_<RunResult>(module, "Result", "The result of a simulation. It does not change.")
      .def_prop_ro(
          "room", [](const RunResult& run) { return SharedRoom(run.room); },
          "The room that was simulated, as it was then.")
      .def_prop_ro(
          "tiles", [](const RunResultPtr& run) { return Tiles{run}; }, "The tiles of all surfaces, as arrays.")
      .def_prop_ro(
          "irradiance_unit", [](const RunResult& run) { return std::string(irradiance_unit(run.result.quantity)); },
          "'W/m^2' or 'lx'.")
      .def_prop_ro(
          "stopped_by",
          [](const RunResult& run) {
            const Result& result = run.result;
            return std::string(
                to_string(result.tiles.empty() ? result.receiver_walk.stopped_by : result.walk.stopped_by));
          },
          "What ended the run: 'photons', 'target-error', 'max-time' or 'interrupt' (Ctrl-C).")
      .def_prop_ro(
          "warnings", [](const RunResult& run) { return run.result.warnings; },
          "What affects the meaning of the figures: a sentence or two each.");
}

}  // namespace lichtmc::python
