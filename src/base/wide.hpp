// Integers of 128 bits: sums that stay exact over the longest run.
//
// A tally counts in units of 2⁻³² of a score. 10¹² histories of 10⁴ impacts each reach 2⁸⁵ units; squares of a batch's
// sum reach 2¹²⁰. Both are beyond 64 bits.
#pragma once

namespace lichtmc {

__extension__ using int128 = __int128;
__extension__ using uint128 = unsigned __int128;

}  // namespace lichtmc
