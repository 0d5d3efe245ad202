// The parts that groups of emitters have in the light of each receiver: sums over rounds. Integers, so that the order
// does not matter; the score of a round is the sum of its parts, to the last unit.
//
// Areas need them even if there is one part only: the error of a mean over points follows from the differences between
// groups of rounds, because photons serve many points at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/fields.hpp"
#include "base/wide.hpp"
#include "walk/jackknife_groups.hpp"

namespace lichtmc {

struct PartSums {
  std::vector<uint128> of_groups;  // [receiver][part][group of rounds]: sums of scores
  std::vector<uint128> products;   // [receiver][pair of parts]: of scores of the same round; none if there is one part

  PartSums() = default;
  PartSums(std::size_t receivers, std::uint32_t parts) {
    of_groups.resize(receivers * parts * jackknife_groups);
    if (parts > 1) products.resize(receivers * pairs(parts));
  }

  static std::size_t pairs(std::size_t parts) { return parts * (parts + 1) / 2; }
  // The pair of the parts i and j ≤ i.
  static std::size_t pair(std::size_t i, std::size_t j) { return i * (i + 1) / 2 + j; }

  bool has_size_of(const PartSums& other) const {
    return of_groups.size() == other.of_groups.size() && products.size() == other.products.size();
  }

  // Adds the scores of the parts of a round of a receiver.
  void add(std::size_t receiver, std::uint64_t round, const std::uint64_t* scores, std::uint32_t parts) {
    uint128* groups = of_groups.data() + receiver * parts * jackknife_groups + round % jackknife_groups;
    for (std::uint32_t i = 0; i < parts; ++i) groups[i * jackknife_groups] += scores[i];
    if (parts == 1) return;
    uint128* of_pairs = products.data() + receiver * pairs(parts);
    for (std::size_t i = 0; i < parts; ++i) {
      if (scores[i] == 0) continue;
      for (std::size_t j = 0; j <= i; ++j) of_pairs[pair(i, j)] += static_cast<uint128>(scores[i]) * scores[j];
    }
  }

  // Adds the sums of some receivers to those of all, of which `first` is the first of these, and clears them.
  void move_to(PartSums& all, std::size_t first, std::uint32_t parts) {
    move_some(of_groups, all.of_groups, first * parts * jackknife_groups);
    if (parts > 1) move_some(products, all.products, first * pairs(parts));
  }

 private:
  static void move_some(std::vector<uint128>& from, std::vector<uint128>& to, std::size_t first) {
    for (std::size_t k = 0; k < from.size(); ++k) to[first + k] += from[k];
    std::fill(from.begin(), from.end(), uint128{0});
  }
};

template <class F, AllOf<PartSums>... Things>
void visit_fields(const F& f, Things&... sums) {
  f(Field{"of_groups"}, sums.of_groups...);
  f(Field{"products"}, sums.products...);
}

}  // namespace lichtmc
