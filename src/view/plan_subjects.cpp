#include "view/plan_subjects.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

constexpr double min_area_share = 0.02;  // of the room's surface area, for a plan

class Subjects {
 public:
  Subjects(const Room& room, const Result& result, const LitSides& lit) : room_(&room), result_(&result), lit_(&lit) {
    double area = 0.0;
    for (const Surface& surface : room.surfaces) area += surface_area(surface);
    for (std::size_t m = 0; m < result.tiling.maps.size(); ++m) add(m, min_area_share * area);
    std::stable_sort(list_.begin(), list_.end(),
                     [](const PlanSubject& a, const PlanSubject& b) { return a.piece.area_m2 > b.piece.area_m2; });
  }

  std::vector<PlanSubject> take() { return std::move(list_); }

 private:
  void add(std::size_t m, double least_m2) {
    const TileMap& map = result_->tiling.maps[m];
    const Surface& surface = room_->surfaces[map.surface];
    const double area = result_->surfaces[m].area_m2;
    if (area < least_m2) return;
    double flat = 0.0;
    for (FlatPiece& piece : flat_pieces(surface, least_m2)) {
      flat += piece.area_m2;
      const auto [front, back] = lit_areas(map.surface, piece);
      if (surface.sides == Sides::both) {
        if ((map.side == Side::front ? front : back) > 0.0)
          list_.push_back({m, std::move(piece), map.side == Side::back});
      } else if (front > 0.0 || back > 0.0) {
        list_.push_back({m, std::move(piece), back > front});
      }
    }
    if (flat >= 0.5 * area) return;
    PlanSubject whole{m, {}, false};
    whole.piece.area_m2 = area;
    list_.push_back(std::move(whole));
  }

  // Area in m² with a lit front face, and with a lit back face.
  std::pair<double, double> lit_areas(std::size_t surface, const FlatPiece& piece) const {
    double front = 0.0;
    double back = 0.0;
    for (const std::uint32_t n : piece.triangles) {
      const SideLight& side = (*lit_)[surface][n];
      const Surface& own = room_->surfaces[surface];
      const glm::dvec3 a = own.positions[own.triangles[n].x];
      const double area =
          0.5 * glm::length(glm::cross(own.positions[own.triangles[n].y] - a, own.positions[own.triangles[n].z] - a));
      front += side.front ? area : 0.0;
      back += side.back ? area : 0.0;
    }
    return {front, back};
  }

  const Room* room_;
  const Result* result_;
  const LitSides* lit_;
  std::vector<PlanSubject> list_;
};

}  // namespace

std::vector<PlanSubject> plan_subjects(const Room& room, const Result& result, const LitSides& lit) {
  return Subjects(room, result, lit).take();
}

}  // namespace lichtmc
