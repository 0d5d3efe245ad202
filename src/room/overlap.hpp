// Overlap tests of triangles in a plane, one by one, for tens of thousands of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include <glm/vec2.hpp>

namespace lichtmc {

using FlatTriangle = std::array<glm::dvec2, 3>;

// The smallest of the heights of a triangle; 0 if it has no area.
double thickness(const FlatTriangle& triangle);

// The length of the shortest shift that separates two triangles, whatever their winding; 0 or less if they do not
// overlap.
double penetration_depth(const FlatTriangle& a, const FlatTriangle& b);

// Triangles that do not overlap each other.
class OverlapIndex {
 public:
  // tolerance: overlaps no deeper than this, and triangles no thicker, do not count; above 0, in the unit of the
  // coordinates, which must be finite and at most 2^30 tolerances in size.
  explicit OverlapIndex(double tolerance) : tolerance_(tolerance) {}

  // Adds a triangle unless it overlaps one that was added before; then nothing changes and that one's id is returned.
  // Fastest where large triangles come before small ones.
  std::optional<std::size_t> add(const FlatTriangle& triangle, std::size_t id);

 private:
  struct Box {
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
  };
  struct Member {
    FlatTriangle triangle;
    Box box;
    std::size_t id = 0;
  };
  struct Entry {
    std::uint32_t member = 0;
    std::uint32_t next = 0;  // entry of the same cell, or no_entry
  };
  // Cells of the size 2^level; each has the members that overlap it as a chain of entries.
  struct Level {
    std::unordered_map<std::uint64_t, std::uint32_t> first_entry;
    std::vector<Entry> entries;
    std::vector<std::uint32_t> members;
  };
  struct CellRange {
    std::int64_t low_x = 0, low_y = 0, high_x = 0, high_y = 0;
    double count = 0.0;
  };
  static constexpr std::uint32_t no_entry = 0xFFFFFFFF;

  static Box bounds(const FlatTriangle& triangle);
  static CellRange cells(const Box& box, int level);
  std::optional<std::size_t> find(const Member& candidate, int number, const Level& level) const;
  bool overlap(const Member& candidate, std::uint32_t member) const;
  void insert(const Member& member);

  double tolerance_;
  std::vector<Member> members_;
  std::map<int, Level> levels_;
};

}  // namespace lichtmc
