#include "walk/unreached.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include <glm/geometric.hpp>

#include "base/disjoint_sets.hpp"
#include "base/frame.hpp"
#include "chance/choice.hpp"
#include "chance/places.hpp"
#include "room/triangle_shapes.hpp"
#include "walk/direct_light.hpp"
#include "walk/kernel.hpp"
#include "walk/never_absorbed.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t seed = 20231;  // any: the same room is judged the same each time
constexpr std::uint32_t flights_of_photon = 16;
constexpr std::uint32_t flights_of_walk = 8;  // in closed bodies all of them are flown in vain
constexpr std::uint64_t photon_waves = 8;     // at most: then walks are faster
constexpr std::size_t most_sides = 256;       // that are examined, the largest first; smaller ones count as reached
constexpr std::uint32_t walks_at_a_time = 64;
constexpr std::uint32_t least_rounds = 4;  // 256 walks from each side
constexpr std::uint32_t most_rounds = 64;
constexpr std::uint64_t enough_rays = 200'000;  // after the least rounds
constexpr std::uint32_t enough_lit_walks = 8;   // from a side: then no more are sent from it
// Of the walks from sides that are judged together, the share that sees light must exceed this: openings of less than
// some 10⁻⁵ of the area of what encloses a dark space, at each of 8 flights, are cracks between meshes.
constexpr double least_share = 1e-4;
constexpr std::uint32_t no_side = 0xFFFFFFFF;

// The side of a patch that the front of each facet belongs to; that of its back is the same XOR 1.
std::vector<std::uint32_t> sides_of_facets(const Room& room, const FacePatches& patches, const Tracer& tracer) {
  std::vector<std::uint32_t> sides(tracer.facets().size(), 0);
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    for (std::size_t n = 0; n < room.surfaces[k].triangles.size(); ++n)
      sides[tracer.locate(k, n).facet] = patches.side_of(k, n, false);
  }
  return sides;
}

// Goal: which sides photons hit.
class SidesHit : public GoalBase {
 public:
  SidesHit(const Scene& scene, const Stream& stream, const std::vector<std::uint32_t>& side_of_facet, std::size_t sides)
      : scene_(scene), stream_(stream), side_of_facet_(side_of_facet), hit_(sides, false) {}

  void begin(std::uint64_t first_history) { first_history_ = first_history; }
  void start(Wave& wave, std::uint32_t n) {
    scene_.launcher->launch_all(stream_, first_history_, n, wave.rays, wave.photon.data());
  }
  Misses misses() const { return scene_.misses; }
  void land(const Wave& wave) {
    for (std::size_t i = 0; i < wave.rays.size; ++i)
      hit_[side_of_facet_[wave.rays.facet[i]] ^ wave.rays.behind[i]] = true;
  }

  const std::vector<bool>& hit() const { return hit_; }

 private:
  const Scene& scene_;
  const Stream& stream_;
  const std::vector<std::uint32_t>& side_of_facet_;
  std::vector<bool> hit_;
};

// Light goes on wherever something reflects.
struct ReflectsPolicy {
  static bool survive(double reflectance, double /*chance*/, double& /*weight*/, Ends& /*ends*/) {
    return reflectance > 0.0;
  }
};

// Sides that are judged together, and the walks from them.
class SideSets {
 public:
  explicit SideSets(std::size_t n) : sets_(n), walks_(n), lit_walks_(n) {}

  void join(std::uint32_t a, std::uint32_t b) { sets_.join(a, b); }
  void count_walk(std::uint32_t k) { ++walks_[k]; }
  void count_lit_walk(std::uint32_t k) { ++lit_walks_[k]; }
  bool surely_lit(std::uint32_t k) const { return lit_walks_[k] >= enough_lit_walks; }

  // Of each side, whether light reaches its set.
  std::vector<bool> lit() {
    std::vector<double> walks(walks_.size(), 0.0);
    std::vector<double> lit_walks(walks_.size(), 0.0);
    for (std::uint32_t k = 0; k < walks_.size(); ++k) {
      walks[sets_.find(k)] += walks_[k];
      lit_walks[sets_.find(k)] += lit_walks_[k];
    }
    std::vector<bool> lit;
    for (std::uint32_t k = 0; k < walks_.size(); ++k)
      lit.push_back(lit_walks[sets_.find(k)] > least_share * walks[sets_.find(k)]);
    return lit;
  }

 private:
  DisjointSets<std::uint32_t> sets_;
  std::vector<std::uint32_t> walks_;
  std::vector<std::uint32_t> lit_walks_;
};

// A side of a patch, as origin of walks.
struct DarkSide {
  std::uint32_t side = 0;
  std::vector<RoomFace> faces;
  std::vector<double> areas_up_to;  // for choose()
};

// Goal: walks backward from dark sides; which sets of them see light.
class DarkWalks : public GoalBase {
 public:
  DarkWalks(const Room& room, const Scene& scene, const FacePatches& patches,
            const std::vector<std::uint32_t>& side_of_facet, const std::vector<DarkSide>& dark, const Stream& stream)
      : room_(room),
        scene_(scene),
        patches_(patches),
        side_of_facet_(side_of_facet),
        dark_(dark),
        stream_(stream),
        light_(room, *scene.tracer),
        sets_(dark.size()),
        number_of_side_(2 * patches.size(), no_side),
        origin_(batch_histories),
        last_(batch_histories),
        lit_(batch_histories) {
    for (std::uint32_t n = 0; n < dark.size(); ++n) number_of_side_[dark[n].side] = n;
  }

  // Photon i of the next wave will start from a dark side.
  void prepare(std::uint32_t i, std::uint32_t origin) { origin_[i] = origin; }
  void begin(std::uint64_t first_history) { first_history_ = first_history; }
  bool surely_lit(std::uint32_t dark) const { return sets_.surely_lit(dark); }
  std::vector<bool> lit() { return sets_.lit(); }

  void start(Wave& wave, std::uint32_t n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const ReferencePoint reference = place(wave.rays, i);
      last_[i] = origin_[i];
      lit_[i] = false;
      sets_.count_walk(origin_[i]);
      // Places that another face in their plane covers are dark.
      const FacesInOnePlane* planes = scene_.tracer->faces_in_one_plane();
      const FacePlace place_here{wave.rays.facet[i], double{wave.rays.s[i]}, double{wave.rays.t[i]},
                                 wave.rays.behind[i] != 0};
      if (planes == nullptr || planes->counts(place_here))
        look_for_light(i, 0, glm::vec3(start_of(reference, *scene_.tracer)), reference);
      const Words words = stream_.draw(first_history_ + i, 0, Purpose::emission);
      const ConeDirection flight =
          sample_cosine_cone(frame_about(reference.normal), 1.0, unit_open(words[0]), unit_open(words[1]));
      wave.rays.set_direction(i, glm::vec3(scene_.tracer->directions() * flight.direction));
    }
  }

  void land(const Wave& wave) {
    const Rays& rays = wave.rays;
    for (std::size_t i = 0; i < rays.size; ++i) {
      const std::uint32_t photon = wave.photon[i];
      if (rays.behind[i] == 0 && light_.is_area_light(scene_.surface_of[rays.facet[i]])) found(photon);
      const std::uint32_t here = number_of_side_[side_of_facet_[rays.facet[i]] ^ rays.behind[i]];
      // A flight between two dark sides is a path of light between them, in either direction. Over another side the
      // walk goes on, but what it meets then is not judged with what was before.
      if (here != no_side && last_[photon] != no_side) sets_.join(here, last_[photon]);
      last_[photon] = here;
    }
  }

  void reflect(const Wave& wave, std::uint32_t flight) {
    const Tracer& tracer = *scene_.tracer;
    for (std::size_t i = 0; i < wave.rays.size; ++i) {
      const glm::vec3 start = wave.rays.start(i);
      look_for_light(wave.photon[i], flight, start,
                     {tracer.world_point(glm::dvec3(start)), hit_normal(tracer, wave.rays, i), 0.0, {}, {}});
    }
  }

 private:
  // A point uniform over the photon's dark side.
  ReferencePoint place(Rays& rays, std::uint32_t i) const {
    const DarkSide& dark = dark_[origin_[i]];
    const Words words = stream_.draw(first_history_ + i, 0, Purpose::place);
    const Words which = stream_.draw(first_history_ + i, 1, Purpose::place);
    const RoomFace& face = dark.faces[choose(dark.areas_up_to, unit_fine(which[0], which[1]))];
    const glm::dvec2 weights = uniform_on_triangle(unit_open(words[0]), unit_open(words[1]));
    const TriangleOnFacet facet = scene_.tracer->locate(face.surface, face.triangle);
    const glm::vec2 st =
        facet.st_0 + static_cast<float>(weights.x) * facet.st_1 + static_cast<float>(weights.y) * facet.st_2;
    const bool behind = patches_.side_of(face.surface, face.triangle, false) != dark.side;
    rays.facet[i] = facet.facet;
    rays.s[i] = st.x;
    rays.t[i] = st.y;
    rays.behind[i] = behind ? 1 : 0;
    const Surface& surface = room_.surfaces[face.surface];
    const glm::uvec3 corner = surface.triangles[face.triangle];
    const glm::dvec3 normal = world_normal(*scene_.tracer, scene_.tracer->facets()[facet.facet]);
    return {point_of_triangle(surface.positions[corner.x], surface.positions[corner.y], surface.positions[corner.z],
                              weights),
            behind ? -normal : normal,
            0.0,
            {},
            {}};
  }

  void look_for_light(std::uint32_t photon, std::uint32_t flight, const glm::vec3& start,
                      const ReferencePoint& reference) {
    if (lit_[photon]) return;
    for (std::size_t k = 0; k < light_.light_samples_per_point(); ++k) {
      const auto number = static_cast<std::uint32_t>(flight * light_.light_samples_per_point() + k);
      const Words which = stream_.draw(first_history_ + photon, number, Purpose::light);
      const Words where = stream_.draw(first_history_ + photon, number, Purpose::on_light);
      const LightSample sample = light_.sample_light(k, light_.cell_of(reference), reference, which, where);
      if (!(sample.irradiance > 0.0)) continue;
      const auto segment = shadow_segment(*scene_.tracer, glm::dvec3(start), sample.target);
      if (!segment || !scene_.tracer->is_blocked(start, *segment, traced())) return found(photon);
    }
  }

  void found(std::uint32_t photon) {
    if (!lit_[photon]) sets_.count_lit_walk(origin_[photon]);
    lit_[photon] = true;
  }

  const Room& room_;
  const Scene& scene_;
  const FacePatches& patches_;
  const std::vector<std::uint32_t>& side_of_facet_;
  const std::vector<DarkSide>& dark_;
  const Stream& stream_;
  DirectLight light_;
  SideSets sets_;
  std::vector<std::uint32_t> number_of_side_;  // in dark_, or no_side
  // By photon:
  std::vector<std::uint32_t> origin_;
  std::vector<std::uint32_t> last_;  // the dark side that it left last, or no_side
  std::vector<bool> lit_;            // it has seen light
};

// Calls use(kernel) with the kernel of a goal for the scene's reflectances.
template <class Policy, class Goal, class Use>
void with_kernel(const Scene& scene, const Stream& stream, std::uint32_t flights, const Use& use) {
  if (scene.has_reflectance_maps()) {
    Kernel<Policy, MappedReflectance, Goal> kernel(scene, stream, flights);
    use(kernel);
  } else {
    Kernel<Policy, SurfaceReflectance, Goal> kernel(scene, stream, flights);
    use(kernel);
  }
}

// One search through a room.
class Search {
 public:
  Search(const Room& room, const Scene& scene, const FacePatches& patches)
      : room_(room),
        scene_(scene),
        patches_(patches),
        side_of_facet_(sides_of_facets(room, patches, *scene.tracer)),
        hit_(2 * patches.size(), false) {}

  // By side of a patch: whether no light reaches it.
  std::vector<bool> unreached() {
    send_photons();
    const std::vector<DarkSide> dark = dark_sides();
    std::vector<bool> unreached(2 * patches_.size(), false);
    if (dark.empty()) return {};
    const std::vector<bool> lit = walk_from(dark);
    for (std::size_t n = 0; n < dark.size(); ++n) unreached[dark[n].side] = !lit[n];
    bool any = false;
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      if (!two_maps(p)) unreached[2 * p] = unreached[2 * p + 1] = unreached[2 * p] && unreached[2 * p + 1];
      any = any || unreached[2 * p] || unreached[2 * p + 1];
    }
    return any ? unreached : std::vector<bool>{};
  }

 private:
  bool two_maps(std::size_t patch) const { return room_.surfaces[patches_.surface(patch)].sides == Sides::both; }
  bool in_question(std::uint32_t side) const {
    const std::size_t patch = side / 2;
    return patches_.area_m2(patch) > 0.0 && !hit_[side] && (two_maps(patch) || !hit_[side ^ 1U]);
  }

  void send_photons() {
    const Stream stream(seed);
    SidesHit goal(scene_, stream, side_of_facet_, hit_.size());
    with_kernel<ReflectsPolicy, SidesHit>(scene_, stream, flights_of_photon, [&](auto& kernel) {
      for (std::uint64_t wave = 0; wave < photon_waves; ++wave) {
        goal.begin(wave * batch_histories);
        kernel.fly(batch_histories, goal, [] { return false; });
        hit_ = goal.hit();
        bool question = false;
        for (std::uint32_t side = 0; side < hit_.size() && !question; ++side) question = in_question(side);
        if (!question) return;
      }
    });
  }

  // The sides in question, the largest first.
  std::vector<DarkSide> dark_sides() const {
    std::vector<std::uint32_t> sides;
    for (std::uint32_t side = 0; side < hit_.size(); ++side) {
      if (in_question(side)) sides.push_back(side);
    }
    std::stable_sort(sides.begin(), sides.end(), [this](std::uint32_t a, std::uint32_t b) {
      return patches_.area_m2(a / 2) > patches_.area_m2(b / 2);
    });
    // Both sides of a patch, or none.
    if (sides.size() > most_sides) {
      const std::ptrdiff_t kept = most_sides - (sides[most_sides - 1] / 2 == sides[most_sides] / 2 ? 1 : 0);
      sides.erase(sides.begin() + kept, sides.end());
    }
    if (sides.empty()) return {};
    std::vector<std::vector<RoomFace>> faces = patches_.triangles();
    std::vector<std::vector<TriangleShape>> shapes(room_.surfaces.size());
    std::vector<DarkSide> dark;
    for (const std::uint32_t side : sides) {
      std::vector<TriangleShape>& of = shapes[patches_.surface(side / 2)];
      if (of.empty()) of = triangle_shapes(room_.surfaces[patches_.surface(side / 2)]);
      std::vector<double> areas;
      for (const RoomFace& face : faces[side / 2]) areas.push_back(of[face.triangle].area_m2);
      dark.push_back({side, faces[side / 2], cumulative(areas)});
    }
    return dark;
  }

  std::vector<bool> walk_from(const std::vector<DarkSide>& dark) const {
    const Stream stream(seed, WalkDirection::backward);
    DarkWalks goal(room_, scene_, patches_, side_of_facet_, dark, stream);
    with_kernel<ReflectsPolicy, DarkWalks>(scene_, stream, flights_of_walk, [&](auto& kernel) {
      std::uint64_t walks = 0;
      std::uint32_t n = 0;
      const auto fly = [&] {
        goal.begin(walks);
        kernel.fly(n, goal, [] { return false; });
        walks += n;
        n = 0;
      };
      for (std::uint32_t round = 0; round < most_rounds; ++round) {
        if (round >= least_rounds && goal.traced().rays > enough_rays) break;
        for (std::uint32_t k = 0; k < dark.size(); ++k) {
          if (goal.surely_lit(k)) continue;
          for (std::uint32_t walk = 0; walk < walks_at_a_time; ++walk) goal.prepare(n++, k);
          if (n == batch_histories) fly();
        }
        if (n > 0) fly();
      }
    });
    return goal.lit();
  }

  const Room& room_;
  const Scene& scene_;
  const FacePatches& patches_;
  std::vector<std::uint32_t> side_of_facet_;
  std::vector<bool> hit_;  // by side of a patch
};

// In a convex room light reaches the side of every face that faces the room.
bool all_reached(const Room& room, const Scene& scene) {
  if (scene.tracer->casts_shadows()) return false;
  return std::all_of(room.surfaces.begin(), room.surfaces.end(),
                     [](const Surface& surface) { return surface.sides == Sides::one; });
}

}  // namespace

UnreachedSides::UnreachedSides(const Room& room, const Tiling& tiling, const Scene& scene)
    : patches_(all_reached(room, scene) ? Room{} : room) {
  if (patches_.size() == 0) return;
  // The closed form of the cuboid knows no outside.
  std::unique_ptr<Scene> own;
  if (scene.engine == Engine::cuboid) own = std::make_unique<Scene>(room, tiling, Engine::embree);
  unreached_ = Search(room, own ? *own : scene, patches_).unreached();
}

}  // namespace lichtmc
