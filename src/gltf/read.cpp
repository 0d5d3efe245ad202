#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>

#include "base/luminance.hpp"
#include "base/message.hpp"
#include "gltf/areas.hpp"
#include "gltf/deform.hpp"
#include "gltf/document.hpp"
#include "gltf/extensions.hpp"
#include "gltf/geometry.hpp"
#include "gltf/left_out.hpp"
#include "gltf/lights.hpp"
#include "gltf/load_document.hpp"
#include "gltf/luminaires.hpp"
#include "gltf/materials.hpp"
#include "gltf/node_names.hpp"
#include "gltf/nodes.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "room/emission.hpp"
#include "room/emitter_shape.hpp"
#include "room/surface_choice.hpp"
#include "room/surface_pieces.hpp"

namespace lichtmc {

namespace {

// Limit for untrusted input: with tiles, a triangle takes some hundreds of bytes, this number more than the memory of
// any machine.
constexpr std::size_t max_triangles = 200'000'000;

// The parent transform of all root nodes: converts the file's unit of length to metres, and a Z-up file to Y-up.
glm::dmat4 root_transform(const Document& document, const ReadOptions& options) {
  if (!(options.scale > 0.0) || !std::isfinite(options.scale)) {
    refuse(document, "the scale is " + to_text(options.scale) +
                         " (allowed: a finite number above 0). Give --scale the length of the file's unit in metres, "
                         "for example 0.01 for centimetres.");
  }
  glm::dmat4 transform(1.0);
  if (options.up == UpAxis::z) {
    transform[1] = {0.0, 0.0, -1.0, 0.0};
    transform[2] = {0.0, 1.0, 0.0, 0.0};
  }
  for (int k = 0; k < 3; ++k) transform[k] *= options.scale;
  return transform;
}

double largest_scale(const glm::dmat4& transform) {
  return std::max({glm::length(transform[0]), glm::length(transform[1]), glm::length(transform[2])});
}

// Numbers equal names: "top", "top_2".
class UniqueNames {
 public:
  std::string unique(const std::string& name) {
    std::string candidate = name;
    // Starts at the last number used: the cost stays low for many nodes of one name.
    for (int& n = last_number_[name]; !names_.insert(candidate).second;)
      candidate = name + "_" + std::to_string(n == 0 ? n = 2 : ++n);
    return candidate;
  }

 private:
  std::set<std::string> names_;
  std::map<std::string, int> last_number_;  // appended, by name
};

class RoomReader {
 public:
  RoomReader(const Document& document, const ReadOptions& options)
      : document_(&document),
        options_(&options),
        nodes_(place_nodes(document, options.scene, root_transform(document, options))),
        names_of_scene_(name_scene(document, nodes_)),
        skins_(document, nodes_),
        left_out_(document, nodes_, options.without),
        luminaires_(document),
        reflectance_maps_(document, reflectance_role),
        emission_maps_(document, emission_role),
        material_uses_(document.model.materials.size()) {
    room_.source = document.file;
    for (const std::string& text : options.numbered) numbered_.emplace_back(text);
  }

  Room read() {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!nodes_[k].hidden && !left_out_.node(k)) read_node(k);
    }
    left_out_.check_patterns(nodes_, room_.overrides);
    room_.reflectance_maps = reflectance_maps_.take();
    room_.emission_maps = emission_maps_.take();
    drop_uniform_maps();
    for (Surface& surface : room_.surfaces) surface.reflectance = mean_reflectance(room_, surface);
    note_ignored_materials(*document_, material_uses_, room_.ignored);
    note_extensions(*document_, room_.ignored);
    room_.ignored.insert(room_.ignored.end(), document_->property_notes.begin(), document_->property_notes.end());
    note_rounded();
    note_file();
    note_overrides();
    set_quantity();
    return std::move(room_);
  }

 private:
  void read_node(std::size_t k) {
    const PlacedNode& placed = nodes_[k];
    const std::size_t first_emitter = room_.emitters.size();
    if (is_calculation_area(document_->model.nodes[placed.index])) {
      read_area_of_node(k);
    } else {
      read_mesh(k);
    }
    auto light = luminaires_.read(placed, room_.ignored);
    if (!light) light = read_light(*document_, placed, room_.ignored);
    if (light) {
      light->emitter.name = names_of_scene_.nodes[k];
      add_emitter(std::move(*light));
    }
    set_delay_of_node(*document_, placed, first_emitter, room_);
    set_maintenance_of_node(*document_, placed, first_emitter, room_);
    if (auto receiver = read_receiver(*document_, placed)) {
      receiver->name = names_of_scene_.nodes[k];
      room_.receivers.push_back(std::move(*receiver));
    }
    const auto& node = document_->model.nodes[placed.index];
    if (node.camera >= 0) note("The camera of " + placed.label + " is not used.", Effect::none);
  }

  void read_mesh(std::size_t number) {
    const PlacedNode& placed = nodes_[number];
    const auto& model = document_->model;
    const auto& node = model.nodes[placed.index];
    if (node.mesh < 0) return;
    const std::size_t index = checked_index(*document_, node.mesh, model.meshes.size(), "the mesh of " + placed.label);
    const auto& mesh = model.meshes[index];
    const std::vector<glm::dmat4> transforms = mesh_transforms(*document_, placed);
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
      const auto& primitive = mesh.primitives[k];
      const std::string name_of_material = material_name(*document_, primitive.material);
      if (left_out_.mesh(mesh.name) || left_out_.material(name_of_material)) {
        left_out_.count_surfaces(transforms.size());
        continue;
      }
      std::string where = label("mesh", mesh.name, index);
      if (mesh.primitives.size() > 1) where += ", primitive " + std::to_string(k);
      where += " (" + placed.label + ")";
      const bool by_number = numbered_material(name_of_material);
      const Material material = read_material(*document_, primitive.material, by_number);
      if (primitive.material >= 0) material_uses_[static_cast<std::size_t>(primitive.material)] = {true, by_number};
      const auto stored = read_primitive(*document_, primitive, material, options_->uv_set, morph_weights(node, mesh),
                                         where, room_.ignored);
      if (!stored) continue;
      const std::string& name = names_of_scene_.primitives[number][k];
      note_rounding(largest_scale(placed.world) * coarse_rounding(*document_, primitive, *stored), in_quotes(name));
      if (const auto of_vertices =
              skins_.vertex_transforms(node, primitive, stored->positions.size(), where, room_.ignored)) {
        add_surface(place_primitive(*stored, *of_vertices), name, material, *stored);
        if (node.extensions.count("EXT_mesh_gpu_instancing") != 0)
          note("The instances of " + placed.label + " are not applied: its mesh has a skin.", Effect::figures);
        continue;
      }
      for (const glm::dmat4& world : transforms) add_surface(place_primitive(*stored, world), name, material, *stored);
    }
  }

  // The mesh of a calculation area is no part of the room.
  void read_area_of_node(std::size_t number) {
    const PlacedNode& placed = nodes_[number];
    const auto& meshes = document_->model.meshes;
    const auto mesh = static_cast<std::size_t>(document_->model.nodes[placed.index].mesh);  // checked by read_area()
    if (mesh < meshes.size() && left_out_.mesh(meshes[mesh].name)) {
      left_out_.count_surfaces(1);
      return;
    }
    AreaRequest request = read_area(*document_, placed, root_transform(*document_, *options_), room_.ignored);
    count_triangles(request.triangles.size());
    request.properties.name = area_names_.unique(names_of_scene_.nodes[number]);
    room_.area_requests.push_back(std::move(request));
  }

  // Whether the reflectance of a material, or of a surface, will be set as a number.
  bool numbered_material(const std::string& material) const {
    return std::any_of(numbered_.begin(), numbered_.end(),
                       [&](const SurfaceChoice& choice) { return choice.by_material(material); });
  }
  bool numbered_surface(const std::string& name) const {
    return std::any_of(numbered_.begin(), numbered_.end(),
                       [&](const SurfaceChoice& choice) { return choice.by_name(name); });
  }

  void count_triangles(std::size_t more) {
    triangles_ += more;
    if (triangles_ > max_triangles) {
      refuse(*document_, "the room has more than " + std::to_string(max_triangles) +
                             " triangles (the limit), including instances. Split it, or simplify its meshes.");
    }
  }

  // stored: the primitive that the surface is made of.
  void add_surface(Surface surface, const std::string& name, const Material& material, const Primitive& stored) {
    if (surface.triangles.empty()) {
      note("None of the " + to_text(surface.without_area, "triangle") + " of " + stored.where +
               " has an area: it is left out.",
           Effect::none);
      return;
    }
    surface.name = names_.unique(name);
    if (left_out_.surface(surface.name)) {
      left_out_.count_surfaces(1);
      return;
    }
    count_triangles(surface.triangles.size());
    surface.material = material.name;
    surface.reflectance = material.reflectance;
    surface.reflectance_source = material.source;
    surface.sides = material.sides;
    if (numbered_surface(surface.name)) {
      surface.reflectance_uvs.clear();
    } else {
      set_varying_reflectance(surface, material, stored.vertex_colours);
    }
    room_.surfaces.push_back(std::move(surface));
    if (!material.emission || !add_area_light(*material.emission, material.name, stored)) return;
    if (material.sides == Sides::both) {
      note("Surface " + in_quotes(room_.surfaces.back().name) +
               " is two-sided and emissive: it emits from its front only. If that is the wrong side, flip its faces.",
           Effect::figures);
    }
  }

  // Vertex colours of one value are part of the factor: they cost nothing.
  void set_varying_reflectance(Surface& surface, const Material& material, const std::vector<glm::dvec3>& colours) {
    glm::dvec3 factor = material.factor;
    const bool vary = std::adjacent_find(colours.begin(), colours.end(), std::not_equal_to<>()) != colours.end();
    if (!vary && !colours.empty()) factor *= colours.front();
    if (material.base_colour && !surface.reflectance_uvs.empty()) {
      surface.reflectance_map = reflectance_maps_.find_or_make(material.base_colour->texture, factor, vary,
                                                               "material " + in_quotes(material.name));
      surface.reflectance_source = ReflectanceSource::texture;
    } else if (!colours.empty()) {
      surface.reflectance = luminance(factor.r, factor.g, factor.b);
    }
    if (colours.empty()) return;
    surface.reflectance_source = ReflectanceSource::vertex_colours;
    if (!vary) return;
    surface.vertex_colours = colours;
    if (surface.reflectance_map) return;
    for (glm::dvec3& colour : surface.vertex_colours) colour *= factor;
  }

  // Makes the surface added last an emitter, unless its emissive texture is black there. Returns whether it emits.
  bool add_area_light(const Emission& emission, const std::string& material, const Primitive& stored) {
    const Surface& surface = room_.surfaces.back();
    SurfaceEmitter shape{room_.surfaces.size() - 1, emission.exponent};
    double luminance_cd_m2 = emission.luminance;
    const bool textured = emission.texture && !stored.emission_uvs.empty();
    if (const auto number = textured ? emission_map_of(emission, material) : std::nullopt) {
      const EmissionMap& map = emission_maps_[*number];
      const double mean = mean_emission(surface, map, stored.emission_uvs, triangle_means_[*number]);
      if (!(mean > 0.0)) {
        note_black_emitter(emission);
        return false;
      }
      luminance_cd_m2 = emission.strength * mean;
      shape.emission_map = number;
      shape.emission_uvs = stored.emission_uvs;
    }
    FileEmitter emitter;
    emitter.emitter.name = surface.name;
    emitter.emitter.power = emission.power.value_or(std::numbers::pi * luminance_cd_m2 * surface_area(surface));
    emitter.emitter.shape = std::move(shape);
    emitter.emitter.delay_s = emission.delay_s;
    set_maintenance(emitter.emitter, emission.maintenance_factor);
    emitter.quantity = emission.quantity;
    if (emission.power) note_pieces(surface, *emission.power, emission.quantity);
    add_emitter(std::move(emitter));
    return true;
  }

  // The map of an emissive texture. If the power is given, a texture that cannot be read is no error: only the
  // distribution over the surface is unknown.
  std::optional<std::size_t> emission_map_of(const Emission& emission, const std::string& material) {
    const std::string where = "material " + in_quotes(material);
    try {
      return emission_maps_.find_or_make(emission.texture->texture, emission.factor, false, where);
    } catch (const InputError& error) {
      if (!emission.power) throw;
      const std::string what =
          "The emissive texture of " + where +
          " cannot be read: its surfaces emit the power given, uniformly over their area. Reason: " + error.what();
      // Once per material, not per surface.
      const bool known =
          std::any_of(room_.ignored.begin(), room_.ignored.end(), [&](const Ignored& one) { return one.what == what; });
      if (!known) note(what, Effect::figures);
      return std::nullopt;
    }
  }

  // Where a map has one value only, the emitter is uniform and costs nothing more.
  void drop_uniform_maps() {
    EmissionOfRoom emission(room_);
    const auto drop_if_uniform = [&](auto& shape) {
      if constexpr (SurfaceShape<std::decay_t<decltype(shape)>>) {
        if (!shape.emission_map || !emission.of(shape)->uniform()) return;
        shape.emission_map.reset();
        shape.emission_uvs.clear();
      }
    };
    for (Emitter& emitter : room_.emitters) std::visit(drop_if_uniform, emitter.shape);
    if (std::none_of(room_.emitters.begin(), room_.emitters.end(), has_emission_map)) room_.emission_maps.clear();
  }

  // Of the surface added last.
  void note_black_emitter(const Emission& emission) {
    if (!emission.power) return;
    note("Surface " + in_quotes(room_.surfaces.back().name) +
             " emits nothing, although its material has the custom property 'power': its emissive texture is black "
             "there.",
         Effect::figures);
  }

  // Several luminaires in one mesh (in Blender: an Array modifier, or joined objects) share one power.
  void note_pieces(const Surface& surface, double power, Quantity quantity) {
    const SurfacePieces pieces = pieces_of(surface);
    if (pieces.count < 2) return;
    const std::string unit(power_unit(quantity));
    const double together = static_cast<double>(pieces.count) * power;
    room_.ignored.push_back({"The area light " + in_quotes(surface.name) + " has " + std::to_string(pieces.count) +
                                 " separate pieces, which together have the power " + to_text(power) + " " + unit + ".",
                             Effect::none,
                             "Nothing to do if that is the power of all. If each piece has it, set 'power' to " +
                                 to_text(together) + ", or make each piece an object of its own."});
  }

  void add_emitter(FileEmitter emitter) {
    room_.emitters.push_back(std::move(emitter.emitter));
    quantities_.push_back(emitter.quantity);
  }

  // Photometric or radiometric: one quantity for the whole room.
  void set_quantity() {
    const auto other = std::adjacent_find(quantities_.begin(), quantities_.end(), std::not_equal_to<>());
    if (other != quantities_.end()) {
      const auto k = static_cast<std::size_t>(other - quantities_.begin());
      const auto named = [&](std::size_t n) {
        return in_quotes(room_.emitters[n].name) + " is in " + std::string(power_unit(quantities_[n]));
      };
      refuse(*document_, "the emitters have different units: emitter " + named(k) + ", emitter " + named(k + 1) +
                             " (allowed: one unit for all; lights and emissive materials are in lm unless their custom "
                             "property 'unit' is \"W\"). Set 'power' and 'unit' of all emitters in the same unit.");
    }
    if (!quantities_.empty()) room_.quantity = quantities_.front();
    if (options_->quantity) room_.quantity = *options_->quantity;
  }

  void note(std::string what, Effect effect) { room_.ignored.push_back({std::move(what), effect}); }

  void note_file() {
    const auto& model = document_->model;
    if (model.scenes.size() > 1) {
      note("The file has " + std::to_string(model.scenes.size()) + " scenes; one is read (--scene NAME selects it).",
           Effect::none);
    }
    if (!model.animations.empty())
      note("Not applied: " + to_text(model.animations.size(), "animation") + ".", Effect::none);
    note_hidden();
    for (const std::string& warning : document_->warnings) note("Message of the parser: " + warning, Effect::none);
  }

  void note_rounding(double spacing, const std::string& name) {
    if (!(spacing > 0.0)) return;
    rounded_.add(name);
    coarsest_ = std::max(coarsest_, spacing);
  }

  void note_rounded() {
    if (rounded_.count() == 0) return;
    note("The positions of " + rounded_.text() +
             " are floats so far from the origin of their nodes that they are rounded to multiples of up to " +
             short_number(coarsest_) +
             " m: their shapes are not what was modelled. Move the meshes to the origin and their place into the "
             "translation of a node, or export the room with an offset.",
         Effect::figures);
  }

  void note_hidden() {
    constexpr std::size_t shown = 5;
    std::size_t hidden = 0;
    std::string names;
    for (const PlacedNode& node : nodes_) {
      if (!node.hidden || (node.parent && nodes_[*node.parent].hidden)) continue;
      if (++hidden <= shown) names += (names.empty() ? "" : ", ") + node.label;
    }
    if (hidden == 0) return;
    if (hidden > shown) names += " and " + std::to_string(hidden - shown) + " more";
    note("Hidden in the file (KHR_node_visibility) and left out, with the nodes below: " + names + ".", Effect::none);
  }

  void note_overrides() {
    if (options_->scale != 1.0) room_.overrides.push_back("Lengths multiplied by " + to_text(options_->scale) + ".");
    if (options_->up == UpAxis::z) room_.overrides.push_back("Rotated from Z-up to Y-up.");
  }

  const Document* document_;
  const ReadOptions* options_;
  std::vector<PlacedNode> nodes_;
  SceneNames names_of_scene_;
  Skins skins_;
  LeftOut left_out_;
  Luminaires luminaires_;
  std::vector<SurfaceChoice> numbered_;
  Room room_;
  TextureMaps reflectance_maps_;
  TextureMaps emission_maps_;
  std::map<std::size_t, TriangleMeans> triangle_means_;  // by emission map
  std::size_t triangles_ = 0;
  Names rounded_;                     // meshes whose positions are too coarse
  double coarsest_ = 0.0;             // distance between floats there, in the file's unit
  std::vector<Quantity> quantities_;  // of the emitters
  std::vector<MaterialUse> material_uses_;
  UniqueNames names_;  // of surfaces
  UniqueNames area_names_;
};

}  // namespace

Room read_gltf(const std::filesystem::path& file, const ReadOptions& options) {
  const Document document = load_document(file, options.follow_links);
  return RoomReader(document, options).read();
}

Room parse_gltf(std::string_view bytes, const std::string& source, const ReadOptions& options) {
  const Document document = parse_document(bytes, source);
  return RoomReader(document, options).read();
}

}  // namespace lichtmc
