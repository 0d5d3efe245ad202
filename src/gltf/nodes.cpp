#include "gltf/nodes.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "base/message.hpp"
#include "gltf/accessor.hpp"

namespace lichtmc {

namespace {

std::vector<std::size_t> roots_without_scene(const Document& document) {
  const auto& nodes = document.model.nodes;
  std::vector<bool> child(nodes.size(), false);
  for (const auto& node : nodes) {
    for (const int index : node.children)
      child[checked_index(document, index, nodes.size(), "a child of " + label("node", node.name, 0))] = true;
  }
  std::vector<std::size_t> roots;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!child[k]) roots.push_back(k);
  }
  return roots;
}

const tinygltf::Scene& find_scene(const Document& document, const std::string& name) {
  const auto& model = document.model;
  if (name.empty()) {
    const int index = model.defaultScene < 0 ? 0 : model.defaultScene;
    return model.scenes[checked_index(document, index, model.scenes.size(), "the default scene")];
  }
  const auto found =
      std::find_if(model.scenes.begin(), model.scenes.end(), [&](const auto& scene) { return scene.name == name; });
  if (found != model.scenes.end()) return *found;
  std::string names;
  for (const auto& scene : model.scenes) names += (names.empty() ? "" : ", ") + in_quotes(scene.name);
  refuse(document, "there is no scene " + in_quotes(name) +
                       " (allowed: " + (names.empty() ? "none, the file has no scenes" : names) +
                       "). Give --scene one of these names, or leave it out.");
}

// Scales, then rotates, then translates.
glm::dmat4 transform_of(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale) {
  const glm::dmat3 rotated = glm::mat3_cast(rotation);
  return {glm::dvec4(rotated[0] * scale.x, 0.0), glm::dvec4(rotated[1] * scale.y, 0.0),
          glm::dvec4(rotated[2] * scale.z, 0.0), glm::dvec4(translation, 1.0)};
}

glm::dmat4 local_transform(const Document& document, const tinygltf::Node& node, const std::string& where) {
  if (node.matrix.size() == 16) {
    glm::dmat4 transform(1.0);
    for (std::size_t k = 0; k < 16; ++k)
      transform[static_cast<glm::length_t>(k / 4)][static_cast<glm::length_t>(k % 4)] = node.matrix[k];
    return transform;
  }
  const auto vector = [](const std::vector<double>& v, double otherwise) {
    return v.size() == 3 ? glm::dvec3(v[0], v[1], v[2]) : glm::dvec3(otherwise);
  };
  glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
  if (node.rotation.size() == 4) {
    rotation = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(rotation);
    if (!(length > 0.0))
      refuse(document, where + " has a rotation of length 0 (allowed: a unit quaternion). Set its rotation.");
    rotation = rotation / length;  // the length of a float quaternion is 1 to 10⁻⁷
  }
  return transform_of(vector(node.translation, 0.0), rotation, vector(node.scale, 1.0));
}

bool finite(const glm::dmat4& matrix) {
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4; ++j) {
      if (!std::isfinite(matrix[k][j])) return false;
    }
  }
  return true;
}

// Whether KHR_node_visibility hides a node and all nodes below it. Drafts of the extension had `hidden` in place of
// `visible`.
bool hides(const Document& document, const tinygltf::Node& node, const std::string& where) {
  const auto found = node.extensions.find("KHR_node_visibility");
  if (found == node.extensions.end()) return false;
  const auto flag = [&](const char* name, bool otherwise) {
    if (!found->second.IsObject() || !found->second.Has(name)) return otherwise;
    const tinygltf::Value& value = found->second.Get(name);
    if (value.IsBool()) return value.Get<bool>();
    refuse(document, "'" + std::string(name) + "' of the extension KHR_node_visibility of " + where +
                         " is not a truth value (allowed: true or false). Export the file again.");
  };
  return !flag("visible", true) || flag("hidden", false);
}

// The root nodes of the scene, in the order of the file.
std::vector<std::size_t> roots_of(const Document& document, const std::string& scene) {
  const auto& nodes = document.model.nodes;
  std::vector<std::size_t> roots;
  if (document.model.scenes.empty() && scene.empty()) {
    roots = roots_without_scene(document);
    if (roots.empty() && !nodes.empty())
      refuse(document, "every node has a parent: the nodes form a cycle (allowed: trees). Export the file again.");
    return roots;
  }
  for (const int root : find_scene(document, scene).nodes)
    roots.push_back(checked_index(document, root, nodes.size(), "a node of the scene"));
  return roots;
}

}  // namespace

std::vector<PlacedNode> place_nodes(const Document& document, const std::string& scene,
                                    const glm::dmat4& root_transform) {
  const auto& nodes = document.model.nodes;
  struct Pending {
    std::size_t node;
    glm::dmat4 transform;               // of its parent
    std::optional<std::size_t> parent;  // position in `placed`
  };
  std::vector<Pending> pending;  // a stack: depth first, without recursion
  const std::vector<std::size_t> roots = roots_of(document, scene);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root)
    pending.push_back({*root, root_transform, std::nullopt});

  std::vector<PlacedNode> placed;
  std::vector<bool> visited(nodes.size(), false);
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    const auto& node = nodes[next.node];
    const std::string where = label("node", node.name, next.node);
    if (visited[next.node]) {
      refuse(document, where + " has two parents or is its own ancestor (allowed: one parent). Export the file again.");
    }
    visited[next.node] = true;
    const glm::dmat4 world = next.transform * local_transform(document, node, where);
    if (!finite(world))
      refuse(document, "the transform of " + where + " is not finite. Set its position, rotation and scale.");
    const bool hidden = hides(document, node, where) || (next.parent && placed[*next.parent].hidden);
    const std::size_t number = placed.size();
    placed.push_back({next.node, where, world, next.parent, hidden});
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      pending.push_back({checked_index(document, *child, nodes.size(), "a child of " + where), world, number});
    }
  }
  return placed;
}

std::vector<glm::dmat4> mesh_transforms(const Document& document, const PlacedNode& placed) {
  const auto& extensions = document.model.nodes[placed.index].extensions;
  const auto found = extensions.find("EXT_mesh_gpu_instancing");
  if (found == extensions.end()) return {placed.world};
  const std::string where = "the instances of " + placed.label;
  const tinygltf::Value& extension = found->second;
  if (!extension.IsObject() || !extension.Has("attributes") || !extension.Get("attributes").IsObject())
    refuse(document, where + " have no attributes. Export the file again.");
  const tinygltf::Value& attributes = extension.Get("attributes");
  std::size_t count = 0;
  bool any = false;
  const auto values = [&](const char* name, const auto& read, auto otherwise) {
    std::vector<decltype(otherwise)> list;
    if (!attributes.Has(name)) return list;
    const auto accessor = static_cast<int>(number_in(document, attributes, name, -1.0, where));
    list = read(document, accessor, std::string(name) + " of " + where);
    if (any && list.size() != count)
      refuse(document, where + " do not have as many values of each kind (" + std::to_string(count) + " and " +
                           std::to_string(list.size()) + "; allowed: equal numbers). Export the file again.");
    any = true;
    count = list.size();
    return list;
  };
  const auto translations = values("TRANSLATION", read_vectors, glm::dvec3(0.0));
  const auto rotations = values("ROTATION", read_rotations, glm::dquat(1.0, 0.0, 0.0, 0.0));
  const auto scales = values("SCALE", read_vectors, glm::dvec3(1.0));
  std::vector<glm::dmat4> transforms;
  for (std::size_t k = 0; k < count; ++k) {
    transforms.push_back(placed.world * transform_of(translations.empty() ? glm::dvec3(0.0) : translations[k],
                                                     rotations.empty() ? glm::dquat(1.0, 0.0, 0.0, 0.0) : rotations[k],
                                                     scales.empty() ? glm::dvec3(1.0) : scales[k]));
    if (!finite(transforms.back()))
      refuse(document,
             where + ": the transform of number " + std::to_string(k) + " is not finite. Export the file again.");
  }
  return transforms;
}

}  // namespace lichtmc
