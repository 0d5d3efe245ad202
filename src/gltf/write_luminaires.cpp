#include "gltf/write_luminaires.hpp"

#include <filesystem>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "lichtmc/photometry.hpp"

namespace lichtmc {

namespace {

bool same_opening(const LuminousOpening& a, const LuminousOpening& b) {
  return a.form == b.form && a.size_m == b.size_m;
}

}  // namespace

std::size_t LuminaireWriter::light_of(const Photometry& file, const std::optional<LuminousOpening>& opening) {
  const bool own_opening = opening && !same_opening(*opening, file.opening);
  if (!own_opening) {
    if (const auto found = known_.find(&file); found != known_.end()) return found->second;
  }
  std::string text;
  if (own_opening) {
    Photometry changed = file;
    changed.opening = *opening;
    text = ies_text(changed);
  } else {
    text = ies_text(file);
  }
  GltfBuilder::Json& list = document_->json["extensions"]["EXT_lights_ies"]["lights"];
  const auto [entry, is_new] = lights_.try_emplace(text, list.size());
  if (is_new) {
    const std::size_t view = document_->add_view(text.data(), text.size());
    // Found again: a new list in the document may move the others.
    document_->json["extensions"]["EXT_lights_ies"]["lights"].push_back(
        {{"name", std::filesystem::path(file.source).filename().string()},
         {"bufferView", view},
         {"mimeType", "application/x-ies-lm-63"}});
    document_->use_extension("EXT_lights_ies");
  }
  if (!own_opening) known_[&file] = entry->second;
  return entry->second;
}

void LuminaireWriter::add(const Photometry& file, const LuminaireAxes& axes_of_light,
                          const std::optional<LuminousOpening>& opening, double power, Quantity quantity,
                          GltfBuilder::Json& node) {
  // The node looks along −Z, C0 lies towards +X, C90 towards +Y.
  glm::dmat3 axes(axes_of_light.c0, axes_of_light.c90, -axes_of_light.aim);
  if (glm::determinant(axes) < 0.0) {
    axes[1] = -axes[1];
    node["scale"] = {1.0, -1.0, 1.0};
  }
  const glm::dquat rotation = glm::normalize(glm::quat_cast(axes));
  node["rotation"] = {rotation.x, rotation.y, rotation.z, rotation.w};
  GltfBuilder::Json extension{{"light", light_of(file, opening)}};
  // For other programs: the custom property 'power' gives the same flux.
  const double multiplier = power / file.flux();
  if (quantity == Quantity::photometric && multiplier != 1.0) extension["multiplier"] = multiplier;
  node["extensions"]["EXT_lights_ies"] = std::move(extension);
  if (opening) node["extras"]["ies"] = {{"opening", "area"}};
}

}  // namespace lichtmc
