// Surfaces that a user names: by their material or their own name.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/room.hpp"

namespace lichtmc {

// "NAME" chooses the surfaces with this material or this name; "material:NAME" and "surface:NAME" only one of them.
// NAME may be a pattern (base/names.hpp).
struct SurfaceChoice {
  explicit SurfaceChoice(std::string_view text);

  bool by_material(std::string_view material) const;
  bool by_name(std::string_view surface) const;

  std::string name;  // without the prefix
  bool materials = true;
  bool surfaces = true;
};

// Throws InputError: a room has no surface of this choice; with similar names.
[[noreturn]] void refuse_unknown(const Room& room, const SurfaceChoice& choice);

// The numbers of the surfaces that a text chooses. Throws InputError if there are none.
std::vector<std::size_t> chosen_surfaces(const Room& room, const std::string& name);

}  // namespace lichtmc
