// The groups of rounds from whose differences the errors of derived figures follow.
#pragma once

#include <cstdint>

namespace lichtmc {

// Rounds are divided into this number of groups, by turns: round r belongs to group r mod 32 (run/jackknife.hpp).
inline constexpr std::uint32_t jackknife_groups = 32;

}  // namespace lichtmc
