#include "gltf/extensions.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/message.hpp"

namespace lichtmc {

namespace {

using Json = nlohmann::json;

enum class Role {
  read,      // its content is used
  texture,   // another format of image: read, or refused where a surface needs the image
  gloss,     // of a material: how it reflects. note_ignored_materials() decides by its values
  transmit,  // of a material: light that passes it. The same; a file that requires it is refused
  harmless,  // without influence on geometry, reflectance, emitters and receivers
};

struct Known {
  std::string_view name;
  Role role;
  std::string_view reason;  // why it is harmless
};

constexpr std::string_view metadata = "it contains information about the file";
constexpr std::string_view motion = "it moves objects; the room is read at rest";
constexpr std::string_view physics = "it describes bodies for a simulation of motion";
constexpr std::string_view interaction = "it describes reactions to a user";
constexpr std::string_view about_sound = "it describes sound";
constexpr std::string_view about_lines = "it describes how edges are drawn";
constexpr std::string_view gloss_textures = "it names textures of roughness and normals, which are not modelled";

// Registered extensions of https://github.com/KhronosGroup/glTF/tree/main/extensions, and others that are common.
// An extension belongs to the harmless ones only if no value of it can change a figure. Not among them, for example:
// KHR_gaussian_splatting and EXT_primitive_voxels (bodies that are no triangles), CESIUM_RTC (moves the room),
// KHR_techniques_webgl (replaces materials), MSFT_lod (other nodes in place of a node), MOZ_hubs_components (may add
// lights), EXT_lights_image_based (light).
constexpr std::array known_extensions{
    Known{"EXT_lights_ies", Role::read, ""},
    Known{"EXT_mesh_gpu_instancing", Role::read, ""},
    Known{"EXT_meshopt_compression", Role::read, ""},
    Known{"KHR_draco_mesh_compression", Role::read, ""},
    Known{"KHR_lights_punctual", Role::read, ""},
    Known{"KHR_materials_emissive_strength", Role::read, ""},
    Known{"KHR_materials_unlit", Role::gloss, ""},
    Known{"KHR_mesh_quantization", Role::read, ""},
    Known{"KHR_node_visibility", Role::read, ""},
    Known{"KHR_texture_transform", Role::read, ""},

    Known{"EXT_texture_webp", Role::texture, ""},
    Known{"EXT_texture_avif", Role::texture, ""},
    Known{"KHR_texture_basisu", Role::texture, ""},
    Known{"MSFT_texture_dds", Role::texture, ""},

    Known{"KHR_materials_anisotropy", Role::gloss, ""},
    Known{"KHR_materials_clearcoat", Role::gloss, ""},
    Known{"KHR_materials_ior", Role::gloss, ""},
    Known{"KHR_materials_iridescence", Role::gloss, ""},
    Known{"KHR_materials_pbrSpecularGlossiness", Role::gloss, ""},
    Known{"KHR_materials_sheen", Role::gloss, ""},
    Known{"KHR_materials_specular", Role::gloss, ""},
    Known{"KHR_materials_diffuse_transmission", Role::transmit, ""},
    Known{"KHR_materials_dispersion", Role::transmit, ""},
    Known{"KHR_materials_transmission", Role::transmit, ""},
    Known{"KHR_materials_volume", Role::transmit, ""},

    // The variants are a choice of the user; without one the file's own materials count, and they are read.
    Known{"KHR_materials_variants", Role::harmless, "it offers other materials; those of the meshes are used"},
    Known{"AGI_articulations", Role::harmless, motion},
    Known{"AGI_stk_metadata", Role::harmless, metadata},
    Known{"CESIUM_primitive_outline", Role::harmless, about_lines},
    Known{"EXT_feature_metadata", Role::harmless, metadata},
    Known{"EXT_instance_features", Role::harmless, metadata},
    Known{"EXT_mesh_features", Role::harmless, metadata},
    Known{"EXT_mesh_manifold", Role::harmless, "it repeats the triangles as a closed mesh"},
    Known{"EXT_mesh_primitive_edge_visibility", Role::harmless, about_lines},
    Known{"EXT_structural_metadata", Role::harmless, metadata},
    Known{"FB_geometry_metadata", Role::harmless, metadata},
    Known{"FB_ngon_encoding", Role::harmless, "it states which triangles form a polygon"},
    Known{"GODOT_single_root", Role::harmless, "it states that the file has one root node"},
    Known{"GRIFFEL_bim_data", Role::harmless, metadata},
    Known{"KHR_animation_pointer", Role::harmless, motion},
    Known{"KHR_audio_emitter", Role::harmless, about_sound},
    Known{"KHR_implicit_shapes", Role::harmless, physics},
    Known{"KHR_interactivity", Role::harmless, interaction},
    Known{"KHR_node_hoverability", Role::harmless, interaction},
    Known{"KHR_node_selectability", Role::harmless, interaction},
    Known{"KHR_physics_rigid_bodies", Role::harmless, physics},
    Known{"KHR_xmp", Role::harmless, metadata},
    Known{"KHR_xmp_json_ld", Role::harmless, metadata},
    Known{"MSFT_packing_normalRoughnessMetallic", Role::harmless, gloss_textures},
    Known{"MSFT_packing_occlusionRoughnessMetallic", Role::harmless, gloss_textures},
    Known{"MSFT_physics_rigid_bodies", Role::harmless, physics},
    Known{"OMI_audio_emitter", Role::harmless, about_sound},
    Known{"OMI_collider", Role::harmless, physics},
    Known{"OMI_physics_body", Role::harmless, physics},
    Known{"OMI_physics_gravity", Role::harmless, physics},
    Known{"OMI_physics_joint", Role::harmless, physics},
    Known{"OMI_physics_shape", Role::harmless, physics},
    Known{"OMI_seat", Role::harmless, interaction},
    Known{"OMI_spawn_point", Role::harmless, interaction},
};

const Known* find_known(const std::string& name) {
  const auto found =
      std::find_if(known_extensions.begin(), known_extensions.end(), [&](const Known& k) { return k.name == name; });
  return found == known_extensions.end() ? nullptr : &*found;
}

// Singular of the arrays of a glTF file, for messages.
std::string kind_of(const std::string& list) {
  if (list == "meshes") return "mesh";
  return list.empty() ? list : list.substr(0, list.size() - 1);
}

// Visits every object of a file that has extensions.
class Finder {
 public:
  void look_at_file(const Json& json) {
    if (!json.is_object()) return;
    look_at(json, "the file");
    for (const auto& [list, objects] : json.items()) {
      if (list == "extras" || !objects.is_array()) continue;
      std::size_t index = 0;
      for (const Json& object : objects) {
        const bool named = object.is_object() && object.contains("name") && object["name"].is_string();
        look_below(object, label(kind_of(list).c_str(), named ? object["name"].get<std::string>() : "", index++));
      }
    }
  }

  std::map<std::string, ExtensionUse> found;

 private:
  void look_at(const Json& object, const std::string& place) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return;
    for (const auto& [name, value] : extensions->items()) {
      ExtensionUse& use = found[name];
      if (use.places++ == 0) use.first_place = place;
      look_below(value, place);  // extensions of extensions
    }
  }

  // The nesting has been limited (nests_too_deep()). Extras may contain anything and are not looked at.
  void look_below(const Json& value, const std::string& place) {
    if (value.is_object()) {
      look_at(value, place);
      for (const auto& [name, member] : value.items()) {
        if (name != "extras" && name != "extensions") look_below(member, place);
      }
    } else if (value.is_array()) {
      for (const Json& element : value) {
        if (element.is_structured()) look_below(element, place);
      }
    }
  }
};

// The texts in an array of the file.
std::set<std::string> names_in(const Json& json, const char* list) {
  std::set<std::string> names;
  if (!json.is_object() || !json.contains(list) || !json[list].is_array()) return names;
  for (const auto& name : json[list]) {
    if (name.is_string()) names.insert(name.get<std::string>());
  }
  return names;
}

std::string where_used(const ExtensionUse& use) {
  if (use.places == 0) return " (listed in the file, without an object that has it)";
  if (use.places == 1) return " (of " + use.first_place + ")";
  return " (of " + use.first_place + " and " + to_text(use.places - 1, "more place") + ")";
}

}  // namespace

std::vector<ExtensionUse> extensions_in(const Json& json) {
  Finder finder;
  finder.look_at_file(json);
  for (const std::string& name : names_in(json, "extensionsUsed")) finder.found[name];
  for (const std::string& name : names_in(json, "extensionsRequired")) finder.found[name].required = true;
  std::vector<ExtensionUse> uses;
  for (auto& [name, use] : finder.found) {
    use.name = name;
    uses.push_back(std::move(use));
  }
  return uses;
}

void check_required_extensions(const Document& document) {
  for (const ExtensionUse& use : document.extensions) {
    if (!use.required) continue;
    const Known* const known = find_known(use.name);
    if (known != nullptr && known->role != Role::transmit) continue;
    refuse(document, "the file requires the extension " + in_quotes(use.name) + where_used(use) +
                         ", which lichtmc does not support (allowed: those in docs/rooms.md, section Extensions). "
                         "Export the file without this extension, or as one that the file does not require.");
  }
}

void note_extensions(const Document& document, std::vector<Ignored>& ignored) {
  for (const ExtensionUse& use : document.extensions) {
    const Known* const known = find_known(use.name);
    if (known == nullptr) {
      ignored.push_back(
          {"The extension " + use.name + where_used(use) + " is not known: what it means is not modelled.",
           Effect::figures});
    } else if (known->role == Role::harmless) {
      ignored.push_back(
          {"The extension " + use.name + " is not read: " + std::string(known->reason) + ".", Effect::none});
    }
  }
}

}  // namespace lichtmc
