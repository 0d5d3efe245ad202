// Where a floor of a room extends on the raster of its lit space, and which lines of it walls separate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "run/lit_space.hpp"

namespace lichtmc {

// The raster with one more line on each side, beyond the bounds of the room: nodes, row by row along x.
class FloorNodes {
 public:
  FloorNodes(LitSpace& space, std::size_t floor);

  std::size_t width() const { return xs_.size(); }
  std::size_t height() const { return zs_.size(); }
  glm::dvec2 place(std::size_t node) const { return {xs_[node % width()], zs_[node / width()]}; }

  // The part of the floor that a node belongs to, no_number if it belongs to none.
  std::size_t part(std::size_t node) const { return part_[node]; }
  std::size_t parts() const { return parts_; }
  // Height of the floor at a node that lies on it; NaN elsewhere.
  double floor_height(std::size_t node) const { return own_floor_[node]; }

  // An edge joins a node with the next one along x, or along z. Its number is 2 · node, or that + 1.
  static std::size_t edge(std::size_t node, bool along_z) { return 2 * node + (along_z ? 1 : 0); }
  std::size_t first_node(std::size_t edge) const { return edge / 2; }
  std::size_t second_node(std::size_t edge) const { return edge / 2 + (edge % 2 == 1 ? width() : 1); }
  bool has_edge(std::size_t node, bool along_z) const {
    return along_z ? node / width() + 1 < height() : node % width() + 1 < width();
  }
  // Whether a thin wall crosses an edge between two nodes on the floor.
  bool has_wall(std::size_t edge) const { return wall_[edge] == Barrier::wall; }
  // Where this wall begins, from one node of the edge towards the other.
  glm::dvec2 wall_on(std::size_t from, std::size_t to) const;
  // Whether the floor extends to each of some other places.
  std::vector<bool> extends_to(const std::vector<glm::dvec2>& places) const;

 private:
  // What crosses an edge: nothing; something above only, as the wall above a door or a beam; a wall.
  enum class Barrier : std::uint8_t { nothing, above, wall };
  // What of the room lies above a line.
  struct Above {
    bool extends = false;
    bool under_lintel = false;  // it ends well below the ceiling beside it
    double low = 0.0;           // m, of its highest gap
    double high = 0.0;
  };

  void measure_heights();
  void find_nodes();
  void judge_lintels();
  void find_barriers();
  void judge_barriers();
  void join_parts();
  template <class IsLit>
  Above above(const Column& line, std::size_t nearest, const IsLit& is_lit) const;
  Barrier barrier(std::size_t a, std::size_t b) const;
  bool is_raster(std::size_t node) const;
  std::size_t raster_line(std::size_t node) const;
  std::size_t node_of(std::size_t raster_line) const;
  template <class Use>
  void for_each_around(std::size_t node, std::size_t radius, const Use& use) const;
  bool is_opening(const std::vector<std::size_t>& nodes) const;

  ColumnTracer& tracer_;
  const LitRooms& lit_;
  std::size_t floor_;
  std::size_t room_;
  std::vector<double> xs_, zs_;
  std::vector<double> own_floor_;                  // of each node: NaN if it does not lie on the floor
  std::vector<double> near_floor_, near_ceiling_;  // the same there or nearby; NaN if it is far
  std::vector<std::vector<double>> other_floors_;  // heights of other floors of the room on a node
  std::vector<Above> above_;
  std::vector<char> under_lintel_;  // 1: an opening in a wall; 2: a part of the room that is lower
  std::vector<Barrier> wall_;       // of each edge
  std::vector<std::size_t> part_;
  std::size_t parts_ = 0;
};

}  // namespace lichtmc
