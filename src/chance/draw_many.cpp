// Philox needs the upper and the lower half of products of 32-bit numbers. Compilers do not generate the instruction
// for it, so this file uses Highway, which also selects the best instruction set of the machine at run time.
#include "chance/draw_many.hpp"

#include <array>

#include "base/lanes.hpp"
#include "chance/philox.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "chance/draw_many.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lichtmc::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

// Machines without vector instructions: one photon at a time.
void DrawMany(const std::array<std::uint32_t, 2>& key, std::size_t n, const std::uint64_t* history,
              std::uint32_t flight, std::uint32_t purpose, std::uint32_t* polar, std::uint32_t* azimuth,
              std::uint64_t* chance) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto words = philox4x32_10(
        {static_cast<std::uint32_t>(history[i]), static_cast<std::uint32_t>(history[i] >> 32), flight, purpose}, key);
    polar[i] = words[0];
    azimuth[i] = words[1];
    chance[i] = std::uint64_t{words[2]} << 32 | words[3];
  }
}

#else

using Tag = hn::ScalableTag<std::uint64_t>;
using Tag32 = hn::Repartition<std::uint32_t, Tag>;
using Lanes = hn::Vec<Tag>;

// Words are in the lower halves of 64-bit lanes; the upper halves are ignored until the end.
HWY_INLINE Lanes Product(Lanes a, Lanes multiplier) {
  const Tag32 d;
  return hn::MulEven(hn::BitCast(d, a), hn::BitCast(d, multiplier));
}

// Counters of several photons; the rounds transform them to random words.
struct Block {
  Lanes c0, c1, c2, c3;

  HWY_INLINE void Begin(const std::uint64_t* history, std::uint32_t flight, std::uint32_t purpose) {
    const Tag d;
    c0 = hn::LoadU(d, history);
    c1 = hn::ShiftRight<32>(c0);
    c2 = hn::Set(d, flight);
    c3 = hn::Set(d, purpose);
  }
  // A round of philox4x32_10() in philox.hpp.
  HWY_INLINE void Round(Lanes key_0, Lanes key_1) {
    const Tag d;
    const Lanes product_0 = Product(c0, hn::Set(d, 0xD2511F53U));
    const Lanes product_1 = Product(c2, hn::Set(d, 0xCD9E8D57U));
    c0 = hn::Xor(hn::ShiftRight<32>(product_1), hn::Xor(c1, key_0));
    c1 = product_1;
    c2 = hn::Xor(hn::ShiftRight<32>(product_0), hn::Xor(c3, key_1));
    c3 = product_0;
  }
  // Words 2 and 3 together.
  HWY_INLINE void StoreChance(std::uint64_t* chance) const {
    const Tag d;
    hn::StoreU(hn::Or(hn::ShiftLeft<32>(c2), hn::And(c3, hn::Set(d, 0xFFFFFFFFU))), d, chance);
  }
};

// The lower halves of the lanes of two blocks, in order.
HWY_INLINE void StoreWords(Lanes first, Lanes second, std::uint32_t* words) {
  const Tag32 d;
  hn::StoreU(hn::ConcatEven(d, hn::BitCast(d, second), hn::BitCast(d, first)), d, words);
}

void DrawMany(const std::array<std::uint32_t, 2>& key, std::size_t n, const std::uint64_t* HWY_RESTRICT history,
              std::uint32_t flight, std::uint32_t purpose, std::uint32_t* HWY_RESTRICT polar,
              std::uint32_t* HWY_RESTRICT azimuth, std::uint64_t* HWY_RESTRICT chance) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  // Two blocks at a time: a round depends on the previous one, but not on the other block.
  static_assert(2 * hn::MaxLanes(Tag()) <= most_lanes);
  // The keys of all rounds, a whole vector each, computed before the loop.
  constexpr std::size_t rounds = 10;
  constexpr std::size_t stride = HWY_MAX_BYTES / sizeof(std::uint64_t);
  HWY_ALIGN std::array<std::uint64_t, 2 * rounds * stride> keys;
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const std::size_t at = std::size_t{2} * round * stride;
    hn::Store(hn::Set(d, key[0] + round * 0x9E3779B9U), d, keys.data() + at);
    hn::Store(hn::Set(d, key[1] + round * 0xBB67AE85U), d, keys.data() + at + stride);
  }
  for (std::size_t i = 0; i < n; i += 2 * lanes) {
    Block a, b;
    a.Begin(history + i, flight, purpose);
    b.Begin(history + i + lanes, flight, purpose);
    for (std::size_t round = 0; round < rounds; ++round) {
      const Lanes k0 = hn::Load(d, keys.data() + 2 * round * stride);
      const Lanes k1 = hn::Load(d, keys.data() + (2 * round + 1) * stride);
      a.Round(k0, k1);
      b.Round(k0, k1);
    }
    StoreWords(a.c0, b.c0, polar + i);
    StoreWords(a.c1, b.c1, azimuth + i);
    a.StoreChance(chance + i);
    b.StoreChance(chance + i + lanes);
  }
}

#endif

}  // namespace lichtmc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lichtmc {

HWY_EXPORT(DrawMany);

void draw_many(const Stream& stream, std::size_t n, const std::uint64_t* history, std::uint32_t flight, Purpose purpose,
               std::uint32_t* polar, std::uint32_t* azimuth, std::uint64_t* chance) {
  HWY_DYNAMIC_DISPATCH(DrawMany)
  (stream.key(), n, history, flight, stream.word_of(purpose), polar, azimuth, chance);
}

}  // namespace lichtmc
#endif
