#include "gltf/deform.hpp"

#include <algorithm>
#include <cmath>

#include "base/message.hpp"
#include "gltf/accessor.hpp"

namespace lichtmc {

namespace {

// The displacements of a target; none if all are 0. An accessor without data and without sparse elements is 0
// everywhere.
std::vector<glm::dvec3> displacements(const Document& document, int index, std::size_t vertices,
                                      const std::string& where) {
  const auto& accessors = document.model.accessors;
  const auto& accessor = accessors[checked_index(document, index, accessors.size(), "the accessor of " + where)];
  if (accessor.bufferView < 0 && !accessor.sparse.isSparse) return {};
  std::vector<glm::dvec3> moves = read_vectors(document, index, where);
  if (moves.size() != vertices)
    refuse(document, where + " has " + std::to_string(moves.size()) + " displacements for " +
                         to_text(vertices, "position") + " (allowed: one per position). Export the file again.");
  return moves;
}

// Weights of each vertex are rounded to bytes at worst: with eight joints their sum differs from 1 by at most
// 8 · 0.5/255 = 0.016.
constexpr double most_rounding = 0.02;

}  // namespace

const std::vector<double>& morph_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh) {
  return node.weights.empty() ? mesh.weights : node.weights;
}

void apply_morph_targets(const Document& document, const tinygltf::Primitive& primitive,
                         const std::vector<double>& weights, const std::string& where,
                         std::vector<glm::dvec3>& positions, std::vector<Ignored>& ignored) {
  if (primitive.targets.empty() || weights.empty()) return;
  if (weights.size() != primitive.targets.size())
    refuse(document, where + " has " + to_text(primitive.targets.size(), "morph target") + " but " +
                         to_text(weights.size(), "weight") + " (allowed: one per target). Export the file again.");
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (!std::isfinite(weights[k]))
      refuse(document, "weight " + std::to_string(k) + " of the morph targets of " + where +
                           " is not finite (allowed: finite numbers). Export the file again.");
    if (weights[k] == 0.0) continue;
    const std::string which = "morph target " + std::to_string(k) + " of " + where;
    for (const auto& [name, index] : primitive.targets[k]) {
      if (name.rfind("TEXCOORD_", 0) == 0 || name.rfind("COLOR_", 0) == 0)
        ignored.push_back({"The displacements of " + name + " in " + which + " are not applied.", Effect::figures});
    }
    const auto position = primitive.targets[k].find("POSITION");
    if (position == primitive.targets[k].end()) continue;
    const std::vector<glm::dvec3> moves = displacements(document, position->second, positions.size(), which);
    for (std::size_t n = 0; n < moves.size(); ++n) positions[n] += weights[k] * moves[n];
  }
}

Skins::Skins(const Document& document, const std::vector<PlacedNode>& nodes)
    : document_(&document), worlds_(document.model.nodes.size()) {
  for (const PlacedNode& node : nodes) worlds_[node.index] = node.world;
}

std::vector<glm::dmat4> Skins::joint_transforms(std::size_t number) const {
  const auto& skin = document_->model.skins[number];
  const std::string of = label("skin", skin.name, number);
  std::vector<glm::dmat4> transforms;
  for (const int joint : skin.joints) {
    const std::size_t index = checked_index(*document_, joint, worlds_.size(), "a joint of " + of);
    if (!worlds_[index])
      refuse(*document_, label("node", document_->model.nodes[index].name, index) + ", a joint of " + of +
                             ", is not in the scene (allowed: nodes of the scene). Export the file again, or without "
                             "armatures.");
    transforms.push_back(*worlds_[index]);
  }
  if (skin.inverseBindMatrices < 0) return transforms;
  const std::vector<glm::dmat4> inverse =
      read_matrices(*document_, skin.inverseBindMatrices, "the inverse bind matrices of " + of);
  if (inverse.size() < transforms.size())
    refuse(*document_, of + " has " + to_text(transforms.size(), "joint") + " but " + std::to_string(inverse.size()) +
                           " inverse bind matrices (allowed: one per joint). Export the file again.");
  for (std::size_t k = 0; k < transforms.size(); ++k) transforms[k] = transforms[k] * inverse[k];
  return transforms;
}

std::optional<std::vector<glm::dmat4>> Skins::vertex_transforms(const tinygltf::Node& node,
                                                                const tinygltf::Primitive& primitive,
                                                                std::size_t vertices, const std::string& where,
                                                                std::vector<Ignored>& ignored) const {
  if (node.skin < 0) return std::nullopt;
  const std::size_t skin = checked_index(*document_, node.skin, document_->model.skins.size(), "the skin of " + where);
  const auto attribute = [&](const char* kind, int set) {
    const auto found = primitive.attributes.find(kind + std::to_string(set));
    return found == primitive.attributes.end() ? -1 : found->second;
  };
  if (attribute("JOINTS_", 0) < 0 || attribute("WEIGHTS_", 0) < 0) {
    ignored.push_back(
        {"The skin of " + where + " is not applied: the mesh has no joints and weights. It is placed by its node.",
         Effect::figures});
    return std::nullopt;
  }
  const std::vector<glm::dmat4> of_joint = joint_transforms(skin);
  std::vector<glm::dmat4> transforms(vertices, glm::dmat4(0.0));
  std::vector<double> sums(vertices, 0.0);
  for (int set = 0; attribute("JOINTS_", set) >= 0 && attribute("WEIGHTS_", set) >= 0; ++set) {
    const auto joints = read_joints(*document_, attribute("JOINTS_", set), of_joint.size(), "the joints of " + where);
    const auto weights = read_weights(*document_, attribute("WEIGHTS_", set), "the weights of " + where);
    if (joints.size() != vertices || weights.size() != vertices)
      refuse(*document_, where + " has " + to_text(vertices, "position") + ", joints for " +
                             std::to_string(joints.size()) + " and weights for " + std::to_string(weights.size()) +
                             " (allowed: as many). Export the file again.");
    for (std::size_t n = 0; n < vertices; ++n) {
      for (int k = 0; k < 4; ++k) {
        transforms[n] += weights[n][k] * of_joint[joints[n][k]];
        sums[n] += weights[n][k];
      }
    }
  }
  for (std::size_t n = 0; n < vertices; ++n) {
    if (!(std::abs(sums[n] - 1.0) <= most_rounding))
      refuse(*document_, "the weights of vertex " + std::to_string(n) + " of " + where + " add up to " +
                             to_text(sums[n]) + " (allowed: 1). Normalize the weights and export the file again.");
    transforms[n] /= sums[n];
  }
  return transforms;
}

}  // namespace lichtmc
