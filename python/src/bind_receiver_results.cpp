// The receivers of a result or scene, with their figures.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "figures.hpp"
#include "named_elements.hpp"
#include "result_parts.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

// Receivers that were not measured have no results, and then no places either.
const std::vector<Receiver>& places(const ReceiverResults& receivers) {
  static const std::vector<Receiver> none;
  return receivers.of.results->empty() ? none : *receivers.of.receivers;
}

template <class Member>
auto of_places(Member Receiver::*member) {
  return [member](const ReceiverResults& receivers) { return column(receivers.of.owner, places(receivers), member); };
}

auto of_results(double ReceiverResult::*member) {
  return
      [member](const ReceiverResults& receivers) { return column(receivers.of.owner, *receivers.of.results, member); };
}

auto figure(double ReceiverResult::*member) {
  return [member](const OneReceiver& receiver) { return receiver.figures().*member; };
}

template <class Member>
View<double> point(const OneReceiver& receiver, Member Receiver::*member) {
  return strided(receiver.of.owner, &(receiver.receiver().*member).x, std::array<std::size_t, 1>{3},
                 std::array<std::int64_t, 1>{1});
}

NamedElements elements(const ReceiverResults& receivers) {
  const std::vector<Receiver>& all = places(receivers);
  return {"receiver", "receivers", all.size(), [&all](std::size_t k) -> const std::string& { return all[k].name; }};
}

void bind_one(nb::module_& module) {
  nb::class_<OneReceiver>(module, "ReceiverResult", "A receiver with its figures.")
      .def_prop_ro("name", [](const OneReceiver& receiver) { return receiver.receiver().name; })
      .def_prop_ro(
          "position", [](const OneReceiver& receiver) { return point(receiver, &Receiver::position); }, has_owner,
          "m, float64 (3,).")
      .def_prop_ro(
          "normal", [](const OneReceiver& receiver) { return point(receiver, &Receiver::normal); }, has_owner,
          "Axis of the field of view, float64 (3,).")
      .def_prop_ro("irradiance", figure(&ReceiverResult::irradiance),
                   "Irradiance (W/m²) or illuminance (lx): direct + indirect.")
      .def_prop_ro("standard_error", figure(&ReceiverResult::standard_error),
                   "Standard error of the irradiance, same unit. NaN: unknown, with a single history.")
      .def_prop_ro(
          "figure",
          [](const OneReceiver& receiver) {
            return Figure{receiver.figures().irradiance, receiver.figures().standard_error};
          },
          "The irradiance with its standard error.")
      .def_prop_ro("direct", figure(&ReceiverResult::direct),
                   "Part of the irradiance that comes from the emitters without reflection, same unit.")
      .def_prop_ro("indirect", figure(&ReceiverResult::indirect),
                   "Part of the irradiance that was reflected at least once, same unit.")
      .def_prop_ro("gain", figure(&ReceiverResult::gain),
                   "Received power over emitted power, with the receiver's area, concentrator and filter.")
      .def("__repr__", [](const OneReceiver& receiver) {
        return "ReceiverResult('" + receiver.receiver().name + "', " +
               text_of({receiver.figures().irradiance, receiver.figures().standard_error}) + " " +
               written_irradiance_unit(receiver.of.quantity) + ")";
      });
}

}  // namespace

void bind_receiver_results(nb::module_& module) {
  bind_one(module);
  nb::class_<ReceiverResults> all(
      module, "ReceiverResults",
      "The receivers with their figures: arrays of shape (n,) that show the memory of the result without copies, "
      "read-only. Irradiances in W/m² or lx, see Result.irradiance_unit. receivers['name'] or receivers[0] is a "
      "ReceiverResult.");
  all.def("__len__", [](const ReceiverResults& receivers) { return places(receivers).size(); })
      .def(
          "__getitem__",
          [](const ReceiverResults& receivers, nb::object key) {
            return OneReceiver{receivers.of, elements(receivers).find(key)};
          },
          nb::arg("key").none(), nb::sig("def __getitem__(self, key: str | int) -> ReceiverResult"),
          "By name, or by number.")
      .def(
          "__contains__",
          [](const ReceiverResults& receivers, nb::object key) { return elements(receivers).contains(key); },
          nb::arg("key").none(), "Whether a receiver has this name.")
      .def("__repr__",
           [](const ReceiverResults& receivers) {
             return "ReceiverResults(" + std::to_string(places(receivers).size()) + ")";
           })
      .def_prop_ro(
          "names",
          [](const ReceiverResults& receivers) -> nb::typed<nb::list, std::string> {
            return elements(receivers).names();
          },
          "Names, in the order of the arrays.")
      .def_prop_ro("position", of_places(&Receiver::position), has_owner, "Positions, m, float64 (n, 3).")
      .def_prop_ro("normal", of_places(&Receiver::normal), has_owner,
                   "Axes of the fields of view, float64 (n, 3), of the lengths that were given.")
      .def_prop_ro("irradiance", of_results(&ReceiverResult::irradiance), has_owner,
                   "Irradiance (W/m²) or illuminance (lx), direct + indirect, float64 (n,).")
      .def_prop_ro("standard_error", of_results(&ReceiverResult::standard_error), has_owner,
                   "Standard error of the irradiance, same unit, float64 (n,). NaN: unknown, with a single history.")
      .def_prop_ro("direct", of_results(&ReceiverResult::direct), has_owner,
                   "Part of the irradiance that comes from the emitters without reflection, same unit, float64 (n,).")
      .def_prop_ro("indirect", of_results(&ReceiverResult::indirect), has_owner,
                   "Part of the irradiance that was reflected at least once, same unit, float64 (n,).")
      .def_prop_ro("gain", of_results(&ReceiverResult::gain), has_owner,
                   "Received power over emitted power, with the area, concentrator and filter of each receiver, "
                   "float64 (n,).");
}

}  // namespace lichtmc::python
