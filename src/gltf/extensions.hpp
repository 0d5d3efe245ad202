// Extensions of glTF: which are read, which cannot change the figures, and which may.
#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gltf/document.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// All extensions that the JSON of a file lists or uses anywhere, in alphabetical order.
std::vector<ExtensionUse> extensions_in(const nlohmann::json& json);

// Throws InputError if the file requires an extension without which its room could be another.
void check_required_extensions(const Document& document);

// Adds the extensions that are not read. Those of materials are added by note_ignored_materials() instead. Only an
// extension that is known to have no influence is declared so; every other may change the figures.
void note_extensions(const Document& document, std::vector<Ignored>& ignored);

}  // namespace lichtmc
