#include "gltf/left_out.hpp"

#include <algorithm>

#include "base/message.hpp"
#include "base/names.hpp"
#include "gltf/materials.hpp"

namespace lichtmc {

LeftOut::LeftOut(const Document& document, const std::vector<PlacedNode>& nodes,
                 const std::vector<std::string>& patterns)
    : document_(&document), patterns_(&patterns), used_(patterns.size(), false) {
  if (patterns.empty()) return;
  const auto& model = document.model;
  nodes_.resize(nodes.size(), false);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k].hidden) continue;
    const auto& node = model.nodes[nodes[k].index];
    const bool by_itself = !node.name.empty() && try_patterns(node.name);
    nodes_[k] = by_itself || (nodes[k].parent && nodes_[*nodes[k].parent]);
    if (node.mesh < 0 || static_cast<std::size_t>(node.mesh) >= model.meshes.size()) continue;
    const auto& mesh = model.meshes[static_cast<std::size_t>(node.mesh)];
    if (!mesh.name.empty() && try_patterns(mesh.name)) meshes_.push_back(mesh.name);
    for (const auto& primitive : mesh.primitives) {
      const std::string name = material_name(document, primitive.material);
      if (try_patterns(name)) materials_.push_back(name);
    }
    if (nodes_[k]) count_surfaces(mesh.primitives.size());
  }
  for (std::vector<std::string>* names : {&meshes_, &materials_}) {
    std::sort(names->begin(), names->end());
    names->erase(std::unique(names->begin(), names->end()), names->end());
  }
}

bool LeftOut::try_patterns(const std::string& name) {
  bool any = false;
  for (std::size_t k = 0; k < patterns_->size(); ++k) {
    if (!matches_pattern((*patterns_)[k], name)) continue;
    used_[k] = true;
    any = true;
  }
  return any;
}

bool LeftOut::fits(const std::vector<std::string>& names, const std::string& name) {
  return std::binary_search(names.begin(), names.end(), name);
}

bool LeftOut::surface(const std::string& name) {
  if (patterns_->empty()) return false;
  names_.push_back(name);
  return try_patterns(name);
}

void LeftOut::check_patterns(const std::vector<PlacedNode>& nodes, std::vector<std::string>& overrides) const {
  if (patterns_->empty()) return;
  const auto unused = std::find(used_.begin(), used_.end(), false);
  if (unused != used_.end()) {
    const std::string& pattern = (*patterns_)[static_cast<std::size_t>(unused - used_.begin())];
    std::vector<std::string> names = names_;
    for (const PlacedNode& node : nodes) {
      if (!node.hidden) names.push_back(document_->model.nodes[node.index].name);
    }
    for (const auto& material : document_->model.materials) names.push_back(material.name);
    for (const auto& mesh : document_->model.meshes) names.push_back(mesh.name);
    names.erase(std::remove(names.begin(), names.end(), ""), names.end());
    refuse(*document_, "nothing in it has the name " + in_quotes(pattern) +
                           " of --without (allowed, among others: " + nearest_names(pattern, std::move(names)) +
                           "). Give the name of a node, mesh, material or surface, or a pattern such as '" + pattern +
                           "*'.");
  }
  std::string list;
  for (const std::string& pattern : *patterns_) list += (list.empty() ? "" : ", ") + in_quotes(pattern);
  std::size_t points = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes_[k] && document_->model.nodes[nodes[k].index].mesh < 0) ++points;
  }
  overrides.push_back("Left out (--without " + list + "): " + to_text(surfaces_, "surface") +
                      (points == 0 ? "" : " and " + to_text(points, "node") + " without mesh") + ".");
}

}  // namespace lichtmc
