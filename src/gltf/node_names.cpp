#include "gltf/node_names.hpp"

#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "gltf/materials.hpp"

namespace lichtmc {

namespace {

// Longer names cannot be read; the limit bounds the work for deep trees.
constexpr int most_parents = 16;

class Namer {
 public:
  Namer(const Document& document, const std::vector<PlacedNode>& nodes, const std::vector<PlacedThing>& things)
      : document_(document), nodes_(nodes) {
    for (const PlacedNode& node : nodes) {  // parents before their children
      const bool named = node.parent && !document.model.nodes[nodes[*node.parent].index].name.empty();
      named_parents_.push_back(named || !node.parent ? node.parent : named_parents_[*node.parent]);
    }
    for (const PlacedThing& thing : things) {
      names_.push_back(thing.name);
      next_.push_back(named_parents_[thing.node]);
    }
  }

  std::vector<std::string> names() {
    std::unordered_map<std::string, std::vector<std::size_t>> groups;
    for (std::size_t k = 0; k < names_.size(); ++k) groups[names_[k]].push_back(k);
    for (const auto& [name, group] : groups) {
      if (group.size() > 1) tell_apart(group, "", 0);
    }
    return std::move(names_);
  }

 private:
  // Things whose names are equal with the parents in `prefix`, which become part of them only where they tell the group
  // from others. `unused`: names of parents that all of the group share and that have told it from no other yet.
  void tell_apart(const std::vector<std::size_t>& group, const std::string& unused, int level) {
    if (level == most_parents) return;
    bool one_parent = true;
    for (const std::size_t k : group) one_parent = one_parent && next_[k] == next_[group.front()];
    if (one_parent) return;
    std::map<std::string, std::vector<std::size_t>> parts;  // by the name of the next parent; "" for none
    for (const std::size_t k : group)
      parts[next_[k] ? document_.model.nodes[nodes_[*next_[k]].index].name : ""].push_back(k);
    const bool apart = parts.size() > 1;
    for (const auto& [parent, part] : parts) {
      const std::string path = parent.empty() ? unused : parent + "/" + unused;
      for (const std::size_t k : part) {
        if (apart) names_[k] = path + names_[k];
        if (next_[k]) next_[k] = named_parents_[*next_[k]];
      }
      if (part.size() > 1) tell_apart(part, apart ? "" : path, level + 1);
    }
  }

  const Document& document_;
  const std::vector<PlacedNode>& nodes_;
  std::vector<std::optional<std::size_t>> named_parents_;  // the nearest ancestor with a name, of each node
  std::vector<std::string> names_;
  std::vector<std::optional<std::size_t>> next_;  // the parent that comes next into the name
};

// Whether a node is an emitter (not by its mesh) or a receiver, or looks like one.
bool places_point(const Document& document, const PlacedNode& placed) {
  const tinygltf::Node& node = document.model.nodes[placed.index];
  const auto has = [&](const char* name) { return node.extras.IsObject() && node.extras.Has(name); };
  return node.extensions.count("KHR_lights_punctual") != 0 || has("lambert_exponent") || has("receiver");
}

// The names of the primitives of a node's mesh by themselves: that of the node or mesh, and with several primitives
// that of their material.
std::vector<std::string> primitive_names(const Document& document, const PlacedNode& placed) {
  const auto& model = document.model;
  const auto& node = model.nodes[placed.index];
  const std::size_t index = checked_index(document, node.mesh, model.meshes.size(), "the mesh of " + placed.label);
  const auto& mesh = model.meshes[index];
  std::vector<std::string> names;
  for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
    const int material = mesh.primitives[k].material;
    std::string& name = names.emplace_back(!node.name.empty()   ? node.name
                                           : !mesh.name.empty() ? mesh.name
                                                                : "mesh_" + std::to_string(index));
    if (mesh.primitives.size() > 1)
      name += "." + (material >= 0 ? material_name(document, material) : std::to_string(k));
  }
  return names;
}

}  // namespace

std::vector<std::string> names_by_parents(const Document& document, const std::vector<PlacedNode>& nodes,
                                          const std::vector<PlacedThing>& things) {
  return Namer(document, nodes, things).names();
}

SceneNames name_scene(const Document& document, const std::vector<PlacedNode>& nodes) {
  SceneNames names;
  names.primitives.resize(nodes.size());
  std::vector<PlacedThing> points;  // emitters and receivers: only they compete for names of their kind
  std::vector<PlacedThing> primitives;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto& node = document.model.nodes[nodes[k].index];
    names.nodes.push_back(node.name.empty() ? nodes[k].label : node.name);
    if (nodes[k].hidden) continue;
    if (places_point(document, nodes[k])) points.push_back({names.nodes.back(), k});
    if (node.mesh < 0) continue;
    for (std::string& name : primitive_names(document, nodes[k])) primitives.push_back({std::move(name), k});
  }
  const std::vector<std::string> of_points = names_by_parents(document, nodes, points);
  for (std::size_t k = 0; k < points.size(); ++k) names.nodes[points[k].node] = of_points[k];
  std::vector<std::string> of_primitives = names_by_parents(document, nodes, primitives);
  for (std::size_t k = 0; k < primitives.size(); ++k)
    names.primitives[primitives[k].node].push_back(std::move(of_primitives[k]));
  return names;
}

}  // namespace lichtmc
