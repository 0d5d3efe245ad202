// The parts of the extension module lichtmc._core: one file each, with a function that adds its classes and functions.
// A new part is a function here, a call in module.cpp and a file in python/CMakeLists.txt.
//
// The extension uses the public headers of the library and command_line.hpp, as any other program. What it adds: numpy
// arrays (views.hpp), rooms that results can keep (shared_room.hpp), runs that leave Python free (worker.hpp).
#pragma once

#include <nanobind/nanobind.h>

namespace lichtmc::python {

namespace nb = nanobind;

void bind_errors(nb::module_& module);
void bind_worker(nb::module_& module);
void bind_photometry(nb::module_& module);
void bind_room(nb::module_& module);  // with the parts of room_parts.hpp
void bind_settings(nb::module_& module);
void bind_simulate(nb::module_& module);
void bind_result(nb::module_& module);
void bind_figures(nb::module_& module);
void bind_tiles(nb::module_& module);
void bind_surfaces(nb::module_& module);
void bind_receiver_results(nb::module_& module);
void bind_area_results(nb::module_& module);
void bind_reports(nb::module_& module);
void bind_channels(nb::module_& module);  // after bind_result(), as the following
void bind_parts(nb::module_& module);
void bind_pictures(nb::module_& module);
void bind_continue(nb::module_& module);
void bind_compare(nb::module_& module);
void bind_study(nb::module_& module);
void bind_files(nb::module_& module);
void bind_pickle(nb::module_& module);
void bind_command_line(nb::module_& module);

}  // namespace lichtmc::python
