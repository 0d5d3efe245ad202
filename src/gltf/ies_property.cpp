#include "gltf/ies_property.hpp"

#include <cmath>

#include "base/message.hpp"

namespace lichtmc {

namespace {

constexpr const char* ies_forms =
    " (allowed: the name of a photometric file, or {\"file\": name, \"lumens\": lm or \"scale\": factor or \"watts\": "
    "W, "
    "\"rotation\": degrees, \"lampset\": n, \"opening\": \"point\" or \"area\", \"flipH\": true or false}). Set that "
    "custom property.";

// Reads the parts of one property.
class IesParts {
 public:
  IesParts(const Document& document, const tinygltf::Value& object, const std::string& where)
      : document_(document), object_(object), where_("'ies' of " + where) {}

  IesProperty read() const {
    IesProperty property;
    property.file = text("file");
    if (property.file && property.file->empty()) refuse_part("file", "is empty", "the name of a photometric file");
    property.lumens = number("lumens");
    property.scale = number("scale");
    property.watts = number("watts");
    property.rotation_deg = number("rotation");
    for (const auto& [name, value] : {std::pair{"lumens", property.lumens}, {"watts", property.watts}}) {
      if (value && !(*value > 0.0)) refuse_part(name, "is " + to_text(*value), "a finite number above 0");
    }
    if (property.scale && !(*property.scale >= 0.0))
      refuse_part("scale", "is " + to_text(*property.scale), "a finite number, 0 or more");
    if (const auto set = number("lampset")) {
      if (!(*set >= 1.0 && *set < 1e6 && *set == std::floor(*set)))
        refuse_part("lampset", "is " + to_text(*set), "a whole number, 1 for the first lamp set");
      property.lamp_set = static_cast<std::size_t>(*set);
    }
    if (const auto opening = text("opening")) {
      if (*opening != "point" && *opening != "area")
        refuse_part("opening", "is " + in_quotes(*opening), "\"point\" or \"area\"");
      property.area = *opening == "area";
    }
    if (object_.Has("flipH")) {
      if (!object_.Get("flipH").IsBool()) refuse_part("flipH", "is not a truth value", "true or false");
      property.flip_horizontal = object_.Get("flipH").Get<bool>();
    }
    const int scalings = (property.lumens ? 1 : 0) + (property.scale ? 1 : 0) + (property.watts ? 1 : 0);
    if (scalings > 1)
      refuse(document_, where_ +
                            " scales the luminaire more than once (allowed: one of 'lumens', 'scale' and 'watts'). "
                            "Remove the others.");
    return property;
  }

 private:
  [[noreturn]] void refuse_part(const char* name, const std::string& fault, const char* allowed) const {
    refuse(document_, "'" + std::string(name) + "' in " + where_ + " " + fault + " (allowed: " + allowed +
                          "). Set that custom property.");
  }

  std::optional<std::string> text(const char* name) const {
    if (!object_.Has(name)) return std::nullopt;
    if (!object_.Get(name).IsString()) refuse_part(name, "is not a text", "a text");
    return object_.Get(name).Get<std::string>();
  }

  std::optional<double> number(const char* name) const {
    if (!object_.Has(name)) return std::nullopt;
    const double value = number_in(document_, object_, name, 0.0, where_);
    if (!std::isfinite(value)) refuse_part(name, "is " + to_text(value), "a finite number");
    return value;
  }

  const Document& document_;
  const tinygltf::Value& object_;
  std::string where_;
};

}  // namespace

std::optional<IesProperty> ies_in(const Document& document, const tinygltf::Value& extras, const std::string& where) {
  if (!extras.IsObject() || !extras.Has("ies")) return std::nullopt;
  const tinygltf::Value& value = extras.Get("ies");
  if (value.IsObject()) return IesParts(document, value, where).read();
  if (!value.IsString()) refuse(document, "'ies' of " + where + " is neither a text nor an object" + ies_forms);
  IesProperty property;
  property.file = value.Get<std::string>();
  if (property.file->empty()) refuse(document, "'ies' of " + where + " is empty" + ies_forms);
  return property;
}

std::optional<IesProperty> together(const std::optional<IesProperty>& of_node,
                                    const std::optional<IesProperty>& of_light) {
  if (!of_node || !of_light) return of_node ? of_node : of_light;
  const auto first = [](const auto& a, const auto& b) { return a ? a : b; };
  IesProperty both = *of_node;
  both.file = first(of_node->file, of_light->file);
  if (!of_node->scaled()) {
    both.lumens = of_light->lumens;
    both.scale = of_light->scale;
    both.watts = of_light->watts;
  }
  both.rotation_deg = first(of_node->rotation_deg, of_light->rotation_deg);
  both.lamp_set = first(of_node->lamp_set, of_light->lamp_set);
  both.area = first(of_node->area, of_light->area);
  both.flip_horizontal = first(of_node->flip_horizontal, of_light->flip_horizontal);
  return both;
}

}  // namespace lichtmc
