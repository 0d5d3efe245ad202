// The extension module lichtmc._core.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

#include "bindings.hpp"
#include "lichtmc/version.hpp"

NB_MODULE(_core, module) {
  using namespace lichtmc::python;
  module.doc() = "The compiled part of lichtmc. Use `import lichtmc`.";
  module.attr("__version__") = std::string(lichtmc::version());
  bind_errors(module);
  bind_worker(module);
  bind_photometry(module);
  bind_room(module);
  bind_figures(module);
  bind_tiles(module);
  bind_surfaces(module);
  bind_receiver_results(module);
  bind_area_results(module);
  bind_reports(module);
  bind_result(module);
  bind_channels(module);
  bind_parts(module);
  bind_pictures(module);
  bind_settings(module);
  bind_simulate(module);
  bind_continue(module);
  bind_compare(module);
  bind_study(module);
  bind_files(module);
  bind_pickle(module);
  bind_command_line(module);
}
