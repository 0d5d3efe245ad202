#include "walk/inside.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "chance/stream.hpp"
#include "lichtmc/emitter_law.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 20212;  // any: the same room is told the same each time
constexpr std::uint32_t spread_candidates = 192;
constexpr std::size_t triangles_tested = 192;
constexpr std::uint32_t coarse_rays = 64;
constexpr std::uint32_t fine_rays = 512;
constexpr std::size_t finalists = 24;

// What a point sees.
struct View {
  glm::dvec3 place{0.0};
  double enclosed = 0.0;  // share of the directions in which there is a surface; mean of all and of those along a floor
  double fronts = 0.0;    // share of fronts among them
  double distance = 0.0;  // m, below which a tenth of them are
  double score = 0.0;
};

class Search {
 public:
  Search(const Room& room, const Tracer& tracer, const glm::dvec3& low, const glm::dvec3& high)
      : room_(room), tracer_(tracer), low_(low), high_(high), rays_(fine_rays) {
    // Half a usual room's smallest side is enough distance: a hall is not more inside than an office. In models of
    // other units, a fifth of the height, which is along y or z.
    constexpr double enough_m = 1.2;
    enough_ = std::min(enough_m, 0.2 * std::min(high.y - low.y, high.z - low.z));
  }

  InsidePoint best() {
    std::vector<View> views;
    for (const glm::dvec3& place : candidates()) views.push_back(look(place, coarse_rays));
    std::stable_sort(views.begin(), views.end(), [](const View& a, const View& b) { return a.score > b.score; });
    views.resize(std::min(views.size(), finalists));
    for (View& view : views) view = look(view.place, fine_rays);
    std::stable_sort(views.begin(), views.end(), [](const View& a, const View& b) { return a.score > b.score; });
    const View& best = views.front();
    const View middle = look(middle_of_space(best.place), fine_rays);
    // The middle of the space about the best point is a plainer place.
    constexpr double as_good = 0.85;
    const View& chosen = middle.score >= as_good * best.score ? middle : best;
    return {chosen.place, is_sure(chosen, views)};
  }

 private:
  std::vector<glm::dvec3> candidates() {
    std::vector<glm::dvec3> places{0.5 * (low_ + high_)};
    const Stream stream(seed);
    for (std::uint32_t c = 0; c < spread_candidates; ++c) {
      const Words words = stream.draw(c, 0, Purpose::place);
      places.push_back(low_ +
                       (high_ - low_) * glm::dvec3(unit_open(words[0]), unit_open(words[1]), unit_open(words[2])));
    }
    add_middles_before_triangles(places);
    return places;
  }

  // Halfway from some triangles to what faces them, on both sides: in every room of a building on wide ground.
  void add_middles_before_triangles(std::vector<glm::dvec3>& places) {
    std::size_t all = 0;
    for (const Surface& surface : room_.surfaces) all += surface.triangles.size();
    const std::size_t stride = std::max<std::size_t>(1, all / triangles_tested);
    std::size_t number = 0;
    for (std::size_t k = 0; k < room_.surfaces.size(); ++k) {
      for (std::size_t n = 0; n < room_.surfaces[k].triangles.size(); ++n) {
        if (number++ % stride == 0) add_middles(k, n, places);
      }
    }
  }

  void add_middles(std::size_t surface, std::size_t triangle, std::vector<glm::dvec3>& places) {
    const Surface& mesh = room_.surfaces[surface];
    const glm::uvec3 corner = mesh.triangles[triangle];
    const glm::dvec3 a = mesh.positions[corner.x];
    const glm::dvec3 cross = glm::cross(mesh.positions[corner.y] - a, mesh.positions[corner.z] - a);
    const double length = glm::length(cross);
    if (!(length > 0.0)) return;
    const TriangleOnFacet at = tracer_.locate(surface, triangle);
    rays_.size = 2;
    for (std::uint32_t side = 0; side < 2; ++side) {
      rays_.facet[side] = at.facet;
      const glm::vec2 middle = (3.0F * at.st_0 + at.st_1 + at.st_2) / 3.0F;
      rays_.s[side] = middle.x;
      rays_.t[side] = middle.y;
      rays_.behind[side] = side;
      rays_.set_direction(side, glm::vec3(tracer_.directions() * ((side == 0 ? 1.0 : -1.0) / length * cross)));
    }
    tracer_.depart(rays_);
    tracer_.trace(rays_, Misses::escape, count_);
    for (std::size_t i = 0; i < 2; ++i) {
      if (rays_.facet[i] != no_facet) places.push_back(point_on_ray(i, 0.5));
    }
  }

  glm::dvec3 point_on_ray(std::size_t i, double share) const {
    return tracer_.world_point(glm::dvec3(rays_.start(i)) +
                               share * double{rays_.length[i]} * glm::dvec3(rays_.direction(i)));
  }

  // Rays from a point; false if it lies on a surface.
  bool send(const glm::dvec3& place, std::uint32_t n, bool along_axes) {
    const Start start = tracer_.start(place, glm::dvec3(0.0));
    if (start.on_surface) return false;
    const Stream stream(seed + 1);
    rays_.size = n;
    for (std::uint32_t i = 0; i < n; ++i) {
      glm::dvec3 direction(0.0);
      if (along_axes) {
        direction[static_cast<int>(i / 2)] = i % 2 == 0 ? 1.0 : -1.0;
      } else {
        const Words words = stream.draw(i, 0, Purpose::emission);
        direction = IsotropicLaw{}.sample(unit_open(words[0]), unit_open(words[1]));
      }
      rays_.facet[i] = no_facet;
      rays_.set_start(i, start.point);
      rays_.set_direction(i, glm::vec3(tracer_.directions() * direction));
    }
    tracer_.trace(rays_, Misses::escape, count_);
    return true;
  }

  View look(const glm::dvec3& place, std::uint32_t n) {
    View view;
    view.place = place;
    if (!send(place, n, false)) return view;
    std::vector<double> distances;
    double fronts = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (rays_.facet[i] == no_facet) continue;
      distances.push_back(glm::length(point_on_ray(i, 1.0) - place));
      fronts += rays_.behind[i] == 0 ? 1.0 : 0.0;
    }
    if (distances.empty()) return view;
    const auto hits = static_cast<double>(distances.size());
    view.enclosed = 0.5 * (hits / n + enclosed_along_a_floor(n));
    view.fronts = fronts / hits;
    const auto tenth = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 10);
    std::nth_element(distances.begin(), tenth, distances.end());
    view.distance = *tenth;
    // More than enough distance counts a little: of two rooms the larger one, but not all of the outside.
    const double more = std::clamp(view.distance - enough_, 0.0, enough_);
    const double spacious = std::min(view.distance, enough_) + 0.1 * more;
    view.score = view.enclosed * view.enclosed * (1.0 + 2.0 * view.fronts) * spacious;
    return view;
  }

  // The share of the directions close to a plane in which there is a surface: walls all around tell a room without a
  // ceiling from a place beside a house. The plane is that of the axis, of the three, with the highest share, because
  // the room may lie on its side.
  double enclosed_along_a_floor(std::uint32_t n) const {
    constexpr double close = 0.35;  // sine: within 20°
    double highest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      double hits = 0.0;
      double all = 0.0;
      for (std::uint32_t i = 0; i < n; ++i) {
        const glm::dvec3 direction = glm::normalize(tracer_.world_vector(glm::dvec3(rays_.direction(i))));
        if (std::abs(direction[axis]) > close) continue;
        all += 1.0;
        hits += rays_.facet[i] != no_facet ? 1.0 : 0.0;
      }
      if (all > 0.0) highest = std::max(highest, hits / all);
    }
    return highest;
  }

  // Halfway between the surfaces along each axis.
  glm::dvec3 middle_of_space(glm::dvec3 place) {
    if (!send(place, 6, true)) return place;
    for (int k = 0; k < 3; ++k) {
      const auto up = static_cast<std::size_t>(2 * k);
      if (rays_.facet[up] == no_facet || rays_.facet[up + 1] == no_facet) continue;
      place[k] = 0.5 * (point_on_ray(up, 1.0)[k] + point_on_ray(up + 1, 1.0)[k]);
    }
    return place;
  }

  bool is_sure(const View& chosen, const std::vector<View>& views) const {
    constexpr double mostly = 0.6;
    constexpr double about_as_good = 0.8;
    if (chosen.enclosed < mostly || chosen.distance < 0.05 * enough_) return false;
    return std::none_of(views.begin(), views.end(), [&](const View& other) {
      return std::abs(other.fronts - chosen.fronts) > 0.5 && other.score > about_as_good * chosen.score;
    });
  }

  const Room& room_;
  const Tracer& tracer_;
  glm::dvec3 low_;
  glm::dvec3 high_;
  double enough_ = 0.0;
  Rays rays_;
  TraceCount count_;
};

}  // namespace

InsidePoint find_inside(const Room& room, const Tracer& tracer, const glm::dvec3& low, const glm::dvec3& high) {
  return Search(room, tracer, low, high).best();
}

}  // namespace lichtmc
