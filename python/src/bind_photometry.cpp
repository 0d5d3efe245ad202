// Photometric files.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "arguments.hpp"
#include "bindings.hpp"
#include "checked_call.hpp"
#include "emitter_shapes.hpp"
#include "lichtmc/error.hpp"
#include "vectors.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

PhotometryOptions options_of(nb::handle lamp_set, nb::handle flip, nb::handle needs_flux) {
  PhotometryOptions options;
  options.lamp_set = static_cast<std::size_t>(whole_number_of(lamp_set, "number of the lamp set", 1, 1'000'000));
  options.flip_horizontal = flag_of(flip, "flag flip_horizontal");
  options.needs_flux = flag_of(needs_flux, "flag needs_flux");
  return options;
}

PhotometryFile from_text(nb::handle text, nb::handle name, nb::handle lamp_set, nb::handle flip,
                         nb::handle needs_flux) {
  std::string content;
  if (nb::isinstance<nb::bytes>(text)) {
    const auto bytes = nb::borrow<nb::bytes>(text);
    content.assign(bytes.c_str(), bytes.size());
  } else {
    content = text_of(text, "content of the photometric file");
  }
  return {std::make_shared<const Photometry>(parse_photometry(content, text_of(name, "name of the photometric file"),
                                                              options_of(lamp_set, flip, needs_flux)))};
}

// Intensities in directions of the luminaire's frame.
View<double> candela(const PhotometryFile& file, nb::handle directions) {
  const std::vector<glm::dvec3> rows = rows_of_3(directions, "array of directions");
  std::array<std::vector<double>, 3> parts;
  for (const glm::dvec3& row : rows) {
    const double length = glm::length(row);
    if (!(length > 0.0) || !std::isfinite(length))
      throw InputError("The length of a direction is " + std::to_string(length) +
                       " (allowed: a finite number above 0). Give directions in the frame of the luminaire.");
    for (int k = 0; k < 3; ++k) parts[static_cast<std::size_t>(k)].push_back(row[k] / length);
  }
  std::vector<double> values(rows.size());
  file.photometry->candela->candela(rows.size(), parts[0].data(), parts[1].data(), parts[2].data(), values.data());
  const std::size_t count = values.size();
  return owned<double, 1>(std::move(values), {count});
}

nb::dict texts_of_file(const PhotometryFile& file) {
  nb::dict texts;
  for (const auto& [name, text] : file.photometry->texts) texts[nb::str(name.c_str())] = text;
  return texts;
}

using Class = nb::class_<PhotometryFile>;

template <class Value>
void def_field(Class& of, const char* name, Value Photometry::*member, const char* text) {
  of.def_prop_ro(
      name, [member](const PhotometryFile& file) { return (*file.photometry).*member; }, text);
}

// Signatures, for Python and for messages.
constexpr const char* photometry_signature =
    "def __init__(self, path: str | os.PathLike[str], *, lamp_set: int = 1, flip_horizontal: bool = False, needs_flux: "
    "bool = True) -> None";
constexpr const char* from_text_signature =
    "def from_text(text: str | bytes, name: str = 'text', *, lamp_set: int = 1, flip_horizontal: bool = False, "
    "needs_flux: bool = True) -> Photometry";

void def_making(Class& of) {
  of.def("__init__",
         checked(
             "Photometry", photometry_signature,
             +[](PhotometryFile* self, nb::handle path, nb::handle lamp_set, nb::handle flip, nb::handle needs_flux) {
               PhotometryFile file{std::make_shared<const Photometry>(
                   read_photometry(path_of(path, "photometric file"), options_of(lamp_set, flip, needs_flux)))};
               new (self) PhotometryFile(std::move(file));
             }),
         required("path"), nb::kw_only(), any_arg("lamp_set") = 1, any_arg("flip_horizontal") = false,
         any_arg("needs_flux") = true, other_keywords(), nb::sig(photometry_signature),
         R"(Reads a file; the format is recognised by its content.

Args:
    path: The file.
    lamp_set: Of a EULUMDAT file, counted from 1.
    flip_horizontal: Of files of type A or B: H counts the other way.
    needs_flux: False accepts a EULUMDAT file whose lamps have no flux; a Luminaire then needs lumens or watts.

Raises:
    InputError: The file cannot be read or is not valid; the message names the line.)")
      .def_static("from_text", checked("Photometry.from_text", from_text_signature, &from_text), required("text"),
                  any_arg("name") = "text", nb::kw_only(), any_arg("lamp_set") = 1, any_arg("flip_horizontal") = false,
                  any_arg("needs_flux") = true, other_keywords(), nb::sig(from_text_signature),
                  "The same from the content of a file; `name` stands for it in messages. A separate TILT file is "
                  "refused.");
}

void def_light(Class& of) {
  of.def_prop_ro(
        "flux", [](const PhotometryFile& file) { return file.photometry->flux(); },
        "Luminous flux of the luminaire, lm: the integral of its intensity over all directions.")
      .def("candela", &candela, any_arg("directions"), has_owner,
           nb::sig("def candela(self, directions: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]"),
           R"(Intensity, cd, in directions of the luminaire's own frame, float64 (n,).

Args:
    directions: (n, 3), or (3,) for one; of any length but 0. z is the aim (γ = 0), x points towards C0, y towards C90:
        (sin γ cos C, sin γ sin C, cos γ).)")
      .def_prop_ro(
          "peak", [](const PhotometryFile& file) { return file.photometry->candela->peak().candela; },
          "Highest intensity, cd.")
      .def_prop_ro(
          "peak_angles",
          [](const PhotometryFile& file) {
            const PeakIntensity& peak = file.photometry->candela->peak();
            return nb::make_tuple(peak.horizontal_deg, peak.vertical_deg);
          },
          nb::sig("def peak_angles(self) -> tuple[float, float]"),
          "Where it is: (horizontal, vertical) angles, degrees; of type C (C, γ).")
      .def_prop_ro(
          "flux_towards_aim", [](const PhotometryFile& file) { return file.photometry->candela->flux_towards_aim(); },
          "Part of the flux within 90° of the aim, lm.")
      .def_prop_ro(
          "type",
          [](const PhotometryFile& file) { return std::string(name_of(file.photometry->candela->grid().type)); },
          "Photometric type: 'C', 'B' or 'A'.")
      .def_prop_ro(
          "opening", [](const PhotometryFile& file) { return std::string(name_of(file.photometry->opening.form)); },
          "Form of the luminous opening: 'point', 'rectangle', 'ellipse', 'box', 'cylinder', …")
      .def_prop_ro(
          "opening_size",
          [](const PhotometryFile& file) {
            const glm::dvec3& size = file.photometry->opening.size_m;
            return owned<double, 1>({size.x, size.y, size.z}, {3});
          },
          has_owner, "Size of the opening towards C0, towards C90 and along the aim, m, float64 (3,).");
}

}  // namespace

void bind_photometry(nb::module_& module) {
  Class of(module, "Photometry",
           "A photometric file of a luminaire: IES LM-63 (1986 to 2019) or EULUMDAT. TILT factors are not applied.");
  def_making(of);
  def_light(of);
  def_field(of, "source", &Photometry::source, "The name of the file.");
  def_field(of, "version", &Photometry::version, "'LM-63-1986' … 'LM-63-2019' or 'EULUMDAT'.");
  def_field(of, "manufacturer", &Photometry::manufacturer, "As the file says; may be empty.");
  def_field(of, "luminaire", &Photometry::luminaire, "Name or description; may be empty.");
  def_field(of, "catalogue", &Photometry::catalogue, "Number of the catalogue; may be empty.");
  def_field(of, "intensity_unit", &Photometry::intensity_unit, "'cd', unless the file says otherwise.");
  def_field(of, "watts", &Photometry::watts, "Electrical input power, W; 0: not stated.");
  def_field(of, "stated_lm", &Photometry::stated_lm, "Flux that the file states or implies, lm; None: it does not.");
  def_field(of, "warnings", &Photometry::warnings, "What may change figures: a sentence each.");
  def_field(of, "notes", &Photometry::notes, "What was accepted and changes no figures: a sentence each.");
  of.def_prop_ro("texts", &texts_of_file, "Keywords or lines of the file with their texts, a dict.")
      .def_prop_ro(
          "efficacy", [](const PhotometryFile& file) { return file.photometry->efficacy(); },
          "Luminous efficacy, lm/W; None if the file states no input power.")
      .def("__repr__", [](const PhotometryFile& file) {
        const Photometry& of_file = *file.photometry;
        const nb::object text =
            nb::str("<Photometry {!r}: {}, {:.6g} {}>")
                .attr("format")(of_file.source, of_file.version, of_file.flux(),
                                of_file.intensity_unit == "cd" ? "lm" : "of " + of_file.intensity_unit + "·sr");
        return nb::cast<std::string>(text);
      });
}

}  // namespace lichtmc::python
