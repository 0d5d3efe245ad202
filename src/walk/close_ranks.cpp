// Photons that survive move up to the places of those that do not, several in each instruction: which lanes of a vector
// survive is a number, and a table says for each such number where the lanes go.
#include <array>
#include <cstdint>

#include "walk/wave.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walk/close_ranks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef LICHTMC_RANKS
#define LICHTMC_RANKS
namespace lichtmc {

// For every set of survivors among some lanes, bit by bit: their numbers, in order.
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

}  // namespace lichtmc
#endif

HWY_BEFORE_NAMESPACE();
namespace lichtmc::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

// Machines without vectors: every photon moves to the next place, which the one after it takes if it was absorbed.
std::size_t CloseRanks(Wave& wave, const std::int64_t* survival_of_facet) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < wave.rays.size; ++i) {
    const bool survives = static_cast<std::int64_t>(wave.chance[i] >> 11) < survival_of_facet[wave.rays.facet[i]];
    wave.move(i, kept);
    kept += survives ? 1 : 0;
  }
  return kept;
}

#else

// Eight lanes at most: the table has 256 rows.
using Tag = hn::CappedTag<std::uint32_t, 8>;
using Signed64 = hn::CappedTag<std::int64_t, hn::MaxLanes(Tag()) / 2>;
constexpr std::size_t lanes = hn::MaxLanes(Tag());

// Bit by bit which of half as many photons as there are lanes survive. All numbers are below 2⁵³.
HWY_INLINE std::size_t Survivors(const std::uint64_t* chance, const std::uint32_t* facet,
                                 const std::int64_t* survival_of_facet) {
  const Signed64 d;
  const hn::RebindToUnsigned<Signed64> du;
  const hn::Rebind<std::uint32_t, Signed64> d32;
  const auto counts = hn::BitCast(d, hn::ShiftRight<11>(hn::LoadU(du, chance)));
  const auto on = hn::BitCast(d, hn::PromoteTo(du, hn::LoadU(d32, facet)));
  std::array<std::uint8_t, 8> bits{};
  hn::StoreMaskBits(d, hn::Lt(counts, hn::GatherIndex(d, survival_of_facet, on)), bits.data());
  return bits[0];
}

std::size_t CloseRanks(Wave& wave, const std::int64_t* survival_of_facet) {
  const Tag d;
  const std::size_t n = wave.rays.size;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; i += lanes) {
    std::size_t set = Survivors(&wave.chance[i], &wave.rays.facet[i], survival_of_facet) |
                      Survivors(&wave.chance[i + lanes / 2], &wave.rays.facet[i + lanes / 2], survival_of_facet) << (lanes / 2);
    if (n - i < lanes) set &= (std::size_t{1} << (n - i)) - 1;
    const auto ranks_of_set = hn::SetTableIndices(d, ranks<lanes>.data() + set * lanes);
    // A whole vector is stored: what it holds beyond the survivors is overwritten by the next one's.
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
  return kept;
}

#endif

}  // namespace lichtmc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lichtmc {

HWY_EXPORT(CloseRanks);

std::size_t close_ranks(Wave& wave, const std::int64_t* survival_of_facet) {
  return HWY_DYNAMIC_DISPATCH(CloseRanks)(wave, survival_of_facet);
}

}  // namespace lichtmc
#endif
