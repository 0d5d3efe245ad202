// Plain loops that the compiler vectorises: each is compiled for several instruction sets, and the program selects the
// best of the machine when it starts.
//
// LICHTMC_LANES marks a function with a loop over arrays without branches; LICHTMC_APART marks pointers to arrays that
// do not overlap. Contraction (fused multiply-add) is off, so that all variants give the same bits.
//
// The arrays of such loops have whole_lanes(n) elements for a length of n: a loop that computes some elements too many
// needs no second loop for the last ones.
#pragma once

#include <cstddef>

// The variants are selected before sanitizers are initialised.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define LICHTMC_LANES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define LICHTMC_LANES
#endif
#define LICHTMC_APART __restrict__

namespace lichtmc {

// Number of 32-bit numbers in the longest vector register.
inline constexpr std::size_t most_lanes = 16;

constexpr std::size_t whole_lanes(std::size_t n) {
  return (n + most_lanes - 1) / most_lanes * most_lanes;
}

}  // namespace lichtmc
