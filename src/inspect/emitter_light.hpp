// What becomes of the light of each emitter: where it is absorbed, seen from where it started.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/inspect.hpp"
#include "lichtmc/room.hpp"
#include "walk/scene.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

// Follows the photons of a walk in which none is absorbed. Each carries a weight, the product of the reflectances of
// its impacts; the part 1 − ρ of it counts as absorbed at an impact.
class EmitterLight {
 public:
  EmitterLight(const Room& room, const Scene& scene, const glm::dvec3& low, const glm::dvec3& high);

  // Photon `photon` of the wave is one of emitter `emitter`.
  void start(std::uint32_t photon, std::size_t emitter);
  // The flights of a wave have landed.
  void land(const Wave& wave);

  // Of each emitter with enough photons, see Inspection::emitters.
  std::vector<EmitterFacts> facts(const Room& room) const;

 private:
  struct Sums {
    std::uint64_t photons = 0;
    std::uint64_t first_behind = 0;  // first impacts on the back of a face
    double near = 0.0;               // weight absorbed
    double about = 0.0;
    double wide = 0.0;
    double itself = 0.0;
    double level = 0.0;
  };
  struct Photon {
    std::uint32_t emitter = 0;
    double weight = 1.0;
    bool started = false;
    glm::dvec3 start{0.0};
  };

  void absorb(Photon& photon, const glm::dvec3& end, std::uint32_t surface, double reflectance);

  const Scene& scene_;
  double near_m_ = 0.0;
  double about_m_ = 0.0;
  double wide_m_ = 0.0;
  double level_m_ = 0.0;
  std::vector<Photon> photons_;
  std::vector<std::uint32_t> own_surface_;  // of each emitter, if it is an area light smaller than half of the room
  std::vector<Sums> sums_;                  // of each emitter
  std::unordered_map<std::uint64_t, std::uint32_t> first_on_;  // first impacts by emitter and surface
};

}  // namespace lichtmc
