// Where the light of luminaires with photometric files lands first: in their own housings, or so near that the size of
// their openings matters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/inspect.hpp"
#include "lichtmc/photometry.hpp"
#include "lichtmc/room.hpp"
#include "walk/scene.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

// Follows the first flights of photons of a wave.
class LuminaireLight {
 public:
  LuminaireLight(const Room& room, const Scene& scene);

  // Photon `photon` of the wave is one of emitter `emitter`.
  void start(std::uint32_t photon, std::size_t emitter);
  // The flights of a wave have landed.
  void land(const Wave& wave);

  // Of each photometric file, see Inspection::luminaires.
  std::vector<LuminaireFacts> facts() const;

 private:
  // A luminaire whose first flights count.
  struct Lamp {
    const Photometry* photometry = nullptr;  // null: the emitter is none
    glm::dvec3 position{0.0};
    LuminaireAxes axes;
    std::size_t file = 0;    // index into facts_
    double housing_m = 0.0;  // what is no farther from its centre may be its housing
    bool sizeless = false;   // a point, although the file states its opening
    std::uint64_t photons = 0;
    std::uint64_t in_housing = 0;
    std::uint64_t near = 0;
  };
  // A place where light of a luminaire lands that is a point.
  struct Place {
    std::size_t emitter = 0;
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0};
  };

  // Without shadows and without flux: I cos θ / r², I the candela of the table; the mean over starts all over the
  // opening, by the midpoints of equal parts.
  static double light_of_point(const Lamp& lamp, const glm::dvec3& start, const glm::dvec3& point,
                               const glm::dvec3& normal);
  static double light_of_opening(const Lamp& lamp, const glm::dvec3& point, const glm::dvec3& normal, int steps);

  static bool is_beside_opening(const glm::dvec3& point, const Lamp& lamp, const LuminousOpening& opening);
  void list_files();
  void find_nearest_receivers(std::vector<LuminaireFacts>& facts) const;

  const Room& room_;
  const Scene& scene_;
  std::vector<LuminaireFacts> facts_;       // per file: what does not depend on photons
  std::vector<Lamp> lamps_;                 // per emitter; empty if no emitter has a file
  std::vector<double> longest_edge_;        // per surface: median over its triangles of the longest edge, m
  std::vector<std::uint32_t> emitter_of_;   // per photon of a wave that has not landed yet; no_emitter: it has
  std::vector<std::vector<Place>> places_;  // per file
};

}  // namespace lichtmc
