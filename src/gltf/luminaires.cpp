#include "gltf/luminaires.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "base/luminance.hpp"
#include "base/message.hpp"
#include "gltf/ies_property.hpp"
#include "gltf/materials.hpp"

namespace lichtmc {

namespace {

constexpr const char* ies_extension = "EXT_lights_ies";

// What a node says about its luminaire.
struct NodeLuminaire {
  const tinygltf::Value* extension = nullptr;  // EXT_lights_ies of the node
  const tinygltf::Value* light = nullptr;      // KHR_lights_punctual
  IesProperty property;
  std::optional<double> power;  // extras.power
  Quantity unit = Quantity::photometric;
};

std::optional<NodeLuminaire> find_luminaire(const Document& document, const PlacedNode& placed) {
  const tinygltf::Node& node = document.model.nodes[placed.index];
  NodeLuminaire found;
  found.light = find_light(document, node, placed.label);
  const tinygltf::Value& of_light = extras_of(found.light);
  const std::string light_label = "the light of " + placed.label;
  const auto property = together(ies_in(document, node.extras, placed.label), ies_in(document, of_light, light_label));
  const auto extension = node.extensions.find(ies_extension);
  if (extension != node.extensions.end()) found.extension = &extension->second;
  if (!property && found.extension == nullptr) return std::nullopt;
  found.property = property.value_or(IesProperty{});
  const auto first = [](auto a, auto b) { return a ? a : b; };
  if (first(exponent_in(document, node.extras, placed.label), exponent_in(document, of_light, light_label))) {
    refuse(document, placed.label +
                         " has both a photometric file and 'lambert_exponent' (allowed: one of them gives the "
                         "distribution of its light). Remove the other custom property.");
  }
  found.power = first(power_in(document, node.extras, placed.label), power_in(document, of_light, light_label));
  found.unit = first(unit_in(document, node.extras, placed.label), unit_in(document, of_light, light_label))
                   .value_or(Quantity::photometric);
  if (found.power && found.property.scaled()) {
    refuse(document, "both 'power' and 'ies' of " + placed.label +
                         " scale its luminaire (allowed: 'power', or one of 'lumens', 'scale' and 'watts' in 'ies'). "
                         "Remove one of them.");
  }
  return found;
}

double multiplier_of(const Document& document, const tinygltf::Value& extension, const std::string& where) {
  const double multiplier = number_in(document, extension, "multiplier", 1.0, where);
  if (multiplier >= 0.0 && std::isfinite(multiplier)) return multiplier;
  refuse(document, where + ": EXT_lights_ies multiplier " + to_text(multiplier) +
                       " (allowed: a finite number, 0 or more). Export the file again.");
}

// Multiplies the intensity of the file: the multiplier and colour of the extension, else the colour of the light.
double factor_of(const Document& document, const NodeLuminaire& luminaire, const std::string& where) {
  if (luminaire.extension != nullptr) {
    const glm::dvec3 colour = colour_in(document, *luminaire.extension, "color", glm::dvec3(1.0), where);
    return multiplier_of(document, *luminaire.extension, where) * luminance(colour.r, colour.g, colour.b);
  }
  return luminaire.light != nullptr ? colour_of(document, *luminaire.light, where) : 1.0;
}

// The scalings of 'power' and 'ies' together with the factor.
LuminaireOptions options_of(const NodeLuminaire& luminaire, double factor) {
  LuminaireOptions options;
  options.rotation_deg = luminaire.property.rotation_deg.value_or(0.0);
  options.area = luminaire.property.area.value_or(false);
  options.lumens = luminaire.property.lumens;
  options.watts = luminaire.property.watts;
  if (luminaire.power && luminaire.unit == Quantity::radiometric) options.watts = luminaire.power;
  if (luminaire.power && luminaire.unit == Quantity::photometric) options.lumens = luminaire.power;
  if (!options.lumens && !options.watts) options.scale = luminaire.property.scale.value_or(1.0) * factor;
  return options;
}

// Directions of a node: it looks along −Z, C0 lies towards +X, C90 towards +Y. Scales do not count; a node that mirrors
// has mirrored axes. `oblique`: whether its axes are not at right angles, so that those across the aim were turned.
LuminaireAxes axes_of_node(const Document& document, const PlacedNode& placed, bool& oblique) {
  const glm::dmat3 world(placed.world);
  glm::dvec3 unit[3];
  for (int k = 0; k < 3; ++k) {
    const double length = glm::length(world[k]);
    unit[k] = length > 0.0 ? world[k] / length : glm::dvec3(0.0);
  }
  LuminaireAxes axes;
  axes.aim = axis_of(document, placed);
  const double handedness = glm::dot(glm::cross(unit[0], unit[1]), unit[2]) < 0.0 ? -1.0 : 1.0;
  const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, axes.aim) * axes.aim; };
  glm::dvec3 c0 = across(unit[0]);
  if (!(glm::length(c0) > 1e-9)) c0 = handedness * glm::cross(axes.aim, across(unit[1]));
  if (!(glm::length(c0) > 1e-9))
    refuse(document, placed.label +
                         " has the scale 0 along X and Y, so that its luminaire has no direction C0 (allowed: a scale "
                         "other than 0). Set its scale.");
  axes.c0 = glm::normalize(c0);
  axes.c90 = handedness * glm::cross(axes.c0, axes.aim);
  constexpr double noticeable = 0.02;  // sine of the angle by which an axis is turned: 1 degree
  const auto turned = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return from != glm::dvec3(0.0) && glm::length(to - from) > noticeable;
  };
  oblique = turned(unit[0], axes.c0) || turned(unit[1], axes.c90);
  return axes;
}

}  // namespace

std::optional<FileEmitter> Luminaires::read(const PlacedNode& placed, std::vector<Ignored>& ignored) {
  const Document& document = *document_;
  const auto luminaire = find_luminaire(document, placed);
  if (!luminaire) return std::nullopt;
  const IesProperty* property = &luminaire->property;
  NodeLuminaire used = *luminaire;
  if (luminaire->extension != nullptr && property->file) {
    ignored.push_back({"'ies' of " + placed.label + " is not read: the file of EXT_lights_ies precedes it.",
                       Effect::figures,
                       "Remove the custom property, or 'file' in it if its other parts are to count."});
    used.property = {};
  } else if (luminaire->extension == nullptr && !property->file) {
    refuse(document, "'ies' of " + placed.label +
                         " names no photometric file (allowed: 'file', or the extension EXT_lights_ies at the same "
                         "node). Set 'file' in that custom property.");
  }
  const double factor = factor_of(document, used, placed.label);
  LuminaireOptions options = options_of(used, factor);
  PhotometryOptions reading;
  reading.lamp_set = used.property.lamp_set.value_or(1);
  reading.flip_horizontal = used.property.flip_horizontal.value_or(false);
  reading.needs_flux = !options.lumens && !options.watts;
  const auto photometry = used.extension != nullptr
                              ? files_.of_light(number_in(document, *used.extension, "light", -1.0, placed.label),
                                                reading, placed.label, ignored)
                              : files_.of_name(*used.property.file, reading, placed.label, ignored);

  bool oblique = false;
  const LuminaireAxes axes = axes_of_node(document, placed, oblique);
  if (oblique && photometry->candela->grid().symmetry != PhotometricSymmetry::rotational) {
    ignored.push_back({"The axes of " + placed.label +
                           " are not at right angles: its luminaire has its aim, and C0 as near to its X axis as "
                           "possible.",
                       Effect::figures, "Apply the scales of its parents."});
  }
  const bool multiplied = used.extension != nullptr && used.extension->Has("multiplier");
  const double flux = options.lumens.value_or(0.0);
  if (multiplied && !options.scale && std::abs(photometry->flux() * factor - flux) > 1e-6 * flux)
    ignored.push_back({"The multiplier of EXT_lights_ies of " + placed.label +
                           " does not count: a custom property gives the power of this luminaire.",
                       Effect::none});
  // A power of 0 is allowed, as for other lights; a luminaire is not scaled to it.
  const bool dark = luminaire->power && *luminaire->power == 0.0;
  if (dark && options.lumens) options.lumens = 1.0;
  if (dark && options.watts) options.watts = 1.0;
  LuminaireEmitter mounted = mount(photometry, placed.position(), axes, options, document.file + ": " + placed.label);
  if (dark) mounted.power = 0.0;
  FileEmitter result;
  result.quantity = mounted.quantity;
  result.emitter.power = mounted.power;
  result.emitter.shape = std::move(mounted.shape);
  const std::string light_label = "the light of " + placed.label;
  result.emitter.delay_s = delay_in(document, extras_of(used.light), light_label).value_or(0.0);
  set_maintenance(result.emitter, maintenance_in(document, extras_of(used.light), light_label));
  return result;
}

}  // namespace lichtmc
