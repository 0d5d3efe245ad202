// The shapes of emitters: immutable values, which are checked when they are made.
#include <nanobind/stl/string.h>

#include <array>
#include <charconv>
#include <numbers>
#include <string>
#include <utility>

#include "arguments.hpp"
#include "checked_call.hpp"
#include "emitter_shapes.hpp"
#include "lichtmc/error.hpp"
#include "room_parts.hpp"
#include "vectors.hpp"

namespace lichtmc::python {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

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

// An angle in degrees.
double half_angle(nb::handle value, const char* which, double least, double most, const std::string& allowed,
                  const std::string& remedy) {
  const std::string what = std::string(which) + " half angle of the spot";
  const double angle = number_of(value, what, "30");
  if (angle >= least && angle <= most) return angle;
  refuse_value(what, value, allowed, remedy);
}

SpotEmitter spot_of(nb::handle position, nb::handle axis, nb::handle inner, nb::handle outer) {
  const double edge =
      half_angle(outer, "outer", 1e-4, 90.0, "0.0001 to 90 degrees", "Give the half angle of the cone of all light.");
  const std::string edge_text = nb::repr(nb::float_(edge)).c_str();
  const double core = half_angle(inner, "inner", 0.0, edge, "0 to " + edge_text + " degrees, the outer half angle",
                                 "Give a smaller inner_deg, or a larger outer_deg.");
  return {vec3_of(position, "position of the emitter"), vec3_of(axis, "axis of the emitter"), degree * core,
          degree * edge};
}

// The library has angles in rad: the shortest number of degrees that is this angle.
double degrees_of(double angle) {
  constexpr int digits_of_decimals = 15;  // that a double keeps
  std::array<char, 32> text{};
  for (int digits = digits_of_decimals; digits <= digits_of_decimals + 2; ++digits) {
    const char* end =
        std::to_chars(text.data(), text.data() + text.size(), angle / degree, std::chars_format::general, digits).ptr;
    double degrees = 0.0;
    std::from_chars(text.data(), end, degrees);
    if (degree * degrees == angle) return degrees;
  }
  return angle / degree;
}

// Signatures, for Python and for messages.
constexpr const char* isotropic_signature = "def __init__(self, position: numpy.typing.ArrayLike) -> None";
constexpr const char* lambert_signature =
    "def __init__(self, position: numpy.typing.ArrayLike, axis: numpy.typing.ArrayLike = (0, -1, 0), exponent: float = "
    "1.0) -> None";
constexpr const char* spot_signature =
    "def __init__(self, position: numpy.typing.ArrayLike, axis: numpy.typing.ArrayLike = (0, -1, 0), *, inner_deg: "
    "float = 0.0, outer_deg: float = 45.0) -> None";
constexpr const char* area_light_signature = "def __init__(self, surface: str, exponent: float = 1.0) -> None";
constexpr const char* luminaire_signature =
    "def __init__(self, photometry: Photometry | str | os.PathLike[str], position: numpy.typing.ArrayLike, aim: "
    "numpy.typing.ArrayLike = (0, -1, 0), *, rotation_deg: float = 0.0, lumens: float | None = None, scale: float | "
    "None = None, watts: float | None = None, area: bool = False, lamp_set: int = 1, flip_horizontal: bool = False) -> "
    "None";

void bind_point_shapes(nb::module_& module) {
  nb::class_<IsotropicEmitter> isotropic(module, "Isotropic",
                                         "A point emitter with the same intensity in every direction: I = Φ/4π.");
  isotropic.def("__init__",
                checked(
                    "Isotropic", isotropic_signature,
                    +[](IsotropicEmitter* self, nb::handle position) {
                      const IsotropicEmitter shape{vec3_of(position, "position of the emitter")};
                      check_shape("Isotropic", shape);
                      new (self) IsotropicEmitter(shape);
                    }),
                required("position"), other_keywords(), nb::sig(isotropic_signature), "At a position (x, y, z), m.");
  def_position(isotropic);
  def_value<IsotropicEmitter>(isotropic, [](const IsotropicEmitter& shape) {
    return nb::make_tuple(nb::make_tuple("position", tuple_of(shape.position)));
  });

  nb::class_<LambertEmitter> lambert(
      module, "Lambert", "A point emitter by the generalized Lambert law about an axis: I(θ) = Φ (m+1)/(2π) cos^m θ.");
  lambert
      .def("__init__",
           checked(
               "Lambert", lambert_signature,
               +[](LambertEmitter* self, nb::handle position, nb::handle axis, nb::handle exponent) {
                 const LambertEmitter shape{vec3_of(position, "position of the emitter"),
                                            vec3_of(axis, "axis of the emitter"),
                                            number_of(exponent, "exponent of the emitter")};
                 check_shape("Lambert", shape);
                 new (self) LambertEmitter(shape);
               }),
           required("position"), any_arg("axis") = nb::make_tuple(0, -1, 0), any_arg("exponent") = 1.0,
           other_keywords(), nb::sig(lambert_signature),
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
  spot.def("__init__",
           checked(
               "Spot", spot_signature,
               +[](SpotEmitter* self, nb::handle position, nb::handle axis, nb::handle inner, nb::handle outer) {
                 const SpotEmitter shape = spot_of(position, axis, inner, outer);
                 check_shape("Spot", shape);
                 new (self) SpotEmitter(shape);
               }),
           required("position"), any_arg("axis") = nb::make_tuple(0, -1, 0), nb::kw_only(), any_arg("inner_deg") = 0.0,
           any_arg("outer_deg") = 45.0, other_keywords(), nb::sig(spot_signature),
           R"(A spot.

Args:
    position: (x, y, z), m.
    axis: Direction of the beam, of any length but 0.
    inner_deg: Half angle of the cone of full intensity, degrees, 0 to outer_deg; equal: a hard edge.
    outer_deg: Half angle of the cone that contains all light, degrees, up to 90.)")
      .def_prop_ro(
          "inner_deg", [](const SpotEmitter& shape) { return degrees_of(shape.inner); },
          "Half angle of the cone of full intensity, degrees.")
      .def_prop_ro(
          "outer_deg", [](const SpotEmitter& shape) { return degrees_of(shape.outer); },
          "Half angle of the cone that contains all light, degrees.");
  def_position(spot);
  def_axis(spot);
  def_value<SpotEmitter>(spot, [](const SpotEmitter& shape) {
    return nb::make_tuple(
        nb::make_tuple("position", tuple_of(shape.position)), nb::make_tuple("axis", tuple_of(shape.axis)),
        nb::make_tuple("inner_deg", degrees_of(shape.inner)), nb::make_tuple("outer_deg", degrees_of(shape.outer)));
  });
}

void bind_area_light(nb::module_& module) {
  nb::class_<AreaLightShape> area(
      module, "AreaLight",
      "An area light: the front of a surface of the room emits by the generalized Lambert law about its normal.");
  area.def("__init__",
           checked(
               "AreaLight", area_light_signature,
               +[](AreaLightShape* self, nb::handle surface, nb::handle exponent) {
                 const double m = number_of(exponent, "exponent of the area light");
                 check_shape("AreaLight", LambertEmitter{{}, {0.0, -1.0, 0.0}, m});
                 new (self) AreaLightShape{text_of(surface, "name of the emitting surface"), m};
               }),
           required("surface"), any_arg("exponent") = 1.0, other_keywords(), nb::sig(area_light_signature),
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
  luminaire.def("__init__", checked("Luminaire", luminaire_signature, &make_luminaire), required("photometry"),
                required("position"), any_arg("aim") = nb::make_tuple(0, -1, 0), nb::kw_only(),
                any_arg("rotation_deg") = 0.0, any_arg("lumens") = nb::none(), any_arg("scale") = nb::none(),
                any_arg("watts") = nb::none(), any_arg("area") = false, any_arg("lamp_set") = 1,
                any_arg("flip_horizontal") = false, other_keywords(), nb::sig(luminaire_signature),
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

}  // namespace

void bind_emitter_shapes(nb::module_& module) {
  bind_point_shapes(module);
  bind_spot(module);
  bind_area_light(module);
  bind_luminaire(module);
}

}  // namespace lichtmc::python
