// Emitters: their shapes, and the emitters of a room.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "emitter_shapes.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/overrides.hpp"
#include "room_parts.hpp"
#include "vectors.hpp"

namespace lichtmc::python {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

// An emitter of a room, as it was when it was asked for.
struct EmitterOfRoom {
  std::string name;
  double power = 0.0;
  nb::object shape;
  double delay = 0.0;
  double maintenance_factor = 1.0;
};

nb::tuple tuple_of(const glm::dvec3& v) {
  return nb::make_tuple(v.x, v.y, v.z);
}

// repr, equality and hash of an immutable class, from its fields as (name, value).
template <class Shape>
void def_value(nb::class_<Shape>& of, nb::tuple (*fields)(const Shape&)) {
  of.def("__repr__",
         [fields](nb::handle self) {
           std::string text;
           for (const nb::handle field : fields(nb::cast<const Shape&>(self)))
             text += (text.empty() ? "" : ", ") + nb::cast<std::string>(field[0]) + "=" + nb::repr(field[1]).c_str();
           return nb::cast<std::string>(self.type().attr("__name__")) + "(" + text + ")";
         })
      .def(
          "__eq__",
          [fields](const Shape& self, nb::handle other) -> nb::object {
            if (!nb::isinstance<Shape>(other)) return nb::borrow(Py_NotImplemented);
            return nb::bool_(fields(self).equal(fields(nb::cast<const Shape&>(other))));
          },
          nb::arg("other"), nb::sig("def __eq__(self, other: object) -> bool"))
      .def("__hash__", [fields](const Shape& self) { return nb::hash(fields(self)); });
}

template <class Shape>
void def_position(nb::class_<Shape>& of) {
  of.def_prop_ro(
      "position", [](const Shape& shape) { return array_of(shape.position); }, has_owner, "m, float64 (3,).");
}

template <class Shape>
void def_axis(nb::class_<Shape>& of) {
  of.def_prop_ro(
      "axis", [](const Shape& shape) { return array_of(shape.axis); }, has_owner,
      "Direction of the beam, float64 (3,), of any length but 0.");
}

// The emitter in a room where all else is valid: the library's own check, when the shape is made.
void check_shape(const std::string& kind, const decltype(Emitter::shape)& shape) {
  Room like;
  like.source = "the arguments";
  Room check = room_for_checks(like);
  check.emitters.push_back({kind, 1.0, shape});
  check_room(check);
}

// An angle in degrees, which the library has in rad.
double half_angle(nb::handle value, const char* which, double least, double most, const std::string& allowed) {
  const std::string what = std::string(which) + " half angle of the spot";
  const double angle = number_of(value, what);
  if (angle >= least && angle <= most) return degree * angle;
  refuse_value(what, value, allowed + " degrees", "Give the half angle of the cone.");
}

void bind_point_shapes(nb::module_& module) {
  nb::class_<IsotropicEmitter> isotropic(module, "Isotropic",
                                         "A point emitter with the same intensity in every direction: I = Φ/4π.");
  isotropic.def(
      "__init__",
      [](IsotropicEmitter* self, nb::handle position) {
        const IsotropicEmitter shape{vec3_of(position, "position of the emitter")};
        check_shape("Isotropic", shape);
        new (self) IsotropicEmitter(shape);
      },
      any_arg("position"), nb::sig("def __init__(self, position: numpy.typing.ArrayLike) -> None"),
      "At a position (x, y, z), m.");
  def_position(isotropic);
  def_value<IsotropicEmitter>(isotropic, [](const IsotropicEmitter& shape) {
    return nb::make_tuple(nb::make_tuple("position", tuple_of(shape.position)));
  });

  nb::class_<LambertEmitter> lambert(
      module, "Lambert", "A point emitter by the generalized Lambert law about an axis: I(θ) = Φ (m+1)/(2π) cos^m θ.");
  lambert
      .def(
          "__init__",
          [](LambertEmitter* self, nb::handle position, nb::handle axis, nb::handle exponent) {
            const LambertEmitter shape{vec3_of(position, "position of the emitter"),
                                       vec3_of(axis, "axis of the emitter"),
                                       number_of(exponent, "exponent of the emitter")};
            check_shape("Lambert", shape);
            new (self) LambertEmitter(shape);
          },
          any_arg("position"), any_arg("axis") = nb::make_tuple(0, -1, 0), any_arg("exponent") = 1.0,
          nb::sig("def __init__(self, position: numpy.typing.ArrayLike, axis: numpy.typing.ArrayLike = (0, -1, 0), "
                  "exponent: float = 1.0) -> None"),
          R"(A point emitter.

Args:
    position: (x, y, z), m.
    axis: Direction of the beam, of any length but 0.
    exponent: m, 0 or more: 0 a uniform hemisphere, 1 Lambert's law, large a narrow beam.)")
      .def_ro("exponent", &LambertEmitter::exponent, "m of cos^m θ.");
  def_position(lambert);
  def_axis(lambert);
  def_value<LambertEmitter>(lambert, [](const LambertEmitter& shape) {
    return nb::make_tuple(nb::make_tuple("position", tuple_of(shape.position)),
                          nb::make_tuple("axis", tuple_of(shape.axis)), nb::make_tuple("exponent", shape.exponent));
  });
}

void bind_spot(nb::module_& module) {
  nb::class_<SpotEmitter> spot(
      module, "Spot", "A point emitter with a cone of full intensity and a soft edge around it, as the spots of glTF.");
  spot.def(
          "__init__",
          [](SpotEmitter* self, nb::handle position, nb::handle axis, nb::handle inner, nb::handle outer) {
            const double edge = half_angle(outer, "outer", 1e-4, 90.0, "0.0001 to 90");
            const SpotEmitter shape{vec3_of(position, "position of the emitter"), vec3_of(axis, "axis of the emitter"),
                                    half_angle(inner, "inner", 0.0, edge / degree, "0 to the outer one, in"), edge};
            check_shape("Spot", shape);
            new (self) SpotEmitter(shape);
          },
          any_arg("position"), any_arg("axis") = nb::make_tuple(0, -1, 0), nb::kw_only(), any_arg("inner_deg") = 0.0,
          any_arg("outer_deg") = 45.0,
          nb::sig("def __init__(self, position: numpy.typing.ArrayLike, axis: numpy.typing.ArrayLike = (0, -1, 0), *, "
                  "inner_deg: float = 0.0, outer_deg: float = 45.0) -> None"),
          R"(A spot.

Args:
    position: (x, y, z), m.
    axis: Direction of the beam, of any length but 0.
    inner_deg: Half angle of the cone of full intensity, degrees, 0 to outer_deg.
    outer_deg: Half angle of the cone that contains all light, degrees, up to 90.)")
      .def_prop_ro(
          "inner_deg", [](const SpotEmitter& shape) { return shape.inner / degree; },
          "Half angle of the cone of full intensity, degrees.")
      .def_prop_ro(
          "outer_deg", [](const SpotEmitter& shape) { return shape.outer / degree; },
          "Half angle of the cone that contains all light, degrees.");
  def_position(spot);
  def_axis(spot);
  def_value<SpotEmitter>(spot, [](const SpotEmitter& shape) {
    return nb::make_tuple(
        nb::make_tuple("position", tuple_of(shape.position)), nb::make_tuple("axis", tuple_of(shape.axis)),
        nb::make_tuple("inner_deg", shape.inner / degree), nb::make_tuple("outer_deg", shape.outer / degree));
  });
}

void bind_area_light(nb::module_& module) {
  nb::class_<AreaLightShape> area(
      module, "AreaLight",
      "An area light: the front of a surface of the room emits by the generalized Lambert law about its normal.");
  area.def(
          "__init__",
          [](AreaLightShape* self, nb::handle surface, nb::handle exponent) {
            const double m = number_of(exponent, "exponent of the area light");
            check_shape("AreaLight", LambertEmitter{{}, {0.0, -1.0, 0.0}, m});
            new (self) AreaLightShape{text_of(surface, "name of the emitting surface"), m};
          },
          any_arg("surface"), any_arg("exponent") = 1.0,
          nb::sig("def __init__(self, surface: str, exponent: float = 1.0) -> None"),
          R"(An area light.

Args:
    surface: Name of a surface of the room; its exitance is uniform.
    exponent: m of cos^m θ, 0 or more: 1 is Lambert's law.)")
      .def_ro("surface", &AreaLightShape::surface, "Name of the surface.")
      .def_ro("exponent", &AreaLightShape::exponent, "m of cos^m θ.");
  def_value<AreaLightShape>(area, [](const AreaLightShape& shape) {
    return nb::make_tuple(nb::make_tuple("surface", shape.surface), nb::make_tuple("exponent", shape.exponent));
  });
}

// The file of a luminaire: an object, or read from its name.
std::shared_ptr<const Photometry> photometry_of(nb::handle file, nb::handle lamp_set, nb::handle flip, bool scaled) {
  PhotometryOptions options;
  options.lamp_set = static_cast<std::size_t>(whole_number_of(lamp_set, "number of the lamp set", 1, 1'000'000));
  options.flip_horizontal = flag_of(flip, "flag flip_horizontal");
  options.needs_flux = !scaled;
  if (!nb::isinstance<PhotometryFile>(file)) {
    return std::make_shared<const Photometry>(
        read_photometry(path_of(file, "photometric file (a Photometry or the name of a file)"), options));
  }
  if (options.lamp_set != 1 || options.flip_horizontal)
    throw InputError(
        "The arguments lamp_set and flip_horizontal are given with a Photometry object (allowed: with the "
        "name of a file). Give them to Photometry().");
  return nb::cast<const PhotometryFile&>(file).photometry;
}

void make_luminaire(LuminaireShape* self, nb::handle file, nb::handle position, nb::handle aim, nb::handle rotation,
                    nb::handle lumens, nb::handle scale, nb::handle watts, nb::handle area, nb::handle lamp_set,
                    nb::handle flip) {
  LuminaireOptions options;
  options.lumens = optional_number(lumens, "luminous flux of the luminaire (lumens)");
  options.scale = optional_number(scale, "factor of the intensity (scale)");
  options.watts = optional_number(watts, "radiant flux of the luminaire (watts)");
  options.rotation_deg = number_of(rotation, "rotation of the luminaire");
  options.area = flag_of(area, "flag area");
  const auto photometry = photometry_of(file, lamp_set, flip, options.lumens || options.watts);
  const std::string where = "The luminaire of " + photometry->source;
  LuminaireShape shape{mount(photometry, vec3_of(position, "position of the luminaire"),
                             axes_towards(vec3_of(aim, "aim of the luminaire")), options, where)};
  check_shape("Luminaire", shape.mounted.shape);
  new (self) LuminaireShape(std::move(shape));
}

void bind_luminaire(nb::module_& module) {
  nb::class_<LuminaireShape> luminaire(
      module, "Luminaire",
      "A luminaire with a photometric file (IES LM-63 or EULUMDAT): its intensity and, unless it is scaled, its flux.");
  luminaire.def("__init__", &make_luminaire, any_arg("photometry"), any_arg("position"),
                any_arg("aim") = nb::make_tuple(0, -1, 0), nb::kw_only(), any_arg("rotation_deg") = 0.0,
                any_arg("lumens") = nb::none(), any_arg("scale") = nb::none(), any_arg("watts") = nb::none(),
                any_arg("area") = false, any_arg("lamp_set") = 1, any_arg("flip_horizontal") = false,
                nb::sig("def __init__(self, photometry: Photometry | str | os.PathLike[str], position: "
                        "numpy.typing.ArrayLike, aim: numpy.typing.ArrayLike = (0, -1, 0), *, rotation_deg: float = "
                        "0.0, lumens: float | None = None, scale: float | None = None, watts: float | None = None, "
                        "area: bool = False, lamp_set: int = 1, flip_horizontal: bool = False) -> None"),
                R"(A luminaire; at most one of lumens, scale and watts.

Args:
    photometry: The file, or its name.
    position: Of its centre, (x, y, z), m.
    aim: Direction of its axis (γ = 0), of any length but 0; downwards, the plane C0 points towards +x.
    rotation_deg: About its aim, from C0 towards C90, degrees.
    lumens: Its luminous flux, lm, in place of the file's.
    scale: Its intensity is that of the file times this.
    watts: Its radiant flux, W, as of ultraviolet: the file gives the shape only.
    area: Whether light starts all over its luminous opening, not at its centre.
    lamp_set: Of a EULUMDAT file, counted from 1.
    flip_horizontal: Of files of type A or B: H counts the other way.)");
  luminaire
      .def_prop_ro(
          "photometry", [](const LuminaireShape& of) { return PhotometryFile{of.mounted.shape.photometry}; },
          "Its photometric file.")
      .def_prop_ro(
          "position", [](const LuminaireShape& of) { return array_of(of.mounted.shape.position); }, has_owner,
          "m, float64 (3,).")
      .def_prop_ro(
          "aim", [](const LuminaireShape& of) { return array_of(of.mounted.shape.axis); }, has_owner,
          "Direction of its axis, a unit vector, float64 (3,).")
      .def_prop_ro(
          "c0", [](const LuminaireShape& of) { return array_of(of.mounted.shape.c0); }, has_owner,
          "Direction towards the plane C0, a unit vector, float64 (3,).")
      .def_prop_ro(
          "c90", [](const LuminaireShape& of) { return array_of(of.mounted.shape.c90); }, has_owner,
          "Direction towards the plane C90, a unit vector, float64 (3,).")
      .def_prop_ro(
          "power", [](const LuminaireShape& of) { return of.mounted.power; },
          "Its luminous flux (lm) or radiant flux (W).")
      .def_prop_ro(
          "unit", [](const LuminaireShape& of) { return std::string(power_unit(of.mounted.quantity)); }, "'lm' or 'W'.")
      .def_prop_ro(
          "area", [](const LuminaireShape& of) { return of.mounted.shape.opening.has_value(); },
          "Whether light starts all over its opening.");
  def_value<LuminaireShape>(luminaire, [](const LuminaireShape& of) {
    const MeasuredEmitter& shape = of.mounted.shape;
    return nb::make_tuple(
        nb::make_tuple("photometry", shape.photometry->source), nb::make_tuple("position", tuple_of(shape.position)),
        nb::make_tuple("aim", tuple_of(shape.axis)), nb::make_tuple("c0", tuple_of(shape.c0)),
        nb::make_tuple("power", of.mounted.power), nb::make_tuple("unit", std::string(power_unit(of.mounted.quantity))),
        nb::make_tuple("area", shape.opening.has_value()));
  });
}

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
  made.emitter.power = number_of(power, "power of the emitter");
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

}  // namespace

void bind_emitters_of_room(nb::module_& module, RoomClass& room) {
  bind_point_shapes(module);
  bind_spot(module);
  bind_area_light(module);
  bind_luminaire(module);
  bind_emitter(module);
  room.def("add_emitter", &add, any_arg("shape"), any_arg("power") = nb::none(), nb::kw_only(), any_arg("unit") = "lm",
           any_arg("name") = nb::none(), any_arg("delay") = 0.0, any_arg("maintenance_factor") = nb::none(),
           nb::sig("def add_emitter(self, shape: Isotropic | Lambert | Spot | AreaLight | Luminaire, power: float | "
                   "None = None, *, unit: str = 'lm', name: str | None = None, delay: float = 0.0, "
                   "maintenance_factor: float | None = None) -> str"),
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
      .def_prop_ro("emitters", &emitters_of, "Its emitters, a list of :class:`Emitter`.");
}

}  // namespace lichtmc::python
