#include <algorithm>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "base/message.hpp"
#include "gltf/document.hpp"
#include "gltf/geometry.hpp"
#include "gltf/lights.hpp"
#include "gltf/materials.hpp"
#include "gltf/nodes.hpp"
#include "lichtmc/gltf.hpp"

namespace lichtmc {

namespace {

class RoomReader {
 public:
  RoomReader(const Document& document, const ReadOptions& options)
      : document_(&document), options_(&options), used_materials_(document.model.materials.size(), false) {
    room_.source = document.file;
  }

  Room read() {
    for (const PlacedNode& placed : place_nodes(*document_, options_->scene)) {
      read_mesh(placed);
      if (auto light = read_light(*document_, placed, room_.ignored)) add_emitter(std::move(*light));
      if (auto receiver = read_receiver(*document_, placed)) room_.receivers.push_back(std::move(*receiver));
      note_node(placed);
    }
    note_ignored_materials(*document_, used_materials_, room_.ignored);
    note_file();
    choose_quantity();
    return std::move(room_);
  }

 private:
  void read_mesh(const PlacedNode& placed) {
    const auto& model = document_->model;
    const auto& node = model.nodes[placed.index];
    if (node.mesh < 0) return;
    const std::size_t index = checked_index(*document_, node.mesh, model.meshes.size(), "the mesh of " + placed.label);
    const auto& mesh = model.meshes[index];
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
      const auto& primitive = mesh.primitives[k];
      std::string where = label("mesh", mesh.name, index);
      if (mesh.primitives.size() > 1) where += ", primitive " + std::to_string(k);
      where += " (" + placed.label + ")";
      if (primitive.extensions.count("KHR_draco_mesh_compression") != 0) {
        room_.ignored.push_back("The compressed form of " + where + " is not read; its uncompressed form is.");
      }
      auto surface = read_primitive(*document_, primitive, placed.world, options_->uv_set, where, room_.ignored);
      if (!surface) continue;
      const Material material = read_material(*document_, primitive.material);
      if (primitive.material >= 0) used_materials_[static_cast<std::size_t>(primitive.material)] = true;
      std::string name = !node.name.empty()   ? node.name
                         : !mesh.name.empty() ? mesh.name
                                              : "mesh_" + std::to_string(index);
      if (mesh.primitives.size() > 1) name += "." + (primitive.material >= 0 ? material.name : std::to_string(k));
      surface->name = unique(name);
      surface->material = material.name;
      surface->reflectance = material.reflectance;
      surface->sides = material.sides;
      room_.surfaces.push_back(std::move(*surface));
      if (!material.emission) continue;
      add_shining(*material.emission);
      if (material.sides == Sides::both) {
        room_.ignored.push_back("Surface " + in_quotes(room_.surfaces.back().name) +
                                " is two-sided and shines: it shines on its front only.");
      }
    }
  }

  // The surface just read shines.
  void add_shining(const Emission& emission) {
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

  void choose_quantity() {
    const auto other = std::adjacent_find(quantities_.begin(), quantities_.end(), std::not_equal_to<>());
    if (other != quantities_.end()) {
      const auto k = static_cast<std::size_t>(other - quantities_.begin());
      const auto named = [&](std::size_t n) {
        return in_quotes(room_.emitters[n].name) + " is in " + std::string(power_unit(quantities_[n]));
      };
      refuse(*document_, "powers are mixed: emitter " + named(k) + ", emitter " + named(k + 1) +
                             " (allowed: one unit for all; lights and emissive materials are in lm unless their custom "
                             "property 'unit' says \"W\"). "
                             "Set 'power' and 'unit' alike.");
    }
    if (!quantities_.empty()) room_.quantity = quantities_.front();
    if (options_->quantity) room_.quantity = *options_->quantity;
  }

  std::string unique(const std::string& name) {
    std::string candidate = name;
    // From the last number used on: a file may have as many nodes of one name as it likes.
    for (int& n = last_number_[name]; !names_.insert(candidate).second;)
      candidate = name + "_" + std::to_string(n == 0 ? n = 2 : ++n);
    return candidate;
  }

  void note_node(const PlacedNode& placed) {
    const auto& node = document_->model.nodes[placed.index];
    if (node.camera >= 0) room_.ignored.push_back("The camera of " + placed.label + " is not used.");
    for (const auto& [name, value] : node.extensions) {
      if (name == "KHR_lights_punctual") continue;
      room_.ignored.push_back("The extension " + name + " of " + placed.label + " is not applied.");
    }
  }

  void note_file() {
    const auto& model = document_->model;
    if (model.scenes.size() > 1)
      room_.ignored.push_back("The file has " + std::to_string(model.scenes.size()) +
                              " scenes; one is read (--scene NAME chooses).");
    if (!model.animations.empty())
      room_.ignored.push_back(to_text(model.animations.size(), "animation") + ": the room is taken as it stands.");
    for (const std::string& name : model.extensionsUsed) {
      const bool read =
          name == "KHR_lights_punctual" || name == "KHR_materials_emissive_strength" || name == "KHR_materials_unlit";
      if (!read) room_.ignored.push_back("The file uses the extension " + name + ", which is not read.");
    }
    for (const std::string& warning : document_->warnings) room_.ignored.push_back("While reading: " + warning);
  }

  const Document* document_;
  const ReadOptions* options_;
  Room room_;
  std::vector<Quantity> quantities_;  // of the emitters
  std::vector<bool> used_materials_;
  std::set<std::string> names_;
  std::map<std::string, int> last_number_;  // given to names that were taken
};

}  // namespace

Room read_gltf(const std::filesystem::path& file, const ReadOptions& options) {
  const Document document = load_document(file);
  return RoomReader(document, options).read();
}

}  // namespace lichtmc
