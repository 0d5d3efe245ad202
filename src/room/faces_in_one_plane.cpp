#include "room/faces_in_one_plane.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include <glm/geometric.hpp>

#include "base/parallel.hpp"
#include "room/patch_areas.hpp"
#include "room/room_faces.hpp"

namespace lichtmc {

namespace {

// With more rivals, those at a point are found by a tree, and polygons are divided before they are cut.
constexpr std::size_t few = 16;

// Polygons are not divided more often: far below any tolerance.
constexpr int most_divisions = 60;

glm::dvec2 coordinates(const glm::dvec3& from_corner, const std::array<glm::dvec3, 2>& duals) {
  return {glm::dot(from_corner, duals[0]), glm::dot(from_corner, duals[1])};
}

bool on_triangle(const glm::dvec2& st) {
  return st.x >= 0.0 && st.y >= 0.0 && st.x + st.y <= 1.0;
}

// Triangles that a thread treats at a time: some milliseconds of work.
constexpr std::size_t at_a_time = 8192;

// Two faces in one plane that overlap.
struct Pair {
  std::uint32_t a = 0;  // < b
  std::uint32_t b = 0;
  double gap_m = 0.0;
};

// Those whose first face is one of first … last − 1, in their order.
void find_pairs(const RoomFaces& all, const BoxTree& tree, std::size_t first, std::size_t last,
                std::vector<Pair>& pairs) {
  for (std::size_t n = first; n < last; ++n) {
    if (!all.has_plane(n)) continue;
    tree.for_each_meeting(all.box(n), [&](std::uint32_t other) {
      double gap_m = 0.0;
      if (other <= n || all.beside(n, other) || !all.in_one_plane(n, other, gap_m) || !all.overlap(n, other)) return;
      pairs.push_back({static_cast<std::uint32_t>(n), other, gap_m});
    });
  }
}

struct Box2 {
  glm::dvec2 low{0.0};
  glm::dvec2 high{0.0};

  template <class Points>
  explicit Box2(const Points& points) : low(points[0]), high(points[0]) {
    for (const glm::dvec2& point : points) {
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  bool meets(const Box2& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
  }
};

}  // namespace

FacesInOnePlane::~FacesInOnePlane() = default;

FacesInOnePlane::FacesInOnePlane(const Room& room, unsigned threads) : covered_m2_(room.surfaces.size()) {
  const RoomFaces all(room, threads);
  in_plane_tolerance_ = all.in_plane_tolerance();
  number_.assign(all.size(), none);
  std::vector<Bounds> boxes(all.size());
  for_each_range(threads, all.size(), at_a_time, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      if (all.has_plane(n)) boxes[n] = all.box(n);
    }
  });
  const BoxTree tree(boxes, threads);
  find(all, tree, threads);
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) first_of_surface_.push_back(all.first_of(k));
  if (empty()) return;
  rank(all, tree);
  measure(all);
}

// The pairs of faces in one plane that overlap.
void FacesInOnePlane::find(const RoomFaces& all, const BoxTree& tree, unsigned threads) {
  const auto face_with_others = [&](std::uint32_t triangle) -> Face& {
    if (number_[triangle] == none) {
      number_[triangle] = static_cast<std::uint32_t>(faces_.size());
      Face& face = faces_.emplace_back();
      const RoomFaces::Corners corner = all.corners(triangle);
      face.triangle = triangle;
      face.both_sides = all.both_sides(triangle);
      face.normal = all[triangle].normal;
      face.area_m2 = all[triangle].area_m2;
      face.corner = corner[0];
      face.edges = {corner[1] - corner[0], corner[2] - corner[0]};
      const glm::dvec3 cross = glm::cross(face.edges[0], face.edges[1]);
      const double square = glm::dot(cross, cross);
      face.duals = {glm::cross(face.edges[1], cross) / square, glm::cross(cross, face.edges[0]) / square};
    }
    return faces_[number_[triangle]];
  };
  std::vector<std::vector<Pair>> found((all.size() + at_a_time - 1) / at_a_time);
  for_each_range(threads, all.size(), at_a_time, [&](std::size_t first, std::size_t last) {
    find_pairs(all, tree, first, last, found[first / at_a_time]);
  });
  for (const std::vector<Pair>& pairs : found) {
    for (const Pair& pair : pairs) {
      for (const auto& [one, two] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
        Face& face = face_with_others(one);
        face.others.push_back(two);
        face.gap_m = std::max(face.gap_m, pair.gap_m);
      }
      largest_gap_m_ = std::max(largest_gap_m_, pair.gap_m);
    }
  }
}

// The rivals of each side of each face, by the rule.
void FacesInOnePlane::rank(const RoomFaces& all, const BoxTree& tree) {
  std::vector<std::uint32_t> concerned;
  for (const Face& face : faces_) concerned.push_back(face.triangle);
  std::sort(concerned.begin(), concerned.end());
  const auto orders = patch_orders(all, tree, concerned);
  for (Face& face : faces_) {
    std::sort(face.others.begin(), face.others.end());
    for (const bool behind : {false, true}) {
      const glm::dvec3 direction = behind ? -face.normal : face.normal;
      // The smallest key counts.
      const auto key = [&](const Face& one) {
        const bool back = !(glm::dot(one.normal, direction) > 0.0);
        const PatchOrder& order = orders.at(one.triangle);
        return std::tuple(back && !one.both_sides, order.area, back, order.patch, order.surface, one.triangle);
      };
      const auto same_right = [](const auto& a, const auto& b) {
        const auto rule = [](const auto& k) { return std::tuple(std::get<0>(k), std::get<1>(k), std::get<2>(k)); };
        return rule(a) == rule(b) && (std::get<3>(a) != std::get<3>(b) || std::get<4>(a) == std::get<4>(b));
      };
      const auto own = key(face);
      OneSide& side = face.sides[behind ? 1 : 0];
      for (const std::uint32_t other : face.others) {
        const auto theirs = key(face_of(other));
        // Two faces of one surface reflect alike, and their light counts for the same surface.
        const bool tied = same_right(theirs, own) && all[other].surface != all[face.triangle].surface;
        if (tied) side.ties.push_back(other);
        if (theirs < own) side.rivals.push_back({other, tied, !std::get<0>(theirs)});
      }
      std::sort(side.rivals.begin(), side.rivals.end(),
                [&](const Rival& a, const Rival& b) { return key(face_of(a.triangle)) < key(face_of(b.triangle)); });
      if (side.rivals.size() <= few) continue;
      std::vector<Bounds> boxes;
      for (const Rival& rival : side.rivals) boxes.push_back(all.box(rival.triangle));
      side.tree = std::make_unique<BoxTree>(boxes);
    }
  }
}

// The covered areas.
void FacesInOnePlane::measure(const RoomFaces& all) {
  std::map<std::tuple<std::size_t, std::size_t, bool>, Cover> found;
  std::map<std::pair<std::size_t, std::size_t>, Cover> back_to_back;
  const ConvexPolygon whole{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  for (const Face& face : faces_) {
    const std::size_t under = all[face.triangle].surface;
    for (const bool behind : {false, true}) {
      const OneSide& side = face.sides[behind ? 1 : 0];
      std::vector<std::uint32_t> by(side.rivals.size());
      std::iota(by.begin(), by.end(), std::uint32_t{0});
      const auto inside = [&](const Rival& rival, const ConvexPolygon& part) {
        const double area = std::abs(twice_signed_area(part)) * face.area_m2;
        // The back of a one-sided face is covered by definition where something faces that side: it is counted once,
        // by the face with the larger number.
        if (behind && !face.both_sides) {
          if (!rival.facing || rival.triangle > face.triangle) return;
          Cover& pair = back_to_back[{under, all[rival.triangle].surface}];
          pair.over = all[rival.triangle].surface;
          pair.under = under;
          pair.area_m2 += area;
          return;
        }
        const std::size_t over = all[rival.triangle].surface;
        Cover& cover = found[{under, over, behind}];
        cover.over = over;
        cover.under = under;
        cover.behind = behind;
        cover.area_m2 += area;
        if (rival.tied) cover.undecided_m2 += area;
        covered_m2_[under][behind ? 1 : 0] += area;
      };
      if (!by.empty()) divide(face, side, whole, by, 0, inside, [](const ConvexPolygon&) {});
    }
  }
  for (const auto& [which, cover] : found) covers_.push_back(cover);
  for (const auto& [which, pair] : back_to_back) opposites_.push_back(pair);
}

bool FacesInOnePlane::may_be_covered(std::size_t triangle, bool behind) const {
  return has_others(triangle) && !face_of(triangle).sides[behind ? 1 : 0].rivals.empty();
}

const FacesInOnePlane::Rival* FacesInOnePlane::best_at(const OneSide& side, const glm::dvec3& point) const {
  const auto holds = [&](const Rival& rival) {
    const Face& face = face_of(rival.triangle);
    return on_triangle(coordinates(point - face.corner, face.duals));
  };
  if (!side.tree) {
    const auto found = std::find_if(side.rivals.begin(), side.rivals.end(), holds);
    return found == side.rivals.end() ? nullptr : &*found;
  }
  std::uint32_t best = none;
  side.tree->for_each_meeting({point, point}, [&](std::uint32_t n) {
    if (n < best && holds(side.rivals[n])) best = n;
  });
  return best == none ? nullptr : &side.rivals[best];
}

FacePlace FacesInOnePlane::counting(const FacePlace& place, bool& undecided) const {
  const Face& face = face_of(place.triangle);
  const glm::dvec3 point = face.corner + place.s * face.edges[0] + place.t * face.edges[1];
  const OneSide& side = face.sides[place.behind ? 1 : 0];
  const auto has_a_tie = [&](const OneSide& of) {
    return std::any_of(of.ties.begin(), of.ties.end(), [&](std::uint32_t other) {
      const Face& one = face_of(other);
      return on_triangle(coordinates(point - one.corner, one.duals));
    });
  };
  const Rival* best = best_at(side, point);
  if (best == nullptr) {
    undecided = has_a_tie(side);
    return place;
  }
  const Face& top = face_of(best->triangle);
  const glm::dvec2 st = coordinates(point - top.corner, top.duals);
  const bool turned = glm::dot(top.normal, face.normal) < 0.0;
  const bool behind = place.behind != turned;
  undecided = has_a_tie(top.sides[behind ? 1 : 0]);
  return {best->triangle, st.x, st.y, behind};
}

bool FacesInOnePlane::counts(const FacePlace& place) const {
  if (!may_be_covered(place.triangle, place.behind)) return true;
  const Face& face = face_of(place.triangle);
  const glm::dvec3 point = face.corner + place.s * face.edges[0] + place.t * face.edges[1];
  return best_at(face.sides[place.behind ? 1 : 0], point) == nullptr;
}

double FacesInOnePlane::covered_m2(std::size_t surface, bool behind) const {
  return covered_m2_[surface][behind ? 1 : 0];
}

FlatTriangle FacesInOnePlane::in_coordinates_of(const Face& face, std::size_t triangle) const {
  const Face& other = face_of(triangle);
  const glm::dvec3 corner = other.corner - face.corner;
  return {coordinates(corner, face.duals), coordinates(corner + other.edges[0], face.duals),
          coordinates(corner + other.edges[1], face.duals)};
}

// Whether a polygon is thinner than the tolerance of positions.
bool FacesInOnePlane::negligible(const Face& face, const ConvexPolygon& polygon) const {
  double longest = 0.0;
  for (const glm::dvec2& corner : polygon) {
    const glm::dvec2 from = corner - polygon[0];
    longest = std::max(longest, glm::length(from.x * face.edges[0] + from.y * face.edges[1]));
  }
  return !(std::abs(twice_signed_area(polygon)) * face.area_m2 > in_plane_tolerance_ * longest);
}

// Divides the halves of a polygon instead of the whole, unless that saves nothing: where many faces have the same
// outline, both halves meet all of them.
template <class Inside, class Outside>
bool FacesInOnePlane::halve(const Face& face, const OneSide& side, const ConvexPolygon& polygon,
                            const std::vector<std::uint32_t>& by, int depth, const Inside& inside,
                            const Outside& outside) const {
  constexpr double worth = 1.5;
  if (depth >= most_divisions) return false;
  const Box2 box(polygon);
  const glm::dvec2 size = box.high - box.low;
  const glm::dvec2 middle = 0.5 * (box.low + box.high);
  const glm::dvec2 along = size.x > size.y ? glm::dvec2(0.0, 1.0) : glm::dvec2(1.0, 0.0);
  const std::array<ConvexPolygon, 2> halves{left_of(middle, middle + along, polygon),
                                            right_of(middle, middle + along, polygon)};
  std::array<std::vector<std::uint32_t>, 2> meeting;
  for (const std::uint32_t n : by) {
    const Box2 rival(in_coordinates_of(face, side.rivals[n].triangle));
    for (std::size_t k = 0; k < 2; ++k) {
      if (!halves[k].empty() && rival.meets(Box2(halves[k]))) meeting[k].push_back(n);
    }
  }
  if (static_cast<double>(meeting[0].size() + meeting[1].size()) > worth * static_cast<double>(by.size())) return false;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!halves[k].empty() && !negligible(face, halves[k]))
      divide(face, side, halves[k], meeting[k], depth + 1, inside, outside);
  }
  return true;
}

// by: the rivals that may cover a part of the polygon, the best first. If there are many, the polygon is halved, so
// that each part meets few of them.
template <class Inside, class Outside>
void FacesInOnePlane::divide(const Face& face, const OneSide& side, const ConvexPolygon& polygon,
                             const std::vector<std::uint32_t>& by, int depth, const Inside& inside,
                             const Outside& outside) const {
  if (by.size() > few && halve(face, side, polygon, by, depth, inside, outside)) return;
  std::vector<ConvexPolygon> parts{polygon};
  for (const std::uint32_t n : by) {
    const FlatTriangle triangle = in_coordinates_of(face, side.rivals[n].triangle);
    std::vector<ConvexPolygon> rest;
    for (const ConvexPolygon& part : parts) {
      std::vector<ConvexPolygon> cut;
      const ConvexPolygon covered = cut_out(triangle, part, cut);
      if (covered.empty() || negligible(face, covered)) {
        rest.push_back(part);
        continue;
      }
      inside(side.rivals[n], covered);
      for (ConvexPolygon& one : cut) {
        if (!negligible(face, one)) rest.push_back(std::move(one));
      }
    }
    parts = std::move(rest);
    if (parts.empty()) return;
  }
  for (const ConvexPolygon& part : parts) outside(part);
}

std::vector<ConvexPolygon> FacesInOnePlane::uncovered(std::size_t triangle, bool behind,
                                                      const ConvexPolygon& polygon) const {
  if (!may_be_covered(triangle, behind)) return {polygon};
  const Face& face = face_of(triangle);
  const OneSide& side = face.sides[behind ? 1 : 0];
  std::vector<std::uint32_t> by;
  if (side.tree) {
    Bounds box;
    for (const glm::dvec2& corner : polygon) box.add(face.corner + corner.x * face.edges[0] + corner.y * face.edges[1]);
    side.tree->for_each_meeting(box, [&](std::uint32_t n) { by.push_back(n); });
    std::sort(by.begin(), by.end());
  } else {
    by.resize(side.rivals.size());
    std::iota(by.begin(), by.end(), std::uint32_t{0});
  }
  std::vector<ConvexPolygon> parts;
  divide(
      face, side, polygon, by, 0, [](const Rival&, const ConvexPolygon&) {},
      [&](const ConvexPolygon& part) { parts.push_back(part); });
  return parts;
}

std::optional<Surface> FacesInOnePlane::uncovered_front(const Room& room, std::size_t surface) const {
  const Surface& whole = room.surfaces[surface];
  const ConvexPolygon all{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  std::optional<Surface> part;
  for (std::size_t n = 0; n < whole.triangles.size(); ++n) {
    const std::size_t triangle = number_of(surface, n);
    if (!may_be_covered(triangle, false)) continue;
    if (!part) part = whole;
    const glm::uvec3 corner = whole.triangles[n];
    // Positions and texture coordinates of the corners of the parts.
    const auto between = [&corner](const auto& values, const glm::dvec2& st) {
      const auto a = values[corner.x];
      return a + st.x * (values[corner.y] - a) + st.y * (values[corner.z] - a);
    };
    part->triangles[n] = glm::uvec3(corner.x);
    for (const ConvexPolygon& polygon : uncovered(triangle, false, all)) {
      const auto first = static_cast<std::uint32_t>(part->positions.size());
      for (const glm::dvec2& st : polygon) {
        part->positions.push_back(between(whole.positions, st));
        if (!whole.uvs.empty()) part->uvs.push_back(between(whole.uvs, st));
        if (!whole.reflectance_uvs.empty()) part->reflectance_uvs.push_back(between(whole.reflectance_uvs, st));
      }
      for (std::uint32_t k = 1; k + 1 < polygon.size(); ++k)
        part->triangles.emplace_back(first, first + k, first + k + 1);
    }
  }
  return part;
}

}  // namespace lichtmc
