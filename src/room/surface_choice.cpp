#include "room/surface_choice.hpp"

#include "base/names.hpp"

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

}  // namespace lichtmc
