#include "room/patch_areas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include <glm/geometric.hpp>

#include "base/disjoint_sets.hpp"
#include "room/mesh_links.hpp"

namespace lichtmc {

namespace {

// A face that ends at a part of an edge, on one of its sides.
struct End {
  double from = 0.0;  // m along the edge
  double to = 0.0;
  bool beyond = false;  // on the other side than the face whose edge it is
  bool whole = false;   // its edge is the whole edge, with the same corners
  std::uint32_t face = 0;
};

class SurfacePatches {
 public:
  SurfacePatches(const RoomFaces& faces, const BoxTree& tree)
      : faces_(faces),
        tree_(tree),
        links_(faces.room().surfaces.size()),
        visited_(faces.size(), false),
        of_surface_(faces.size()),
        whole_(faces.size()) {}

  // Joins all faces that are connected to this one.
  void grow_from(std::uint32_t start) {
    if (visited_[start]) return;
    std::vector<std::uint32_t> open{start};
    visited_[start] = true;
    const auto reach = [&](std::uint32_t face) {
      if (visited_[face]) return;
      visited_[face] = true;
      open.push_back(face);
    };
    while (!open.empty()) {
      const std::uint32_t face = open.back();
      open.pop_back();
      reached_.push_back(face);
      for (std::size_t edge = 0; edge < 3; ++edge) {
        const std::vector<std::uint32_t> neighbours = in_surface(face, edge);
        for (const std::uint32_t other : neighbours) {
          of_surface_.join(face, other);
          whole_.join(face, other);
          reach(other);
        }
        if (!neighbours.empty()) continue;
        for (const std::uint32_t other : across(face, edge)) {
          whole_.join(face, other);
          reach(other);
        }
      }
    }
  }

  void add_up() {
    for (const std::uint32_t face : reached_) {
      area_of_surface_[of_surface_.find(face)] += faces_[face].area_m2;
      area_of_whole_[whole_.find(face)] += faces_[face].area_m2;
      std::uint32_t& first = first_of_whole_.try_emplace(whole_.find(face), face).first->second;
      first = std::min(first, face);
    }
  }
  double area_of_surface(std::uint32_t face) { return area_of_surface_[of_surface_.find(face)]; }
  double area_of_whole(std::uint32_t face) { return area_of_whole_[whole_.find(face)]; }
  std::uint32_t first_of_whole(std::uint32_t face) { return first_of_whole_[whole_.find(face)]; }

 private:
  const MeshLinks& links(std::uint32_t surface) {
    if (!links_[surface]) links_[surface] = std::make_unique<MeshLinks>(faces_.room().surfaces[surface]);
    return *links_[surface];
  }

  bool same_patch(std::uint32_t a, std::uint32_t b) const {
    double gap = 0.0;
    if (!faces_.has_plane(a) || !faces_.has_plane(b) || !faces_.in_one_plane(a, b, gap)) return false;
    return faces_.both_sides(a) || faces_.both_sides(b) || glm::dot(faces_[a].normal, faces_[b].normal) > 0.0;
  }

  // Neighbours of the same surface beyond an edge.
  std::vector<std::uint32_t> in_surface(std::uint32_t face, std::size_t edge) {
    const std::uint32_t surface = faces_[face].surface;
    const auto first = static_cast<std::uint32_t>(faces_.first_of(surface));
    std::vector<std::uint32_t> found;
    for (const std::uint32_t n : links(surface).at_edge(faces_[face].triangle, edge)) {
      const std::uint32_t other = first + n;
      if (other != face && same_patch(face, other)) found.push_back(other);
    }
    return found;
  }

  // The faces of other surfaces that continue this one beyond an edge: one alone on either side, or else one alone with
  // the same corners.
  std::vector<std::uint32_t> across(std::uint32_t face, std::size_t edge) {
    const auto corners = faces_.corners(face);
    const glm::dvec3 a = corners[edge];
    const glm::dvec3 b = corners[(edge + 1) % 3];
    const double length = glm::length(b - a);
    const glm::dvec3 along = (b - a) / length;
    const glm::dvec3 outwards = outward(corners, edge, along);
    std::vector<End> ends;
    Bounds box;
    box.add(a);
    box.add(b);
    tree_.for_each_meeting(box, [&](std::uint32_t other) {
      if (other != face && same_patch(face, other)) add_ends(other, a, along, outwards, length, ends);
    });
    const std::vector<std::uint32_t> found = alone(ends);
    return found.empty() ? alone_with_same_corners(ends) : found;
  }

  static std::vector<std::uint32_t> alone_with_same_corners(const std::vector<End>& ends) {
    std::vector<std::uint32_t> found;
    for (const End& end : ends) {
      if (!end.whole) continue;
      if (!end.beyond) return {};
      found.push_back(end.face);
    }
    return found.size() == 1 ? found : std::vector<std::uint32_t>{};
  }

  // The direction in the face's plane that leads out of it over an edge.
  glm::dvec3 outward(const RoomFaces::Corners& corners, std::size_t edge, const glm::dvec3& along) const {
    const glm::dvec3 inwards = corners[(edge + 2) % 3] - corners[edge];
    return -glm::normalize(inwards - glm::dot(inwards, along) * along);
  }

  // Adds the edges of `other` that lie on the edge from a and do not lead to another face of its surface.
  void add_ends(std::uint32_t other, const glm::dvec3& a, const glm::dvec3& along, const glm::dvec3& outwards,
                double length, std::vector<End>& ends) {
    const double tolerance = faces_.in_plane_tolerance();
    const auto corners = faces_.corners(other);
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const glm::dvec3 from = corners[edge] - a;
      const glm::dvec3 to = corners[(edge + 1) % 3] - a;
      const double low = std::max(0.0, std::min(glm::dot(from, along), glm::dot(to, along)));
      const double high = std::min(length, std::max(glm::dot(from, along), glm::dot(to, along)));
      if (!(high - low > tolerance) || !on_line(from, to, along, outwards, low, high)) continue;
      if (!in_surface(other, edge).empty()) continue;
      const double third = glm::dot(corners[(edge + 2) % 3] - a, outwards);
      const auto same = [&](const glm::dvec3& p, double place) { return glm::length(p - place * along) <= tolerance; };
      const bool whole = (same(from, 0.0) && same(to, length)) || (same(from, length) && same(to, 0.0));
      ends.push_back({low, high, third > 0.0, whole, other});
    }
  }

  // Whether the line from … to is at most the tolerance off the edge, where both lie beside each other.
  bool on_line(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& along, const glm::dvec3& outwards,
               double low, double high) const {
    const double start = glm::dot(from, along);
    const double slope = (glm::dot(to, outwards) - glm::dot(from, outwards)) / (glm::dot(to, along) - start);
    for (const double place : {low, high}) {
      const double off = glm::dot(from, outwards) + (place - start) * slope;
      if (std::abs(off) > faces_.in_plane_tolerance()) return false;
    }
    return true;
  }

  // The faces that are the only end on their part of an edge, longer than the tolerance, beyond it.
  std::vector<std::uint32_t> alone(const std::vector<End>& ends) const {
    struct Event {
      double place;
      bool opens;
      const End* end;
    };
    std::vector<Event> events;
    for (const End& end : ends) {
      events.push_back({end.from, true, &end});
      events.push_back({end.to, false, &end});
    }
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
      return a.place < b.place || (a.place == b.place && !a.opens && b.opens);
    });
    std::vector<std::uint32_t> found;
    std::size_t here = 0;
    std::size_t beyond = 0;
    std::size_t sum = 0;  // of the numbers of those beyond: of the only one, its number
    for (std::size_t n = 0; n + 1 < events.size(); ++n) {
      const Event& event = events[n];
      if (event.end->beyond) {
        beyond += event.opens ? 1 : std::size_t(-1);
        sum += event.opens ? event.end->face : std::size_t{0} - event.end->face;
      } else {
        here += event.opens ? 1 : std::size_t(-1);
      }
      const double length = events[n + 1].place - event.place;
      if (here == 0 && beyond == 1 && length > faces_.in_plane_tolerance())
        found.push_back(static_cast<std::uint32_t>(sum));
    }
    return found;
  }

  const RoomFaces& faces_;
  const BoxTree& tree_;
  std::vector<std::unique_ptr<MeshLinks>> links_;  // of the surfaces that were needed
  std::vector<bool> visited_;
  std::vector<std::uint32_t> reached_;
  DisjointSets<std::uint32_t> of_surface_;
  DisjointSets<std::uint32_t> whole_;
  std::unordered_map<std::uint32_t, double> area_of_surface_;
  std::unordered_map<std::uint32_t, double> area_of_whole_;
  std::unordered_map<std::uint32_t, std::uint32_t> first_of_whole_;  // the smallest number of its faces
};

// Numbers for areas, in ascending order; an area that differs from the next smaller one by rounding has its number.
std::vector<std::uint32_t> classes(const std::vector<double>& areas, double tolerance) {
  std::vector<std::uint32_t> order(areas.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return areas[a] < areas[b]; });
  std::vector<std::uint32_t> number(areas.size());
  std::uint32_t current = 0;
  for (std::size_t n = 1; n < order.size(); ++n) {
    const double smaller = areas[order[n - 1]];
    if (areas[order[n]] - smaller > tolerance * 4.0 * std::sqrt(areas[order[n]])) ++current;
    number[order[n]] = current;
  }
  return number;
}

}  // namespace

std::unordered_map<std::uint32_t, PatchOrder> patch_orders(const RoomFaces& faces, const BoxTree& tree,
                                                           const std::vector<std::uint32_t>& of) {
  SurfacePatches patches(faces, tree);
  for (const std::uint32_t face : of) patches.grow_from(face);
  patches.add_up();
  std::vector<double> whole;
  std::vector<double> of_surface;
  for (const std::uint32_t face : of) {
    whole.push_back(patches.area_of_whole(face));
    of_surface.push_back(patches.area_of_surface(face));
  }
  const std::vector<std::uint32_t> by_whole = classes(whole, faces.in_plane_tolerance());
  const std::vector<std::uint32_t> by_surface = classes(of_surface, faces.in_plane_tolerance());
  std::unordered_map<std::uint32_t, PatchOrder> orders;
  for (std::size_t n = 0; n < of.size(); ++n)
    orders[of[n]] = {by_whole[n], patches.first_of_whole(of[n]), by_surface[n]};
  return orders;
}

}  // namespace lichtmc
