// Surviving photons move to the positions of those that do not survive, several in each instruction: the set of
// survivors among eight photons is a number from 0 to 255, the index into a table of permutations. Written with
// Highway.
#include "walk/survivors.hpp"

#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walk/survivors.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef LICHTMC_LANE_TABLE
#define LICHTMC_LANE_TABLE
namespace lichtmc {

// For every set of surviving lanes (a bit each): the numbers of these lanes, in order.
template <std::size_t lanes>
constexpr auto ranks_of() {
  std::array<std::uint32_t, lanes << lanes> ranks{};
  for (std::size_t set = 0; set < std::size_t{1} << lanes; ++set) {
    std::size_t kept = 0;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      if ((set >> lane & 1U) != 0) ranks[set * lanes + kept++] = lane;
    }
  }
  return ranks;
}

template <std::size_t lanes>
alignas(64) inline constexpr auto ranks = ranks_of<lanes>();

// The set of the eight photons from i on; those beyond the n-th are not included.
inline std::uint8_t within(std::size_t set, std::size_t i, std::size_t n) {
  return static_cast<std::uint8_t>(n - i < 8 ? set & ((std::size_t{1} << (n - i)) - 1) : set);
}

}  // namespace lichtmc
#endif

HWY_BEFORE_NAMESPACE();
namespace lichtmc::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

// Machines without vectors: one by one.
void ChooseByChance(const Wave& wave, const std::int64_t* survival_of, Survivors& survivors) {
  survivors.count = 0;
  for (std::size_t i = 0; i < wave.rays.size; ++i) {
    const bool survives = static_cast<std::int64_t>(wave.chance[i] >> 11) < survival_of[wave.surface[i]];
    if (i % 8 == 0) survivors.sets[i / 8] = 0;
    survivors.sets[i / 8] = static_cast<std::uint8_t>(survivors.sets[i / 8] | (survives ? 1U : 0U) << (i % 8));
    survivors.count += survives ? 1 : 0;
  }
}

void ListEnded(std::size_t n, Survivors& survivors) {
  std::size_t listed = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    if ((std::size_t{survivors.sets[i / 8]} >> (i % 8) & 1) == 0) survivors.ended_at[listed++] = i;
  }
}

void CompactWave(Wave& wave, const Survivors& survivors) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < wave.rays.size; ++i) {
    if ((std::size_t{survivors.sets[i / 8]} >> (i % 8) & 1) != 0) wave.move(i, kept++);
  }
}

#else

// Eight lanes at most: the table has 256 rows.
using Tag = hn::CappedTag<std::uint32_t, 8>;
using Signed64 = hn::CappedTag<std::int64_t, hn::MaxLanes(Tag()) / 2>;
constexpr std::size_t lanes = hn::MaxLanes(Tag());
constexpr std::size_t lanes_64 = hn::MaxLanes(Signed64());

// The survivors among a vector of photons. All numbers are below 2⁵³.
HWY_INLINE std::size_t ByChance(const std::uint64_t* chance, const std::uint32_t* surface,
                                const std::int64_t* survival_of) {
  const Signed64 d;
  const hn::RebindToUnsigned<Signed64> du;
  const hn::Rebind<std::uint32_t, Signed64> d32;
  const auto counts = hn::BitCast(d, hn::ShiftRight<11>(hn::LoadU(du, chance)));
  const auto on = hn::BitCast(d, hn::PromoteTo(du, hn::LoadU(d32, surface)));
  std::array<std::uint8_t, 8> bits{};
  hn::StoreMaskBits(d, hn::Lt(counts, hn::GatherIndex(d, survival_of, on)), bits.data());
  return bits[0];
}

void ChooseByChance(const Wave& wave, const std::int64_t* survival_of, Survivors& survivors) {
  const std::size_t n = wave.rays.size;
  survivors.count = 0;
  for (std::size_t i = 0; i < n; i += 8) {
    std::size_t set = 0;
    for (std::size_t k = 0; k < 8; k += lanes_64)
      set |= ByChance(&wave.chance[i + k], &wave.surface[i + k], survival_of) << k;
    survivors.sets[i / 8] = within(set, i, n);
    survivors.count += hwy::PopCount(survivors.sets[i / 8]);
  }
}

void ListEnded(std::size_t n, Survivors& survivors) {
  const Tag d;
  std::size_t listed = 0;
  for (std::size_t i = 0; i < n; i += 8) {
    const std::size_t all = within(~std::size_t{survivors.sets[i / 8]}, i, n);
    for (std::size_t k = 0; k < 8; k += lanes) {
      const std::size_t set = all >> k & ((std::size_t{1} << lanes) - 1);
      const auto places =
          hn::Add(hn::Load(d, ranks<lanes>.data() + set * lanes), hn::Set(d, static_cast<std::uint32_t>(i + k)));
      hn::StoreU(places, d, survivors.ended_at.data() + listed);
      listed += hwy::PopCount(set);
    }
  }
}

void CompactWave(Wave& wave, const Survivors& survivors) {
  const Tag d;
  const std::size_t n = wave.rays.size;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; i += lanes) {
    const std::size_t set = survivors.sets[i / 8] >> (i % 8) & ((std::size_t{1} << lanes) - 1);
    const auto ranks_of_set = hn::SetTableIndices(d, ranks<lanes>.data() + set * lanes);
    // A whole vector is stored: the elements after the survivors are overwritten by the next vector.
    const auto move = [&]<class T>(std::vector<T>& array) {
      const hn::Rebind<T, Tag> dt;
      const auto from = hn::BitCast(d, hn::LoadU(dt, array.data() + i));
      hn::StoreU(hn::BitCast(dt, hn::TableLookupLanes(from, ranks_of_set)), dt, array.data() + kept);
    };
    move(wave.photon);
    move(wave.polar);
    move(wave.azimuth);
    move(wave.rays.facet);
    move(wave.rays.s);
    move(wave.rays.t);
    move(wave.rays.behind);
    kept += hwy::PopCount(set);
  }
}

#endif

}  // namespace lichtmc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lichtmc {

HWY_EXPORT(ChooseByChance);
HWY_EXPORT(ListEnded);
HWY_EXPORT(CompactWave);

void choose_survivors(const Wave& wave, const std::int64_t* survival_of, Survivors& survivors) {
  HWY_DYNAMIC_DISPATCH(ChooseByChance)(wave, survival_of, survivors);
}

void choose_marked(const std::uint8_t* marks, std::size_t n, Survivors& survivors) {
  survivors.count = 0;
  for (std::size_t i = 0; i < n; i += 8) {
    std::size_t set = 0;
    for (std::size_t k = 0; k < 8; ++k) set |= std::size_t{marks[i + k]} << k;
    survivors.sets[i / 8] = within(set, i, n);
    survivors.count += static_cast<std::size_t>(std::popcount(survivors.sets[i / 8]));
  }
}

void list_ended(std::size_t n, Survivors& survivors) {
  HWY_DYNAMIC_DISPATCH(ListEnded)(n, survivors);
}

void compact_wave(Wave& wave, const Survivors& survivors) {
  HWY_DYNAMIC_DISPATCH(CompactWave)(wave, survivors);
}

}  // namespace lichtmc
#endif
