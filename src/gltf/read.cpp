#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "base/message.hpp"
#include "gltf/document.hpp"
#include "gltf/geometry.hpp"
#include "gltf/lights.hpp"
#include "gltf/load_document.hpp"
#include "gltf/materials.hpp"
#include "gltf/nodes.hpp"
#include "lichtmc/gltf.hpp"

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

class RoomReader {
 public:
  RoomReader(const Document& document, const ReadOptions& options)
      : document_(&document),
        options_(&options),
        reflectance_maps_(document),
        used_materials_(document.model.materials.size(), false) {
    room_.source = document.file;
  }

  Room read() {
    for (const PlacedNode& placed : place_nodes(*document_, options_->scene, root_transform(*document_, *options_))) {
      read_mesh(placed);
      if (auto light = read_light(*document_, placed, room_.ignored)) add_emitter(std::move(*light));
      if (auto receiver = read_receiver(*document_, placed)) room_.receivers.push_back(std::move(*receiver));
      note_node(placed);
    }
    room_.reflectance_maps = reflectance_maps_.take();
    for (Surface& surface : room_.surfaces) surface.reflectance = mean_reflectance(room_, surface);
    note_ignored_materials(*document_, used_materials_, room_.ignored);
    note_file();
    note_overrides();
    set_quantity();
    return std::move(room_);
  }

 private:
  void read_mesh(const PlacedNode& placed) {
    const auto& model = document_->model;
    const auto& node = model.nodes[placed.index];
    if (node.mesh < 0) return;
    const std::size_t index = checked_index(*document_, node.mesh, model.meshes.size(), "the mesh of " + placed.label);
    const auto& mesh = model.meshes[index];
    const std::vector<glm::dmat4> transforms = mesh_transforms(*document_, placed);
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
      const auto& primitive = mesh.primitives[k];
      std::string where = label("mesh", mesh.name, index);
      if (mesh.primitives.size() > 1) where += ", primitive " + std::to_string(k);
      where += " (" + placed.label + ")";
      const Material material = read_material(*document_, primitive.material, by_number(primitive.material));
      if (primitive.material >= 0) used_materials_[static_cast<std::size_t>(primitive.material)] = true;
      const auto stored = read_primitive(*document_, primitive, material, options_->uv_set, where, room_.ignored);
      if (!stored) continue;
      std::string name = !node.name.empty()   ? node.name
                         : !mesh.name.empty() ? mesh.name
                                              : "mesh_" + std::to_string(index);
      if (mesh.primitives.size() > 1) name += "." + (primitive.material >= 0 ? material.name : std::to_string(k));
      for (const glm::dmat4& world : transforms) add_surface(place_primitive(*stored, world), name, material, where);
    }
  }

  // Whether the reflectance of a material will be set as a number.
  bool by_number(int material) const {
    const auto& names = options_->numbered_materials;
    return std::find(names.begin(), names.end(), material_name(*document_, material)) != names.end();
  }

  void add_surface(Surface surface, const std::string& name, const Material& material, const std::string& where) {
    if (surface.triangles.empty()) {
      note(
          "None of the " + to_text(surface.without_area, "triangle") + " of " + where + " has an area: it is left out.",
          Effect::none);
      return;
    }
    triangles_ += surface.triangles.size();
    if (triangles_ > max_triangles) {
      refuse(*document_, "the room has more than " + std::to_string(max_triangles) +
                             " triangles (the limit), including instances. Split it, or simplify its meshes.");
    }
    surface.name = unique(name);
    surface.material = material.name;
    surface.reflectance = material.reflectance;
    surface.reflectance_source = material.source;
    surface.sides = material.sides;
    if (material.base_colour && !surface.reflectance_uvs.empty()) {
      surface.reflectance_map = reflectance_maps_.find_or_make(material.base_colour->texture, material.factor,
                                                               "material " + in_quotes(material.name));
      surface.reflectance_source = ReflectanceSource::texture;
    }
    room_.surfaces.push_back(std::move(surface));
    if (!material.emission) return;
    add_area_light(*material.emission);
    if (material.sides == Sides::both) {
      note("Surface " + in_quotes(room_.surfaces.back().name) +
               " is two-sided and emissive: it emits from its front only. If that is the wrong side, flip its faces.",
           Effect::figures);
    }
  }

  // Makes the surface added last an emitter.
  void add_area_light(const Emission& emission) {
    const Surface& surface = room_.surfaces.back();
    FileEmitter emitter;
    emitter.emitter.name = surface.name;
    emitter.emitter.power = emission.power.value_or(std::numbers::pi * emission.luminance * surface_area(surface));
    emitter.emitter.shape = SurfaceEmitter{room_.surfaces.size() - 1, emission.exponent};
    emitter.quantity = emission.quantity;
    add_emitter(std::move(emitter));
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

  std::string unique(const std::string& name) {
    std::string candidate = name;
    // Starts at the last number used: the cost stays low for many nodes of one name.
    for (int& n = last_number_[name]; !names_.insert(candidate).second;)
      candidate = name + "_" + std::to_string(n == 0 ? n = 2 : ++n);
    return candidate;
  }

  void note(std::string what, Effect effect) { room_.ignored.push_back({std::move(what), effect}); }

  void note_node(const PlacedNode& placed) {
    const auto& node = document_->model.nodes[placed.index];
    if (node.camera >= 0) note("The camera of " + placed.label + " is not used.", Effect::none);
    for (const auto& [name, value] : node.extensions) {
      if (name == "KHR_lights_punctual" || name == "EXT_mesh_gpu_instancing") continue;
      note("The extension " + name + " of " + placed.label + " is not applied.", Effect::none);
    }
  }

  void note_file() {
    const auto& model = document_->model;
    if (model.scenes.size() > 1) {
      note("The file has " + std::to_string(model.scenes.size()) + " scenes; one is read (--scene NAME selects it).",
           Effect::none);
    }
    if (!model.animations.empty())
      note("Not applied: " + to_text(model.animations.size(), "animation") + ".", Effect::none);
    for (const std::string& name : model.extensionsUsed) {
      if (!is_known_extension(name)) note("The file uses the extension " + name + ", which is not read.", Effect::none);
    }
    for (const std::string& warning : document_->warnings) note("Message of the parser: " + warning, Effect::none);
  }

  void note_overrides() {
    if (options_->scale != 1.0) room_.overrides.push_back("Lengths multiplied by " + to_text(options_->scale) + ".");
    if (options_->up == UpAxis::z) room_.overrides.push_back("Rotated from Z-up to Y-up.");
  }

  const Document* document_;
  const ReadOptions* options_;
  Room room_;
  ReflectanceMaps reflectance_maps_;
  std::size_t triangles_ = 0;
  std::vector<Quantity> quantities_;  // of the emitters
  std::vector<bool> used_materials_;
  std::set<std::string> names_;
  std::map<std::string, int> last_number_;  // appended to make a name unique, by name
};

}  // namespace

Room read_gltf(const std::filesystem::path& file, const ReadOptions& options) {
  const Document document = load_document(file);
  return RoomReader(document, options).read();
}

}  // namespace lichtmc
