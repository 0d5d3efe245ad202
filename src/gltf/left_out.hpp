// What is left out of a room on request.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gltf/document.hpp"
#include "gltf/nodes.hpp"

namespace lichtmc {

// Patterns (base/names.hpp) of nodes, meshes, materials and surfaces.
class LeftOut {
 public:
  // A node that fits a pattern is left out with all nodes below it. Hidden nodes fit none.
  LeftOut(const Document& document, const std::vector<PlacedNode>& nodes, const std::vector<std::string>& patterns);

  bool node(std::size_t placed) const { return !nodes_.empty() && nodes_[placed]; }
  bool mesh(const std::string& name) const { return fits(meshes_, name); }
  bool material(const std::string& name) const { return fits(materials_, name); }
  // Whether a surface with this name fits a pattern.
  bool surface(const std::string& name);

  void count_surfaces(std::size_t count) { surfaces_ += count; }

  // Once all surfaces were asked for: adds what was left out to `overrides`. Throws InputError if a pattern fits
  // nothing, with names that are similar.
  void check_patterns(const std::vector<PlacedNode>& nodes, std::vector<std::string>& overrides) const;

 private:
  // Notes which patterns fit; returns whether one does.
  bool try_patterns(const std::string& name);
  static bool fits(const std::vector<std::string>& names, const std::string& name);

  const Document* document_;
  const std::vector<std::string>* patterns_;
  std::vector<bool> used_;              // patterns that fit something
  std::vector<bool> nodes_;             // left out; empty without patterns
  std::vector<std::string> meshes_;     // sorted names that fit
  std::vector<std::string> materials_;  // sorted names that fit
  std::vector<std::string> names_;      // of surfaces that were asked for
  std::size_t surfaces_ = 0;
};

}  // namespace lichtmc
