// The emitters of a room.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "checked_call.hpp"
#include "emitter_shapes.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/overrides.hpp"
#include "room_parts.hpp"

namespace lichtmc::python {

namespace {

// An emitter of a room, as it was when it was asked for.
struct EmitterOfRoom {
  std::string name;
  double power = 0.0;
  nb::object shape;
  double delay = 0.0;
  double maintenance_factor = 1.0;
};

std::string list_of_surfaces(const Room& room) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, room.surfaces.size()); ++k)
    text += (k == 0 ? "'" : ", '") + room.surfaces[k].name + "'";
  if (room.surfaces.size() > most) text += " and " + std::to_string(room.surfaces.size() - most) + " more";
  return text.empty() ? "none: the room has no surfaces" : text;
}

SurfaceEmitter area_light_of(const Room& room, const AreaLightShape& shape) {
  const auto found = std::find_if(room.surfaces.begin(), room.surfaces.end(),
                                  [&](const Surface& surface) { return surface.name == shape.surface; });
  if (found == room.surfaces.end())
    throw InputError("There is no surface '" + shape.surface + "' in " + room.source +
                     " (allowed: " + list_of_surfaces(room) + "). Give the name of a surface of the room.");
  return {static_cast<std::size_t>(found - room.surfaces.begin()), shape.exponent};
}

bool have_same_light(const Photometry& a, const Photometry& b) {
  const CandelaTable::Grid& p = a.candela->grid();
  const CandelaTable::Grid& q = b.candela->grid();
  return a.source == b.source && a.lamp_set == b.lamp_set && a.intensity_unit == b.intensity_unit &&
         a.opening.form == b.opening.form && a.opening.size_m == b.opening.size_m && p.type == q.type &&
         p.symmetry == q.symmetry && p.flip_horizontal == q.flip_horizontal && p.horizontal_deg == q.horizontal_deg &&
         p.vertical_deg == q.vertical_deg && p.candela == q.candela;
}

// The photometry of an emitter of the room that is the same file read before, so that many luminaires share its tables;
// null: the room has none.
std::shared_ptr<const Photometry> known_photometry(const Room& room, const std::shared_ptr<const Photometry>& file) {
  const Photometry* other = nullptr;
  for (auto emitter = room.emitters.rbegin(); emitter != room.emitters.rend(); ++emitter) {
    const auto* shape = std::get_if<MeasuredEmitter>(&emitter->shape);
    if (shape == nullptr || shape->photometry.get() == other) continue;
    other = shape->photometry.get();
    if (shape->photometry == file || have_same_light(*other, *file)) return shape->photometry;
  }
  return nullptr;
}

bool has_emitter(const Room& room, const std::string& name) {
  return std::any_of(room.emitters.begin(), room.emitters.end(), [&](const Emitter& one) { return one.name == name; });
}

// Of luminaires that of their file, numbered as on the command line; of others their number in the room.
std::string default_name(const Room& room, const Emitter& emitter) {
  std::string name;
  if (const auto* shape = std::get_if<MeasuredEmitter>(&emitter.shape)) {
    name = std::filesystem::path(shape->photometry->source).stem().string();
    if (!name.empty() && !has_emitter(room, name)) return name;
  }
  std::size_t number = name.empty() ? room.emitters.size() + 1 : 2;
  if (name.empty()) name = "emitter";
  while (has_emitter(room, name + "_" + std::to_string(number))) ++number;
  return name + "_" + std::to_string(number);
}

// Its shape, power and quantity.
struct NewEmitter {
  Emitter emitter;
  Quantity quantity = Quantity::photometric;
};

NewEmitter new_luminaire(const LuminaireShape& luminaire, nb::handle power, Quantity unit) {
  if (!power.is_none())
    throw InputError("The power of the luminaire is " + shown(power) +
                     " (allowed: none, its file and its scaling give it). Give lumens, scale or watts to Luminaire().");
  NewEmitter made;
  made.quantity = luminaire.mounted.quantity;
  if (unit == Quantity::radiometric && made.quantity != unit)
    throw InputError(
        "The unit of the luminaire is 'W' (allowed: 'lm', the unit of its power). Give Luminaire() its "
        "radiant flux as watts.");
  made.emitter.shape = luminaire.mounted.shape;
  made.emitter.power = luminaire.mounted.power;
  return made;
}

// A power, for messages.
const char* example_of(Quantity unit) {
  return unit == Quantity::photometric ? "1000 (lm)" : "5 (W)";
}

NewEmitter new_emitter(const Room& room, nb::handle shape, nb::handle power, Quantity unit) {
  if (nb::isinstance<LuminaireShape>(shape)) return new_luminaire(nb::cast<const LuminaireShape&>(shape), power, unit);
  NewEmitter made;
  made.quantity = unit;
  if (nb::isinstance<IsotropicEmitter>(shape)) {
    made.emitter.shape = nb::cast<const IsotropicEmitter&>(shape);
  } else if (nb::isinstance<LambertEmitter>(shape)) {
    made.emitter.shape = nb::cast<const LambertEmitter&>(shape);
  } else if (nb::isinstance<SpotEmitter>(shape)) {
    made.emitter.shape = nb::cast<const SpotEmitter&>(shape);
  } else if (nb::isinstance<AreaLightShape>(shape)) {
    made.emitter.shape = area_light_of(room, nb::cast<const AreaLightShape&>(shape));
  } else {
    refuse_value("shape of the emitter", shape, "Isotropic, Lambert, Spot, AreaLight or Luminaire",
                 "Give one, for example Isotropic((2, 2.4, 1.5)).");
  }
  if (power.is_none())
    throw InputError(
        "The emitter has no power (allowed: a number, 0 or more). Give its luminous flux in lm, or its "
        "radiant flux with unit='W'.");
  made.emitter.power = number_of(power, "power of the emitter", example_of(unit));
  return made;
}

// Throws InputError if the emitter is not valid in the room.
void check_emitter(const Room& room, const NewEmitter& made) {
  Room check = room_for_checks(room);
  check.quantity = made.quantity;
  check.emitters.push_back(made.emitter);
  if (auto* shape = std::get_if<SurfaceEmitter>(&check.emitters.back().shape)) {
    check.surfaces = {room.surfaces[shape->surface]};
    check.surfaces[0].reflectance_map.reset();
    shape->surface = 0;
  }
  check_room(check);
}

std::string add(SharedRoom& room, nb::handle shape, nb::handle power, nb::handle unit, nb::handle name,
                nb::handle delay, nb::handle maintenance) {
  NewEmitter made = new_emitter(room.room(), shape, power, unit_of(unit));
  Emitter& emitter = made.emitter;
  emitter.name = name.is_none() ? default_name(room.room(), emitter) : text_of(name, "name of the emitter");
  emitter.delay_s = number_of(delay, "delay of the emitter");
  if (!maintenance.is_none()) {
    emitter.maintenance_factor = number_of(maintenance, "maintenance factor of the emitter");
    emitter.own_maintenance = true;
  }
  check_emitter(room.room(), made);
  emitter.power *= emitter.maintenance_factor;
  std::vector<Ignored> remarks;
  if (auto* luminaire = std::get_if<MeasuredEmitter>(&emitter.shape)) {
    if (auto known = known_photometry(room.room(), luminaire->photometry)) {
      luminaire->photometry = std::move(known);
    } else {
      remarks = remarks_of(*luminaire->photometry);
    }
  }
  return room.change([&](Room& changed) {
    const std::string added = emitter.name;
    add_emitter(changed, std::move(emitter), made.quantity);
    for (Ignored& remark : remarks) changed.ignored.push_back(std::move(remark));
    return added;
  });
}

struct ShapeObject {
  const Room& room;
  const Emitter& emitter;

  nb::object operator()(const IsotropicEmitter& shape) const { return nb::cast(shape); }
  nb::object operator()(const LambertEmitter& shape) const { return nb::cast(shape); }
  nb::object operator()(const SpotEmitter& shape) const { return nb::cast(shape); }
  nb::object operator()(const SurfaceEmitter& shape) const {
    return nb::cast(AreaLightShape{room.surfaces[shape.surface].name, shape.exponent});
  }
  nb::object operator()(const MeasuredEmitter& shape) const {
    return nb::cast(LuminaireShape{{shape, emitter.power / emitter.maintenance_factor, room.quantity}});
  }
};

std::vector<EmitterOfRoom> emitters_of(const SharedRoom& shared) {
  std::vector<EmitterOfRoom> emitters;
  const Room& room = shared.room();
  for (const Emitter& emitter : room.emitters)
    emitters.push_back({emitter.name, emitter.power, std::visit(ShapeObject{room, emitter}, emitter.shape),
                        emitter.delay_s, emitter.maintenance_factor});
  return emitters;
}

void set_power_of(SharedRoom& shared, nb::handle name, nb::handle power) {
  const std::string which = text_of(name, "name of an emitter");
  const double flux = number_of(power, "power of the emitter", example_of(shared.room().quantity));
  shared.change([&](Room& changed) { set_power(changed, which, flux); });
}

std::size_t remove(SharedRoom& shared, nb::handle name) {
  const std::string which = text_of(name, "name of an emitter");
  return shared.change([&](Room& changed) { return remove_emitters(changed, which); });
}

void bind_emitter(nb::module_& module) {
  nb::class_<EmitterOfRoom>(module, "Emitter", "An emitter of a room, as it was when it was asked for.")
      .def_ro("name", &EmitterOfRoom::name, "Its name; emitters of one name share a part of the results.")
      .def_ro("power", &EmitterOfRoom::power,
              "Luminous flux (lm) or radiant flux (W), see Room.unit; the maintained one.")
      .def_ro("shape", &EmitterOfRoom::shape, "An Isotropic, Lambert, Spot, AreaLight or Luminaire.")
      .def_ro("delay", &EmitterOfRoom::delay, "Of its light behind the signal, s.")
      .def_ro("maintenance_factor", &EmitterOfRoom::maintenance_factor,
              "Share of the power of a new emitter that `power` is, above 0 and up to 1.")
      .def("__repr__", [](const EmitterOfRoom& emitter) {
        const nb::object text =
            nb::str("<Emitter {!r}: {:.6g}, {!r}>").attr("format")(emitter.name, emitter.power, emitter.shape);
        return nb::cast<std::string>(text);
      });
}

// Signatures, for Python and for messages.
constexpr const char* add_emitter_signature =
    "def add_emitter(self, shape: Isotropic | Lambert | Spot | AreaLight | Luminaire, power: float | None = None, *, "
    "unit: str = 'lm', name: str | None = None, delay: float = 0.0, maintenance_factor: float | None = None) -> str";
constexpr const char* set_power_signature = "def set_power(self, name: str, power: float) -> None";

}  // namespace

void bind_emitters_of_room(nb::module_& module, RoomClass& room) {
  bind_emitter_shapes(module);
  bind_emitter(module);
  room.def("add_emitter", checked("add_emitter", add_emitter_signature, &add), required("shape"),
           any_arg("power") = nb::none(), nb::kw_only(), any_arg("unit") = "lm", any_arg("name") = nb::none(),
           any_arg("delay") = 0.0, any_arg("maintenance_factor") = nb::none(), other_keywords(),
           nb::sig(add_emitter_signature),
           R"(Adds an emitter; returns its name.

All emitters of a room have the same unit: luminous flux (lm) makes results in lx, radiant flux (W) in W/m².

Args:
    shape: Where and by which law it emits.
    power: Its flux when new; not for a Luminaire, whose file and scaling give it.
    unit: "lm" or "W".
    name: Its name; emitters of one name share a part in results per emitter. Default: "emitter_1", "emitter_2", …, its
        number in the room; of a Luminaire the name of its file.
    delay: Of its light behind the signal, s (0 or more), for impulse responses.
    maintenance_factor: Share of its new power that it keeps, above 0 and up to 1. Default: 1, or what
        :meth:`set_maintenance_factor` says later.

Raises:
    InputError: A value is out of its range, the surface of an AreaLight is not known, or the unit is not the room's.)")
      .def("set_power", checked("set_power", set_power_signature, &set_power_of), required("name"), required("power"),
           other_keywords(), nb::sig(set_power_signature),
           R"(Sets the power of emitters; of a Luminaire too, whose intensity is then scaled.

Args:
    name: Of an emitter, or a pattern with "*", "?" and "[…]".
    power: Of each of them when new, in the unit of the room, 0 or more.)")
      .def("remove_emitters", &remove, any_arg("name"), nb::sig("def remove_emitters(self, name: str) -> int"),
           R"(Removes the emitters of a name or pattern; returns how many. The surfaces of area lights stay.)")
      .def_prop_ro("emitters", &emitters_of, "Its emitters, a list of :class:`Emitter`.");
}

}  // namespace lichtmc::python
