// Direct light of a living room's tiles, against the way before it was sampled in strata within a budget.
#pragma once

#include <cstdint>
#include <memory>

namespace lichtmc::bench {

class DirectStage {
 public:
  // scenes/living_room.glb, whose lamps have shades, tiles of 0.26 m, to a target error of 2 %.
  DirectStage();
  DirectStage(const DirectStage&) = delete;
  DirectStage& operator=(const DirectStage&) = delete;
  ~DirectStage();

  // All faces, with what is prepared for them; returns their number.
  double all();
  // An eighth of them by the plain way, a different one each time; returns their number.
  double plain_eighth();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace lichtmc::bench
