// Plain loops that run in lanes: compiled for several instruction sets, of which the machine's best is taken when the
// program starts.
//
// LICHTMC_LANES stands before a function that holds a loop over arrays without branches, pointers marked
// LICHTMC_APART (they do not overlap). Contraction is off, so that all variants give the same bits.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define LICHTMC_LANES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define LICHTMC_LANES
#endif
#define LICHTMC_APART __restrict__
