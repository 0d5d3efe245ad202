// A partition of the points on a room's surfaces into cells, by place and by the direction that the surface faces.
//
// It is made from sample points, for example where photons land: cells hold about the same number of them, so that they
// are small where there are many. For each of the six main directions of a normal (its largest component, with its
// sign) the points are divided by planes along the axes: a k-d tree (J. L. Bentley, Multidimensional binary search
// trees used for associative searching, CACM 18(9), 1975). So the two sides of a wall never share a cell. The plane
// that divides a few hundred points lies in the widest gap of their middle half: between rooms, where there is one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "room/bounds.hpp"

namespace lichtmc {

// A point on a surface, in m, and the normal of the side in question, of length 1.
struct Place {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0, 1.0, 0.0};
};

class PlaceTree {
 public:
  // Cells that follow each other: begin … end − 1.
  struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    std::uint32_t size() const { return end - begin; }
  };

  // most: points of a cell; more only if they are one and the same point. region: points of a region, at least, if
  // there are so many with its main direction.
  PlaceTree(const std::vector<Place>& places, std::size_t most, std::size_t region);

  // Cells are numbered 0 … size() − 1; their regions too.
  std::size_t size() const { return region_of_.size(); }
  std::size_t regions() const { return regions_.size(); }

  // The cell of any point, also far from all sample points; size() if none of these has the same main direction.
  std::uint32_t cell_of(const glm::dvec3& point, const glm::dvec3& normal) const;

  // A region is a larger part of the room: cells in sequence. Every cell belongs to one.
  Range cells_of_region(std::size_t region) const { return regions_[region].cells; }
  std::uint32_t region_of(std::uint32_t cell) const { return region_of_[cell]; }

  // The other regions that meet a region at the centres of its six faces, each once.
  std::vector<std::uint32_t> neighbours(std::uint32_t region) const;

  // The sample points of cells, as indices into `places`; those of one cell are ascending.
  std::span<const std::uint32_t> members(Range cells) const {
    const std::size_t begin = first_[cells.begin];
    return std::span<const std::uint32_t>(order_).subspan(begin, first_[cells.end] - begin);
  }
  std::span<const std::uint32_t> members(std::uint32_t cell) const { return members({cell, cell + 1}); }

 private:
  // Its box lies between planes, or ends where the points end. In m.
  struct Region {
    Range cells;
    Bounds box;
    std::uint32_t root = 0;
  };
  static constexpr std::uint32_t leaf = 3;  // as axis
  // Below the plane: node `next`; from it on: the node after. Of a leaf, `next` is its cell.
  struct Node {
    double plane = 0.0;  // m
    std::uint32_t axis = leaf;
    std::uint32_t next = 0;
  };
  static constexpr std::uint32_t no_node = std::numeric_limits<std::uint32_t>::max();

  struct Branch;
  void divide(const std::vector<Place>& places, const Branch& branch);
  std::uint32_t descend(std::uint32_t node, const glm::dvec3& point) const;

  std::size_t most_;
  std::size_t region_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> first_;      // point of each cell in order_; and the end
  std::vector<std::uint32_t> region_of_;  // of each cell
  std::vector<Region> regions_;
  std::vector<Node> nodes_;
  std::array<std::uint32_t, 6> roots_{};
};

}  // namespace lichtmc
