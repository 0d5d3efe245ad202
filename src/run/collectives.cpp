#include "run/collectives.hpp"

#include <algorithm>
#include <bit>

namespace lichtmc {

namespace {

static_assert(std::endian::native == std::endian::little, "integers of 128 bits are sent low word first");

}  // namespace

std::uint64_t count_votes(Communicator* communicator, bool mine) {
  std::uint64_t votes = mine ? 1 : 0;
  if (communicator != nullptr) communicator->sum(std::span(&votes, 1));
  return votes;
}

Part part_of(const Communicator* communicator, std::uint64_t n) {
  const auto at = [&](unsigned rank) {
    return static_cast<std::uint64_t>(static_cast<uint128>(n) * rank / size_of(communicator));
  };
  return {at(rank_of(communicator)), at(rank_of(communicator) + 1)};
}

void Reduction::finish() {
  std::vector<std::uint64_t> words;
  for (const std::uint64_t* number : words_) words.push_back(*number);
  if (!words.empty()) communicator_.sum(words);
  for (std::size_t k = 0; k < words.size(); ++k) *words_[k] = words[k];
  words.clear();
  for (const std::uint64_t* number : wide_) words.insert(words.end(), number, number + 2);
  if (!words.empty()) communicator_.sum_wide(words);
  for (std::size_t k = 0; k < wide_.size(); ++k) std::copy_n(&words[2 * k], 2, wide_[k]);
}

// Sums are the only operation of communicators: each rank writes its list into its own part of a longer one.
void Reduction::add(std::vector<Earliest>& list) {
  if (list.empty()) return;
  std::vector<std::uint64_t> all(list.size() * communicator_.size(), 0);
  for (std::size_t k = 0; k < list.size(); ++k) all[communicator_.rank() * list.size() + k] = list[k].bits;
  communicator_.sum(all);
  for (std::size_t k = 0; k < all.size(); ++k) list[k % list.size()] += Earliest{all[k]};
}

void combine(Communicator* communicator, std::vector<DirectIrradiance>& things) {
  static_assert(sizeof(DirectIrradiance) == 2 * sizeof(double) && std::is_trivially_copyable_v<DirectIrradiance>);
  if (communicator != nullptr) communicator->sum({reinterpret_cast<std::uint64_t*>(things.data()), 2 * things.size()});
}

}  // namespace lichtmc
