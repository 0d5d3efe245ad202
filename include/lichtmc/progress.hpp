// Progress of a run.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

namespace lichtmc {

struct Progress {
  enum class Stage {
    preparation,   // before the walks: `step` says what is done; nothing is counted
    direct_light,  // direct light is integrated; histories and target count tiles or receivers
    pilot,         // short walks for the choice of Estimator::automatic
    tiles,         // walks for the tiles
    receivers,     // walks for the receivers
  };
  Stage stage = Stage::tiles;
  std::string_view step;        // "Laying out tiles", …; empty in other stages
  std::uint64_t histories = 0;  // simulated so far
  std::uint64_t target = 0;     // to simulate if no other stop rule comes first
  std::uint64_t impacts = 0;
  double seconds = 0.0;  // since the walk, or its direct light, began
  // At the last error check; NaN before the first.
  double rms_relative_error = std::numeric_limits<double>::quiet_NaN();
  // Forecast of the time until Settings::target_error is met, in s, from the errors so far; NaN if there
  // is none.
  double seconds_to_target = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace lichtmc
