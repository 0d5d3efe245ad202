#include "room/surface_choice.hpp"

#include <algorithm>
#include <utility>

#include "base/message.hpp"
#include "base/names.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

SurfaceChoice::SurfaceChoice(std::string_view text) : name(text) {
  constexpr std::string_view material = "material:";
  constexpr std::string_view surface = "surface:";
  if (text.substr(0, material.size()) == material) {
    name = text.substr(material.size());
    surfaces = false;
  } else if (text.substr(0, surface.size()) == surface) {
    name = text.substr(surface.size());
    materials = false;
  }
}

bool SurfaceChoice::by_material(std::string_view material) const {
  return materials && matches_pattern(name, material);
}

bool SurfaceChoice::by_name(std::string_view surface) const {
  return surfaces && matches_pattern(name, surface);
}

namespace {

// "(allowed: …)" with the materials and surfaces that have similar names.
std::string similar_names(const Room& room, const SurfaceChoice& choice) {
  std::vector<std::string> materials;
  std::vector<std::string> surfaces;
  for (const Surface& surface : room.surfaces) {
    materials.push_back(surface.material);
    surfaces.push_back(surface.name);
  }
  std::string list;
  if (choice.materials) list += "materials: " + nearest_names(choice.name, std::move(materials));
  if (choice.surfaces)
    list += (list.empty() ? "" : "; ") + std::string("surfaces: ") + nearest_names(choice.name, std::move(surfaces));
  return "(allowed, among others: " + list + ")";
}

}  // namespace

void refuse_unknown(const Room& room, const SurfaceChoice& choice) {
  const std::string kind = !choice.surfaces ? "material " : !choice.materials ? "surface " : "material or surface ";
  throw InputError("There is no " + kind + in_quotes(choice.name) + " in " + room.source + " " +
                   similar_names(room, choice) + ". Give the name of a material or surface of the room.");
}

std::vector<std::size_t> chosen_surfaces(const Room& room, const std::string& name) {
  const SurfaceChoice choice(name);
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    if (choice.by_material(room.surfaces[k].material) || choice.by_name(room.surfaces[k].name)) chosen.push_back(k);
  }
  if (chosen.empty()) refuse_unknown(room, choice);
  return chosen;
}

}  // namespace lichtmc
