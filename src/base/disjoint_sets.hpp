// Disjoint sets of the numbers 0 … n − 1, which are joined two by two.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lichtmc {

// With path halving (R. Tarjan, Efficiency of a Good But Not Linear Set Union Algorithm, 1975).
template <std::unsigned_integral Index>
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  // The smallest number of the set of k.
  Index find(Index k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(Index a, Index b) {
    const Index first = find(a);
    const Index second = find(b);
    parent_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace lichtmc
