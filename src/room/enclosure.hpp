// Closed shells: light inside one cannot escape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "room/bounds.hpp"
#include "room/welded_mesh.hpp"

namespace lichtmc {

// The closed shells of a room: connected sets of triangles in which every edge belongs to an even number of triangles.
// Meshes with boundary edges, and meshes with T-junctions, are not closed in this sense: the answer "not enclosed" is
// the safe one.
class Enclosure {
 public:
  // The room, also that of the mesh, must outlive this.
  explicit Enclosure(const Room& room) : Enclosure(WeldedMesh(room)) {}
  explicit Enclosure(Room&& room) = delete;
  explicit Enclosure(const WeldedMesh& mesh);

  bool has_closed_shell() const { return !shells_.empty(); }

  // Whether a point (world coordinates, m) lies inside a closed shell: a ray from it crosses the shell an odd number of
  // times.
  bool encloses(const glm::dvec3& point_m) const { return shells_about(point_m) > 0; }

  // shells_around() for each of several points, much faster if they are many.
  std::vector<std::vector<std::size_t>> shells_around_each(const std::vector<glm::dvec3>& points_m) const;

  // Whether a closed shell extends over all of a box, up to `slack` (m) at each side.
  bool has_shell_over(const Bounds& box, double slack) const;

  // The number of closed shells that contain a point.
  std::size_t shells_about(const glm::dvec3& point_m) const { return shells_around(point_m).size(); }

  // The numbers of the closed shells that contain a point, in ascending order.
  std::vector<std::size_t> shells_around(const glm::dvec3& point_m) const;

 private:
  struct Face {
    std::uint32_t surface = 0;
    std::uint32_t triangle = 0;  // index into Surface::triangles
  };
  using Shell = std::vector<Face>;

  WeldedMesh::Corners corners(const Face& face) const;
  bool is_inside(const Shell& shell, const glm::dvec3& point_m) const;

  const Room* room_;
  std::vector<Shell> shells_;
};

}  // namespace lichtmc
