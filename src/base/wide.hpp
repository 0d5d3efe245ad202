// 128-bit integers: sums that stay exact in the longest runs.
//
// A batch of 1024 histories with k impacts each scores up to 2¹⁰·k·2²⁴ units (see walk/totals.hpp). Its square in units
// of 2⁻¹⁰ (see chance/moments.hpp) summed over B batches stays below 2¹²⁸ while B·k² < 2⁵⁰: 10¹³ batches for k = 10,
// 10⁷ batches, or 10¹⁴ impacts, for k = 10⁴.
#pragma once

namespace lichtmc {

__extension__ using int128 = __int128;
__extension__ using uint128 = unsigned __int128;

}  // namespace lichtmc
