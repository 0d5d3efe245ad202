// Philox needs the upper and the lower half of products of 32-bit numbers, which compilers do not find the instruction
// for: it is written with Highway, which also takes the best instruction set of the machine when the program runs.
#include "chance/draw_many.hpp"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "chance/draw_many.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lichtmc::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<std::uint64_t>;
using Lanes = hn::Vec<Tag>;

// Words live in the lower halves of 64-bit lanes; what is in the upper halves does no harm until the end.
HWY_INLINE Lanes Product(Lanes a, std::uint32_t multiplier) {
  const Tag d;
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(d, (hn::GetLane(a) & 0xFFFFFFFFU) * multiplier);
#else
  const hn::Repartition<std::uint32_t, Tag> d32;
  return hn::MulEven(hn::BitCast(d32, a), hn::BitCast(d32, hn::Set(d, multiplier)));
#endif
}

// Counters of some photons on their way to being random words.
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
    const Lanes product_0 = Product(c0, 0xD2511F53U);
    const Lanes product_1 = Product(c2, 0xCD9E8D57U);
    c0 = hn::Xor(hn::ShiftRight<32>(product_1), hn::Xor(c1, key_0));
    c1 = product_1;
    c2 = hn::Xor(hn::ShiftRight<32>(product_0), hn::Xor(c3, key_1));
    c3 = product_0;
  }
  HWY_INLINE void End(std::uint64_t* polar_azimuth, std::uint64_t* chance) const {
    const Tag d;
    const Lanes lower = hn::Set(d, 0xFFFFFFFFU);
    hn::StoreU(hn::Or(hn::And(c0, lower), hn::ShiftLeft<32>(c1)), d, polar_azimuth);
    hn::StoreU(hn::Or(hn::ShiftLeft<32>(c2), hn::And(c3, lower)), d, chance);
  }
};

// Two blocks at a time: a round waits for the one before, another block need not.
constexpr std::size_t blocks = 2;

void DrawMany(const std::array<std::uint32_t, 2>& key, std::size_t n, const std::uint64_t* HWY_RESTRICT history,
              std::uint32_t flight, std::uint32_t purpose, std::uint64_t* HWY_RESTRICT polar_azimuth,
              std::uint64_t* HWY_RESTRICT chance) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t together = blocks * lanes;
  // The keys of all rounds, a whole vector each: nothing to work out in the loop.
  constexpr std::size_t rounds = 10;
  constexpr std::size_t most_lanes = HWY_MAX_BYTES / sizeof(std::uint64_t);
  HWY_ALIGN std::array<std::uint64_t, 2 * rounds * most_lanes> keys;
  for (std::uint32_t round = 0; round < rounds; ++round) {
    hn::Store(hn::Set(d, key[0] + round * 0x9E3779B9U), d, keys.data() + 2 * round * most_lanes);
    hn::Store(hn::Set(d, key[1] + round * 0xBB67AE85U), d, keys.data() + (2 * round + 1) * most_lanes);
  }
  const auto draw = [&](const std::uint64_t* from, std::uint64_t* words, std::uint64_t* others) {
    Block b0, b1;
    b0.Begin(from, flight, purpose);
    b1.Begin(from + lanes, flight, purpose);
    for (std::size_t round = 0; round < rounds; ++round) {
      const Lanes k0 = hn::Load(d, keys.data() + 2 * round * most_lanes);
      const Lanes k1 = hn::Load(d, keys.data() + (2 * round + 1) * most_lanes);
      b0.Round(k0, k1);
      b1.Round(k0, k1);
    }
    b0.End(words, others);
    b1.End(words + lanes, others + lanes);
  };
  std::size_t i = 0;
  for (; i + together <= n; i += together) draw(history + i, polar_azimuth + i, chance + i);
  if (i == n) return;
  // The last ones by way of arrays that are long enough.
  constexpr std::size_t most = blocks * most_lanes;
  std::array<std::uint64_t, most> from{};
  std::array<std::uint64_t, most> words{};
  std::array<std::uint64_t, most> others{};
  for (std::size_t k = 0; i + k < n; ++k) from[k] = history[i + k];
  draw(from.data(), words.data(), others.data());
  for (std::size_t k = 0; i + k < n; ++k) {
    polar_azimuth[i + k] = words[k];
    chance[i + k] = others[k];
  }
}

}  // namespace lichtmc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lichtmc {

HWY_EXPORT(DrawMany);

void draw_many(const Stream& stream, std::size_t n, const std::uint64_t* history, std::uint32_t flight, Purpose purpose,
               std::uint64_t* polar_azimuth, std::uint64_t* chance) {
  HWY_DYNAMIC_DISPATCH(DrawMany)
  (stream.key(), n, history, flight, stream.word_of(purpose), polar_azimuth, chance);
}

}  // namespace lichtmc
#endif
