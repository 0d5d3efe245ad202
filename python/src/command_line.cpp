// The program lichtmc as a command of the Python package.
#include <nanobind/stl/vector.h>

#include <string>
#include <vector>

#include "bindings.hpp"
#include "command_line.hpp"

namespace lichtmc::python {

void bind_command_line(nb::module_& module) {
  module.def(
      "run_command_line",
      [](const std::vector<nb::bytes>& given) {
        std::vector<std::string> words;
        for (const nb::bytes& word : given) words.emplace_back(word.c_str(), word.size());
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        const int count = static_cast<int>(arguments.size());
        arguments.push_back(nullptr);
        const nb::gil_scoped_release without_lock;
        return app::run_command_line(count, arguments.data());
      },
      nb::arg("words"),
      "Runs the program lichtmc with these words, the first of which is its name, in the encoding of names of files; "
      "returns its exit status. It takes "
      "charge of the process: for the command `lichtmc` only.");
}

}  // namespace lichtmc::python
