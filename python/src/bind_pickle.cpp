// Pickles of rooms and results, copies of results.
#include <nanobind/nanobind.h>

#include <new>
#include <string>
#include <string_view>

#include "bindings.hpp"
#include "packed.hpp"
#include "run_result.hpp"
#include "shared_room.hpp"

namespace lichtmc::python {

namespace {

// Bytes of a pickle. Packing takes a while for large results, and needs no Python.
template <class Pack>
nb::bytes bytes_of(const Pack& pack) {
  std::string bytes;
  {
    const nb::gil_scoped_release without_lock;
    bytes = pack();
  }
  return nb::bytes(bytes.data(), bytes.size());
}

std::string_view text_of(const nb::bytes& bytes) {
  return {bytes.c_str(), bytes.size()};
}

}  // namespace

void bind_pickle(nb::module_& module) {
  auto room = nb::borrow<nb::class_<SharedRoom>>(module.attr("Room"));
  room.def("__getstate__",
           [](const SharedRoom& self) {
             const auto kept = self.kept();  // other threads then change a copy
             return bytes_of([&] { return pack(kept->room); });
           })
      .def("__setstate__", [](SharedRoom& self, const nb::bytes& state) {
        new (&self) SharedRoom(unpack_room(text_of(state), "the pickle of a Room"));
      });
  // A result does not change: it is its own copy.
  auto result = nb::borrow<nb::class_<RunResult>>(module.attr("Result"));
  result.def("__getstate__", [](const RunResult& self) { return bytes_of([&] { return pack(self); }); })
      .def("__setstate__",
           [](RunResult& self, const nb::bytes& state) {
             new (&self) RunResult(unpack_result(text_of(state), "the pickle of a Result"));
           })
      .def("__copy__", [](nb::object self) { return self; })
      .def(
          "__deepcopy__", [](nb::object self, nb::handle /*memo*/) { return self; }, nb::arg("memo"));
}

}  // namespace lichtmc::python
