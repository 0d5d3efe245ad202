// The program lichtmc as a command of the Python package.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <vector>

#include "bindings.hpp"
#include "command_line.hpp"

namespace lichtmc::python {

void bind_command_line(nb::module_& module) {
  module.def(
      "run_command_line",
      [](std::vector<std::string> words) {
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        const int count = static_cast<int>(arguments.size());
        arguments.push_back(nullptr);
        return app::run_command_line(count, arguments.data());
      },
      nb::arg("words"), nb::call_guard<nb::gil_scoped_release>(),
      "Runs the program lichtmc with these words, the first of which is its name; returns its exit status. It takes "
      "charge of the process: for the command `lichtmc` only.");
}

}  // namespace lichtmc::python
