// The errors of the library as Python exceptions, with the same messages.
#include <Python.h>

#include <exception>
#include <filesystem>
#include <string>

#include "arguments.hpp"
#include "bindings.hpp"
#include "lichtmc/error.hpp"
#include "room_parts.hpp"

namespace lichtmc::python {

namespace {

// The classes live as long as the process: a translator may need them until the end.
PyObject* base_class = nullptr;
PyObject* input_class = nullptr;
PyObject* runtime_class = nullptr;
PyObject* room_warning = nullptr;

PyObject* make_class(nb::module_& module, const char* name, const char* doc, PyObject* base, PyObject* second_base) {
  const nb::object bases = second_base != nullptr ? nb::make_tuple(nb::handle(base), nb::handle(second_base))
                                                  : nb::make_tuple(nb::handle(base));
  const std::string full = std::string("lichtmc.") + name;
  PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr);
  if (made == nullptr) throw nb::python_error();
  module.attr(name) = nb::handle(made);
  return made;
}

// Messages may hold names of files that are not UTF-8.
void set_error(PyObject* kind, const std::string& message) {
  PyErr_SetString(kind, readable(message).c_str());
}

void translate(const std::exception_ptr& error, void* /*unused*/) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& wrong) {
    set_error(input_class, wrong.what());
  } catch (const RuntimeError& failed) {
    set_error(runtime_class, failed.what());
  } catch (const Error& other) {
    set_error(base_class, other.what());
  } catch (const std::filesystem::filesystem_error& failed) {
    set_error(runtime_class, "Cannot use " + failed.path1().string() + " (" + failed.code().message() +
                                 "). Check the path, its permissions and its disk.");
  }
}

}  // namespace

void warn_of_room(const std::string& text) {
  if (PyErr_WarnEx(room_warning, readable(text).c_str(), 1) != 0) throw nb::python_error();
}

void bind_errors(nb::module_& module) {
  base_class = make_class(module, "Error", "Base of the errors of lichtmc.", PyExc_Exception, nullptr);
  input_class = make_class(module, "InputError",
                           "A file, an argument or a setting is wrong. The message names it, its value, what is "
                           "allowed and what to do.",
                           base_class, PyExc_ValueError);
  runtime_class =
      make_class(module, "RuntimeError", "The machine failed: disk, memory, device.", base_class, PyExc_RuntimeError);
  room_warning = make_class(module, "RoomWarning",
                            "A change of a room does less than was probably meant: an area that leaves out points.",
                            PyExc_UserWarning, nullptr);
  nb::register_exception_translator(translate);
}

}  // namespace lichtmc::python
