#include "run/collectives.hpp"

#include <array>
#include <bit>

namespace lichtmc {

namespace {

static_assert(std::endian::native == std::endian::little, "integers of 128 bits are sent low word first");
static_assert(sizeof(Moments) == 4 * sizeof(std::uint64_t) && sizeof(BackwardSums) == 4 * sizeof(std::uint64_t));

template <class Thing>
std::span<std::uint64_t> words_of(Thing* things, std::size_t n) {
  return {reinterpret_cast<std::uint64_t*>(things), n * sizeof(Thing) / sizeof(std::uint64_t)};
}

void add_words(Communicator& communicator, std::initializer_list<std::uint64_t*> values) {
  std::vector<std::uint64_t> words;
  for (const std::uint64_t* value : values) words.push_back(*value);
  communicator.sum(words);
  std::size_t k = 0;
  for (std::uint64_t* value : values) *value = words[k++];
}

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

void reduce(Communicator* communicator, Totals& totals) {
  if (communicator == nullptr) return;
  Ends& ends = totals.ends;
  add_words(*communicator, {&totals.histories, &totals.impacts, &totals.traced.rays, &totals.traced.retraced,
                            &totals.traced.shadow_rays, &ends.lost_histories});
  std::array<int128, 4> ended{ends.absorbed, ends.escaped, ends.residual, ends.lost};
  communicator->sum_wide(words_of(ended.data(), ended.size()));
  ends.absorbed = ended[0];
  ends.escaped = ended[1];
  ends.residual = ended[2];
  ends.lost = ended[3];
  communicator->sum_wide(words_of(&totals.incident, 1));
  communicator->sum_wide(words_of(totals.tiles.data(), totals.tiles.size()));
  communicator->sum_wide(words_of(totals.maps.data(), totals.maps.size()));
  communicator->sum_wide(words_of(totals.behind.data(), totals.behind.size()));
  if (!totals.hits.empty()) communicator->sum(totals.hits);
}

void reduce(Communicator* communicator, std::vector<BackwardSums>& sums) {
  if (communicator != nullptr) communicator->sum_wide(words_of(sums.data(), sums.size()));
}

void reduce(Communicator* communicator, BackwardCount& count) {
  if (communicator == nullptr) return;
  add_words(*communicator, {&count.impacts, &count.traced.rays, &count.traced.retraced, &count.traced.shadow_rays});
}

void combine(Communicator* communicator, std::vector<DirectIrradiance>& things) {
  static_assert(sizeof(DirectIrradiance) == 2 * sizeof(double) && std::is_trivially_copyable_v<DirectIrradiance>);
  if (communicator != nullptr) communicator->sum(words_of(things.data(), things.size()));
}

}  // namespace lichtmc
