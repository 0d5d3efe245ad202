// Plain loops that run in lanes: compiled for several instruction sets, of which the machine's best is taken when the
// program starts.
//
// LICHTMC_LANES stands before a function that holds a loop over arrays without branches, pointers marked
// LICHTMC_APART (they do not overlap). Contraction is off, so that all variants give the same bits.
//
// Arrays that such loops run over reach to whole_lanes() of their length: a loop that computes some elements too many
// needs no second one for the last few.
#pragma once

#include <cstddef>

// Sanitizers are not there yet when the variants are chosen.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define LICHTMC_LANES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define LICHTMC_LANES
#endif
#define LICHTMC_APART __restrict__

namespace lichtmc {

// The longest vectors hold so many 32-bit numbers.
inline constexpr std::size_t most_lanes = 16;

constexpr std::size_t whole_lanes(std::size_t n) {
  return (n + most_lanes - 1) / most_lanes * most_lanes;
}

}  // namespace lichtmc
