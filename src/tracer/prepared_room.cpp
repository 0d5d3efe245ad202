#include "tracer/prepared_room.hpp"

#include <future>

#include "base/parallel.hpp"
#include "lichtmc/error.hpp"
#include "room/convexity.hpp"
#include "room/welded_mesh.hpp"
#include "tracer/embree_tree.hpp"

namespace lichtmc {

std::shared_ptr<PreparedRoom> prepare(const Room& room, unsigned threads,
                                      std::function<void(std::string_view)> progress) {
  return std::make_shared<PreparedRoom>(room, threads > 0 ? threads : usable_processors(), std::move(progress));
}

std::shared_ptr<PreparedRoom> prepared_or_new(std::shared_ptr<PreparedRoom> given, const Room& room, unsigned threads,
                                              std::function<void(std::string_view)> progress) {
  if (given == nullptr) return prepare(room, threads, std::move(progress));
  if (&given->room() != &room)
    throw InputError("The prepared room is not that of " + room.source +
                     " (allowed: the result of prepare() for the same Room object). Call prepare() with this room.");
  return given;
}

const std::shared_ptr<const FacesInOnePlane>& PreparedRoom::planes() {
  std::call_once(planes_once_, [this] {
    announce("Searching for faces in one plane");
    planes_ = std::make_shared<const FacesInOnePlane>(*room_, threads_);
  });
  return planes_;
}

void PreparedRoom::weld() {
  std::call_once(mesh_once_, [this] {
    announce("Joining the meshes");
    const WeldedMesh mesh(*room_, threads_);
    constexpr std::size_t places = 5;
    mesh_.duplicates = mesh.copies().size();
    for_each_edge(mesh.edges(), [&](std::size_t first, std::size_t end) {
      if (end - first != 1) return;
      const WeldedEdge& edge = mesh.edges()[first];
      if (mesh_.open_edges++ < places)
        mesh_.open_edges_at.push_back(0.5 * (mesh.places()[edge.from] + mesh.places()[edge.to]));
    });
    mesh_.convex = is_convex(mesh);
    enclosure_.emplace(mesh);
  });
}

const MeshFacts& PreparedRoom::mesh() {
  weld();
  return mesh_;
}

const Enclosure& PreparedRoom::enclosure() {
  weld();
  return *enclosure_;
}

const std::shared_ptr<const EmbreeTree>& PreparedRoom::tree(Edges edges) {
  const std::size_t k = edges == Edges::robust ? 0 : 1;
  const std::lock_guard lock(tree_mutex_[k]);
  if (trees_[k] == nullptr) {
    const auto& planes = this->planes();
    announce("Building the tree of the triangles");
    trees_[k] = std::make_shared<const EmbreeTree>(*room_, edges, threads_, *planes);
  }
  return trees_[k];
}

Tiling PreparedRoom::take_tiling(double edge_m) {
  const std::lock_guard lock(tiling_mutex_);
  if (tiling_ && tiling_->first == edge_m) {
    Tiling tiling = std::move(tiling_->second);
    tiling_.reset();
    return tiling;
  }
  tiling_.reset();
  announce("Laying out tiles");
  return make_tiling(*room_, edge_m, threads_);
}

void PreparedRoom::keep_tiling(double edge_m, Tiling tiling) {
  const std::lock_guard lock(tiling_mutex_);
  tiling_.emplace(edge_m, std::move(tiling));
}

}  // namespace lichtmc
