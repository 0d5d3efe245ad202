#include "gltf/lights.hpp"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "base/luminance.hpp"
#include "base/message.hpp"
#include "gltf/materials.hpp"

namespace lichtmc {

namespace {

constexpr const char* lights_extension = "KHR_lights_punctual";
constexpr double pi = std::numbers::pi;

const tinygltf::Value& empty_object() {
  static const tinygltf::Value empty;
  return empty;
}

const tinygltf::Value& member(const tinygltf::Value& object, const char* name) {
  return object.IsObject() && object.Has(name) ? object.Get(name) : empty_object();
}

}  // namespace

// The entry of the light in the file's list, read as JSON: the parser of Debian 12 does not assign lights to nodes.
const tinygltf::Value* find_light(const Document& document, const tinygltf::Node& node, const std::string& where) {
  const auto on_node = node.extensions.find(lights_extension);
  if (on_node == node.extensions.end()) return nullptr;
  const auto in_file = document.model.extensions.find(lights_extension);
  const tinygltf::Value& lights =
      in_file == document.model.extensions.end() ? empty_object() : member(in_file->second, "lights");
  const std::size_t count = lights.IsArray() ? lights.ArrayLen() : 0;
  const double index = number_in(document, on_node->second, "light", -1.0, where);
  if (!(index >= 0.0 && index < static_cast<double>(count)) || index != std::floor(index)) {
    refuse(document, "the light of " + where + " is number " + to_text(index) + ", but there are " +
                         std::to_string(count) + ". Export the file again.");
  }
  return &lights.Get<tinygltf::Value::Array>()[static_cast<std::size_t>(index)];
}

double colour_of(const Document& document, const tinygltf::Value& light, const std::string& where) {
  const tinygltf::Value& colour = member(light, "color");
  if (!colour.IsArray()) return 1.0;
  double rgb[3] = {1.0, 1.0, 1.0};
  if (colour.ArrayLen() != 3)
    refuse(document, "the colour of the light of " + where + " does not have 3 components. Export the file again.");
  for (std::size_t k = 0; k < 3; ++k) {
    const tinygltf::Value& value = colour.Get<tinygltf::Value::Array>()[k];
    if (!value.IsNumber())
      refuse(document, "the colour of the light of " + where + " is not made of numbers. Export the file again.");
    rgb[k] = value.GetNumberAsDouble();
  }
  return luminance(rgb[0], rgb[1], rgb[2]);
}

const tinygltf::Value& extras_of(const tinygltf::Value* light) {
  return light != nullptr ? member(*light, "extras") : empty_object();
}

glm::dvec3 axis_of(const Document& document, const PlacedNode& placed) {
  const glm::dvec3 forward = placed.forward();
  const double length = glm::length(forward);
  if (length > 0.0) return forward / length;
  refuse(document,
         placed.label +
             " has the scale 0 along Z, so that its light has no direction (allowed: a scale other than 0). Set "
             "its scale.");
}

namespace {

SpotEmitter read_spot(const Document& document, const tinygltf::Value& light, const PlacedNode& placed) {
  SpotEmitter spot;
  const tinygltf::Value& cones = member(light, "spot");
  spot.position = placed.position();
  spot.axis = axis_of(document, placed);
  spot.inner = number_in(document, cones, "innerConeAngle", 0.0, placed.label);
  spot.outer = number_in(document, cones, "outerConeAngle", pi / 4.0, placed.label);
  if (spot.law().fault()) {
    refuse(document, "the cone angles of the spot of " + placed.label + " are " + to_text(spot.inner) +
                         " (inner) and " + to_text(spot.outer) +
                         " rad (outer) (allowed: 0 ≤ inner ≤ outer, outer from 1e-6 to π/2). Set its size and blend.");
  }
  return spot;
}

// A point or spot light, with the power that follows from its intensity.
std::optional<Emitter> read_punctual(const Document& document, const tinygltf::Value& light, const PlacedNode& placed,
                                     std::vector<Ignored>& ignored) {
  const std::string type = member(light, "type").IsString() ? light.Get("type").Get<std::string>() : "";
  if (type == "directional") {
    ignored.push_back({"The directional light of " + placed.label +
                           " is not modelled: it has no position in a room. For daylight, place an emissive surface in "
                           "the opening; or use a point or spot light.",
                       Effect::figures});
    return std::nullopt;
  }
  const double intensity =
      number_in(document, light, "intensity", 1.0, placed.label) * colour_of(document, light, placed.label);
  if (!(intensity >= 0.0) || !std::isfinite(intensity)) {
    refuse(document, "the intensity of the light of " + placed.label + " is " + to_text(intensity) +
                         " cd (allowed: a finite number, 0 or more). Set its strength.");
  }
  if (light.Has("range"))
    ignored.push_back({"The range of the light of " + placed.label +
                           " is not modelled: the intensity does not depend on the distance.",
                       Effect::figures});
  Emitter emitter;
  if (type == "point") {
    emitter.power = 4.0 * pi * intensity;
    emitter.shape = IsotropicEmitter{placed.position()};
    return emitter;
  }
  if (type != "spot")
    refuse(document, "the light of " + placed.label + " is of the type '" + type +
                         "' (allowed: point, spot, directional). Export the file again.");
  const SpotEmitter spot = read_spot(document, light, placed);
  emitter.power = intensity * spot.law().solid_angle();
  emitter.shape = spot;
  return emitter;
}

}  // namespace

std::optional<FileEmitter> read_light(const Document& document, const PlacedNode& placed,
                                      std::vector<Ignored>& ignored) {
  const tinygltf::Node& node = document.model.nodes[placed.index];
  const tinygltf::Value* light = find_light(document, node, placed.label);
  const tinygltf::Value& of_light = extras_of(light);
  const std::string light_label = "the light of " + placed.label;

  // Extras of the node take precedence over those of the light, which several nodes may share.
  const auto first = [](auto a, auto b) { return a ? a : b; };
  const auto exponent =
      first(exponent_in(document, node.extras, placed.label), exponent_in(document, of_light, light_label));
  const auto power = first(power_in(document, node.extras, placed.label), power_in(document, of_light, light_label));

  FileEmitter result;
  if (light != nullptr) {
    auto emitter = read_punctual(document, *light, placed, ignored);
    if (!emitter) return std::nullopt;
    result.emitter = *emitter;
  } else if (!exponent) {
    if (power && node.mesh < 0)  // with a mesh: check_custom_properties()
      ignored.push_back({"'power' of " + placed.label +
                             ": the node has neither a light nor 'lambert_exponent' and is no emitter. Give it one of "
                             "them, or remove 'power'.",
                         Effect::figures});
    return std::nullopt;
  } else if (!power) {
    refuse(document, placed.label +
                         " has 'lambert_exponent' but neither a light nor a power. Set its custom property 'power' "
                         "(and 'unit', \"lm\" or \"W\"), or give it a light.");
  }
  result.emitter.name = node.name.empty() ? placed.label : node.name;
  result.emitter.delay_s = delay_in(document, of_light, light_label).value_or(0.0);
  set_maintenance(result.emitter, maintenance_in(document, of_light, light_label));
  // Read only here: nodes that emit nothing may have a 'unit' of another program.
  const auto unit = first(unit_in(document, node.extras, placed.label), unit_in(document, of_light, light_label));
  result.quantity = unit.value_or(Quantity::photometric);
  if (power) result.emitter.power = *power;
  // This replaces the shape; the power is kept.
  if (exponent) result.emitter.shape = LambertEmitter{placed.position(), axis_of(document, placed), *exponent};
  return result;
}

void set_delay_of_node(const Document& document, const PlacedNode& placed, std::size_t first, Room& room) {
  const auto delay_s = delay_in(document, document.model.nodes[placed.index].extras, placed.label);
  if (!delay_s) return;
  for (std::size_t n = first; n < room.emitters.size(); ++n) room.emitters[n].delay_s = *delay_s;
  if (first < room.emitters.size()) return;
  room.ignored.push_back({"'delay_ns' of " + placed.label + ": nothing of this node emits light.", Effect::figures,
                          "Set it on the node of a light or of an emissive surface, or remove it."});
}

void set_maintenance_of_node(const Document& document, const PlacedNode& placed, std::size_t first, Room& room) {
  const auto factor = maintenance_in(document, document.model.nodes[placed.index].extras, placed.label);
  for (std::size_t n = first; n < room.emitters.size(); ++n) {
    Emitter& emitter = room.emitters[n];
    set_maintenance(emitter, factor);
    emitter.power *= emitter.maintenance_factor;
  }
  if (!factor || first < room.emitters.size()) return;
  room.ignored.push_back({"'maintenance_factor' of " + placed.label + ": nothing of this node emits light.",
                          Effect::figures, "Set it on the node of a light or of an emissive surface, or remove it."});
}

namespace {

// The concentrator and the filter.
void read_optics(const Document& document, const tinygltf::Value& extras, const std::string& where,
                 Receiver& receiver) {
  if (extras.Has("concentrator_index")) {
    const double index = number_in(document, extras, "concentrator_index", 1.0, where);
    if (!(index >= 1.0) || !std::isfinite(index))
      refuse(document, "'concentrator_index' of the receiver " + where + " is " + to_text(index) +
                           " (allowed: a finite number, 1 or more, the refractive index). Set that custom property.");
    receiver.concentrator_index = index;
  }
  receiver.filter_gain = number_in(document, extras, "filter_gain", 1.0, where);
  if (!(receiver.filter_gain >= 0.0) || !std::isfinite(receiver.filter_gain))
    refuse(document, "'filter_gain' of the receiver " + where + " is " + to_text(receiver.filter_gain) +
                         " (allowed: a finite number, 0 or more, the share of the light that the filter lets "
                         "through). Set that custom property.");
}

// Cylinders stand upright; half cylinders face where the node looks, as far as that is level.
void read_law(const Document& document, const tinygltf::Value& extras, const std::string& where, Receiver& receiver) {
  if (!extras.Has("quantity")) return;
  const tinygltf::Value& quantity = extras.Get("quantity");
  const std::string text = quantity.IsString() ? quantity.Get<std::string>() : "(not a text)";
  bool known = false;
  for (const ReceiverLaw law : {ReceiverLaw::planar, ReceiverLaw::cylindrical, ReceiverLaw::semicylindrical}) {
    if (text != to_string(law)) continue;
    receiver.law = law;
    known = true;
  }
  if (!known)
    refuse(document, "'quantity' of the receiver " + where + " is '" + text +
                         "' (allowed: \"planar\", \"cylindrical\" or \"semicylindrical\"). Correct this custom "
                         "property.");
  if (receiver.law == ReceiverLaw::planar) return;
  const glm::dvec3 looks = receiver.normal;
  const glm::dvec3 level(looks.x, 0.0, looks.z);
  constexpr double least = 1e-3;  // sine of the angle to the vertical: the direction of the rest would be rounding
  if (receiver.law == ReceiverLaw::semicylindrical) {
    if (glm::length(level) < least)
      refuse(document, "the semicylindrical receiver " + where +
                           " looks straight up or down (allowed: a node whose -Z axis points to the side that the half "
                           "cylinder faces). Rotate the node.");
    receiver.facing = glm::normalize(level);
  }
  receiver.normal = {0.0, 1.0, 0.0};
}

}  // namespace

std::optional<Receiver> read_receiver(const Document& document, const PlacedNode& placed) {
  const tinygltf::Node& node = document.model.nodes[placed.index];
  const tinygltf::Value& extras = member(node.extras, "receiver");
  if (!extras.IsObject()) {
    if (node.extras.IsObject() && node.extras.Has("receiver")) {
      refuse(document, "'receiver' of " + placed.label +
                           " is not an object (allowed: {\"area\": m², \"fov\": degrees, \"concentrator_index\": n, "
                           "\"filter_gain\": T, \"quantity\": \"planar\", \"cylindrical\" or "
                           "\"semicylindrical\"}). Set that custom property.");
    }
    return std::nullopt;
  }
  Receiver receiver;
  receiver.name = node.name.empty() ? placed.label : node.name;
  receiver.position = placed.position();
  receiver.normal = axis_of(document, placed);
  read_law(document, extras, placed.label, receiver);
  receiver.area_m2 = number_in(document, extras, "area", 1.0, placed.label);
  receiver.half_angle_deg = number_in(document, extras, "fov", 90.0, placed.label);
  if (!(receiver.half_angle_deg >= 0.0 && receiver.half_angle_deg <= 90.0)) {
    refuse(document, "'fov' of the receiver " + placed.label + " is " + to_text(receiver.half_angle_deg) +
                         " degrees (allowed: 0 to 90, the half angle). Set that custom property.");
  }
  if (!(receiver.area_m2 >= 0.0) || !std::isfinite(receiver.area_m2)) {
    refuse(document, "'area' of the receiver " + placed.label + " is " + to_text(receiver.area_m2) +
                         " m² (allowed: a finite number, 0 or more). Set that custom property.");
  }
  if (receiver.law != ReceiverLaw::planar && receiver.half_angle_deg != 90.0)
    refuse(document, "'fov' of the receiver " + placed.label + " is " + to_text(receiver.half_angle_deg) +
                         " degrees (allowed with 'quantity': 90, all directions). Remove one of both.");
  read_optics(document, extras, placed.label, receiver);
  if (receiver.law != ReceiverLaw::planar && receiver.concentrator_index)
    refuse(document, "the receiver " + placed.label + " has 'quantity' and 'concentrator_index' " +
                         to_text(*receiver.concentrator_index) +
                         " (allowed: one of both; a concentrator is for planar receivers). Remove one of them.");
  return receiver;
}

}  // namespace lichtmc
