#include "gltf/custom_properties.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "base/message.hpp"
#include "base/names.hpp"
#include "gltf/prepare.hpp"

namespace lichtmc {

namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 11> properties{"reflectance",
                                                      "power",
                                                      "unit",
                                                      "lambert_exponent",
                                                      "delay_ns",
                                                      "receiver",
                                                      "ies",
                                                      "calculation_area",
                                                      "target_lx",
                                                      "target_uniformity",
                                                      "maintenance_factor"};

// Of nodes with 'calculation_area'; elsewhere these words mean other things.
constexpr std::array<std::string_view, 5> area_properties{"spacing", "margin", "quantity", "direction", "cells"};

struct Synonym {
  std::string_view word;  // in lower case, without spaces, hyphens and underscores
  std::string_view property;
};

// Other words for the properties, in English and German.
constexpr std::array synonyms{
    Synonym{"albedo", "reflectance"},
    Synonym{"diffusereflectance", "reflectance"},
    Synonym{"reflectivity", "reflectance"},
    Synonym{"reflection", "reflectance"},
    Synonym{"reflectionfactor", "reflectance"},
    Synonym{"reflectancefactor", "reflectance"},
    Synonym{"reflexionsgrad", "reflectance"},
    Synonym{"rho", "reflectance"},
    Synonym{"ρ", "reflectance"},
    Synonym{"flux", "power"},
    Synonym{"leistung", "power"},
    Synonym{"lichtstrom", "power"},
    Synonym{"lm", "power"},
    Synonym{"lumen", "power"},
    Synonym{"lumens", "power"},
    Synonym{"luminousflux", "power"},
    Synonym{"luminouspower", "power"},
    Synonym{"radiantflux", "power"},
    Synonym{"watt", "power"},
    Synonym{"watts", "power"},
    Synonym{"wattage", "power"},
    Synonym{"einheit", "unit"},
    Synonym{"powerunit", "unit"},
    Synonym{"units", "unit"},
    Synonym{"cosexponent", "lambert_exponent"},
    Synonym{"exponent", "lambert_exponent"},
    Synonym{"lambert", "lambert_exponent"},
    Synonym{"delay", "delay_ns"},
    Synonym{"latency", "delay_ns"},
    Synonym{"verzögerung", "delay_ns"},
    Synonym{"berechnungsfläche", "calculation_area"},
    Synonym{"calculationplane", "calculation_area"},
    Synonym{"calculationsurface", "calculation_area"},
    Synonym{"calcarea", "calculation_area"},
    Synonym{"measurementarea", "calculation_area"},
    Synonym{"workingplane", "calculation_area"},
    Synonym{"targetilluminance", "target_lx"},
    Synonym{"targetlux", "target_lx"},
    Synonym{"targetem", "target_lx"},
    Synonym{"targetu0", "target_uniformity"},
    Synonym{"lightlossfactor", "maintenance_factor"},
    Synonym{"llf", "maintenance_factor"},
    Synonym{"maintenance", "maintenance_factor"},
    Synonym{"mf", "maintenance_factor"},
    Synonym{"wartungsfaktor", "maintenance_factor"},
    Synonym{"calculationpoint", "receiver"},
    Synonym{"detector", "receiver"},
    Synonym{"empfänger", "receiver"},
    Synonym{"receivers", "receiver"},
    Synonym{"sensor", "receiver"},
    Synonym{"eulumdat", "ies"},
    Synonym{"iesfile", "ies"},
    Synonym{"iesprofile", "ies"},
    Synonym{"ldt", "ies"},
    Synonym{"ldtfile", "ies"},
    Synonym{"lvk", "ies"},
    Synonym{"photometricfile", "ies"},
    Synonym{"photometry", "ies"},
};

// In lower case, without spaces, hyphens and underscores, and without the number that Blender appends (".001").
std::string plain(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c != ' ' && c != '_' && c != '-') text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const std::size_t dot = text.find_last_not_of("0123456789");
  if (dot != std::string::npos && dot + 1 < text.size() && dot > 0 && text[dot] == '.') text.resize(dot);
  return text;
}

// What an object of the file is, as far as it matters for its properties.
enum class Place { node, light, material, mesh, camera, scene };

// Whether a value can be what a property is meant to have. Other programs have properties of these names with other
// values, for example a unit of length.
bool fits(std::string_view property, const Json& value) {
  const std::string text = value.is_string() ? plain(value.get<std::string>()) : "";
  if (property == "unit") return text == "w" || text == "lm" || text == "watt" || text == "lumen";
  if (property == "calculation_area") return value.is_string() || value.is_boolean() || value.is_number();
  if (property == "receiver") return value.is_object() || value.is_boolean() || value.is_number();
  if (property == "ies")
    return text.ends_with(".ies") || text.ends_with(".ldt") || (value.is_object() && value.contains("file"));
  return value.is_number() ||
         (!text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) != 0 || text[0] == '.'));
}

bool emits(const Json& material) {
  const Json none;
  const Json& factor = material.contains("emissiveFactor") ? material["emissiveFactor"] : none;
  const bool colour = factor.is_array() && std::any_of(factor.begin(), factor.end(), [](const Json& channel) {
                        return channel.is_number() && channel.get<double>() > 0.0;
                      });
  const bool power =
      material.contains("extras") && material["extras"].is_object() && material["extras"].contains("power");
  return colour || power;
}

bool has_extra(const Json& object, const char* name) {
  return object.contains("extras") && object["extras"].is_object() && object["extras"].contains(name);
}

bool has_light(const Json& node) {
  if (has_extra(node, "ies")) return true;
  return node.contains("extensions") && node["extensions"].is_object() &&
         (node["extensions"].contains("KHR_lights_punctual") || node["extensions"].contains("EXT_lights_ies"));
}

// Properties of emitters of which a node may have one for all that it emits.
bool is_of_node(std::string_view property) {
  return property == "delay_ns" || property == "maintenance_factor";
}

// Whether an object belongs to an emitter, so that a delay there means that of its light. Other programs have delays of
// animations and sounds, and maintenance of machines.
bool may_emit(Place place, const Json& object) {
  if (place == Place::material) return emits(object);
  return place == Place::light ||
         (place == Place::node && (has_light(object) || has_extra(object, "lambert_exponent")));
}

// Where a property belongs that an object does not use; empty if the object uses it.
std::string right_place(std::string_view property, Place place, const Json& object) {
  const bool at_node = place == Place::node;
  if (property == "reflectance") return place == Place::material ? "" : "the material";
  if (property == "receiver") return at_node ? "" : "a node (an empty)";
  if (property == "calculation_area") return at_node ? "" : "the node (the object) that has the mesh";
  if (property == "target_lx" || property == "target_uniformity")
    return at_node && has_extra(object, "calculation_area") ? "" : "a node with 'calculation_area'";
  if (property == "ies") return at_node || place == Place::light ? "" : "a node or its light";
  if (is_of_node(property) && at_node) return "";  // the reader of the room knows whether its mesh emits
  if (property == "lambert_exponent" && at_node) return "";
  if (place == Place::light) return "";
  if (place == Place::material && (property == "power" || emits(object))) return "";
  if (at_node && (has_light(object) || has_extra(object, "lambert_exponent"))) return "";
  if (at_node && property == "power" && !object.contains("mesh")) return "";  // read_light() names it
  if (place == Place::material) return "an emissive material, or the node of a light";
  return "the emissive material of the surface, or the node of a light";
}

class Checker {
 public:
  explicit Checker(const Document& document) : document_(document) {}

  void check(Json& object, Place place, const std::string& where) {
    if (!object.is_object() || !object.contains("extras") || !object["extras"].is_object()) return;
    Json& extras = object["extras"];
    const bool area = place == Place::node && has_extra(object, "calculation_area");
    for (auto& [name, value] : extras.items()) {
      if (area && check_of_area(name, value, extras, where)) continue;
      const std::string_view meant = meant_property(name);
      if (meant.empty() || (is_of_node(meant) && name != meant && !may_emit(place, object))) continue;
      const std::string to = right_place(meant, place, object);
      if (name == meant && to.empty()) {
        check_value(name, value, where);
      } else if (!extras.contains(meant) || name == meant) {
        const bool sure = name == meant && meant != "unit" && place != Place::scene;
        if (sure || fits(meant, value)) note(name, meant, to, where);
      }
    }
  }

  std::vector<Ignored> notes;
  bool changed = false;

 private:
  // Whether a property of a calculation area has a name that only areas have.
  bool check_of_area(const std::string& name, const Json& value, const Json& extras, const std::string& where) {
    for (const std::string_view property : area_properties) {
      if (name == property) {
        if (value.is_null())
          refuse(document_, "'" + name + "' of " + where + " has no value. Set this custom property.");
        return true;
      }
      if (edit_distance(plain(name), property) > 1 || extras.contains(property)) continue;
      note(name, property, "", where);
      return true;
    }
    return false;
  }

  // The parser drops null and empty objects.
  void check_value(const std::string& name, Json& value, const std::string& where) {
    if (value.is_null()) refuse(document_, "'" + name + "' of " + where + " has no value. Set this custom property.");
    if (name == "receiver" && value.is_object() && value.empty()) {
      value["area"] = 1.0;
      changed = true;
    }
    // The same as none: the light is a point.
    if (name == "ies" && value.is_object() && value.empty()) {
      value["opening"] = "point";
      changed = true;
    }
    if (name == "receiver") {
      check_parts(name, value, {"area", "fov", "concentrator_index", "filter_gain", "quantity"},
                  "'area' in m², 'fov', the half angle in degrees, 'concentrator_index', 'filter_gain', 'quantity'",
                  where);
    } else if (name == "ies") {
      check_parts(name, value, {"file", "lumens", "scale", "watts", "rotation", "lampset", "opening", "flipH"},
                  "'file', 'lumens', 'scale', 'watts', 'rotation', 'lampset', 'opening', 'flipH'", where);
    }
  }

  // Parts of an object that are not read.
  void check_parts(const std::string& name, const Json& value, const std::set<std::string>& read, const char* allowed,
                   const std::string& where) {
    if (!value.is_object()) return;
    for (const auto& [part, content] : value.items()) {
      if (read.count(part) != 0) continue;
      notes.push_back({"'" + part + "' in the custom property '" + name + "' of " + where +
                           " is not read (allowed: " + allowed + ").",
                       Effect::figures, "Correct its name, or remove it."});
    }
  }

  void note(const std::string& name, std::string_view meant, const std::string& to, const std::string& where) {
    const std::string right(meant);
    std::string advice = name == right ? "Set it" : "Set '" + right + "'";
    advice += to.empty() ? " there instead." : " on " + to + " instead.";
    notes.push_back({"The custom property '" + name + "' of " + where + " is not read" +
                         (name == right ? ": it does not belong there." : ": the name is '" + right + "'."),
                     Effect::figures, advice});
  }

  const Document& document_;
};

// The words of a name in lower case: "Ceiling_Lamp.001" has "ceiling" and "lamp". "AreaLight" has "area" and "light".
std::set<std::string> words_of(const std::string& name) {
  std::set<std::string> words;
  std::string word;
  const auto end_word = [&] {
    if (!word.empty()) words.insert(word);
    word.clear();
  };
  char before = ' ';
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    const bool letter = std::isalpha(u) != 0 || u >= 0x80;
    if (!letter || (std::isupper(u) != 0 && std::islower(static_cast<unsigned char>(before)) != 0)) end_word();
    if (letter) word += static_cast<char>(std::tolower(u));
    before = c;
  }
  end_word();
  return words;
}

// Names that Blender gives lights, and words for light or lamp in the languages of its users.
bool sounds_like_light(const std::string& name) {
  static const std::set<std::string> lights{
      "area",     "arealight", "lamp",  "lamps", "light",   "lights",    "point",   "pointlight",
      "spot",     "spotlight", "sun",   "hemi",  "licht",   "lampe",     "lampen",  "leuchte",
      "leuchten", "strahler",  "sonne", "punkt", "fläche",  "lumière",   "lumiere", "luminaire",
      "lámpara",  "lampara",   "luz",   "luce",  "lampada", "luminaria", "lampa",   "свет",
      "лампа",    "灯",        "灯光",  "光",    "光源",    "ライト",    "ランプ",  "照明"};
  for (const std::string& word : words_of(name)) {
    if (lights.count(word) != 0) return true;
  }
  return false;
}

// A node that holds nothing.
bool is_empty_node(const Json& node) {
  const auto holds = [&](const char* list) { return node.contains(list) && !node[list].empty(); };
  return !node.contains("mesh") && !node.contains("camera") && !holds("children") && !holds("extensions") &&
         !has_extra(node, "power") && !has_extra(node, "lambert_exponent") && !has_extra(node, "receiver") &&
         !has_extra(node, "ies");
}

void note_empty_lights(Json& json, std::vector<Ignored>& notes) {
  constexpr std::size_t shown = 5;
  std::size_t count = 0;
  std::string names;
  for (const Json& node : list_in(json, "nodes")) {
    if (!node.is_object() || !node.contains("name") || !node["name"].is_string() || !is_empty_node(node)) continue;
    const std::string name = node["name"].get<std::string>();
    if (!sounds_like_light(name)) continue;
    if (++count <= shown) names += (names.empty() ? "" : ", ") + in_quotes(name);
  }
  if (count == 0) return;
  if (count > shown) names += " and " + std::to_string(count - shown) + " more";
  notes.push_back(
      {to_text(count, "empty node") + (count == 1 ? " has the name of a light: " : " have names of lights: ") + names +
           ". " + (count == 1 ? "It emits" : "They emit") + " nothing.",
       Effect::none,
       "If there was a lamp, the export left it out (Blender: area lamps always; other lamps unless Punctual "
       "Lights is ticked in the export). Replace an area lamp by a plane with an emissive material, or by a "
       "point or spot light."});
}

}  // namespace

std::string_view meant_property(std::string_view name) {
  constexpr std::size_t longest = 40;
  if (name.empty() || name.size() > longest) return "";
  const std::string text = plain(name);
  for (const Synonym& synonym : synonyms) {
    if (text == synonym.word) return synonym.property;
  }
  for (const std::string_view property : properties) {
    const std::string right = plain(property);
    // One slip in short names, two in long ones. The first letter must be right: "tower" is another word.
    const std::size_t slips = right.size() <= 6 ? 1 : 2;
    if (!text.empty() && text.front() == right.front() && edit_distance(text, right) <= slips) return property;
  }
  return "";
}

std::vector<Ignored> check_custom_properties(const Document& document, Json& json, bool& changed) {
  Checker checker(document);
  const auto check_all = [&](Json& owner, const char* list, const char* kind, Place place) {
    std::size_t index = 0;
    for (Json& object : list_in(owner, list)) {
      const bool named = object.is_object() && object.contains("name") && object["name"].is_string();
      checker.check(object, place, label(kind, named ? object["name"].get<std::string>() : "", index++));
    }
  };
  check_all(json, "nodes", "node", Place::node);
  check_all(json, "meshes", "mesh", Place::mesh);
  check_all(json, "materials", "material", Place::material);
  check_all(json, "cameras", "camera", Place::camera);
  check_all(json, "scenes", "scene", Place::scene);
  if (json.is_object() && json.contains("extensions") && json["extensions"].is_object() &&
      json["extensions"].contains("KHR_lights_punctual"))
    check_all(json["extensions"]["KHR_lights_punctual"], "lights", "light", Place::light);
  note_empty_lights(json, checker.notes);
  changed = checker.changed;
  return std::move(checker.notes);
}

}  // namespace lichtmc
