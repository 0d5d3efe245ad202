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

// Words live in the lower halves of 64-bit lanes: MulEven reads those, and what is in the upper halves does no harm
// until the end. After philox4x32_10() in philox.hpp.
void DrawMany(const std::array<std::uint32_t, 2>& key, std::size_t n, const std::uint64_t* HWY_RESTRICT history,
              std::uint32_t flight, std::uint32_t purpose, std::uint64_t* HWY_RESTRICT polar_azimuth,
              std::uint64_t* HWY_RESTRICT chance) {
  const hn::ScalableTag<std::uint64_t> d;
  const auto lower = hn::Set(d, 0xFFFFFFFFU);
#if HWY_TARGET == HWY_SCALAR
  const auto product = [&](auto a, std::uint32_t multiplier) {
    return hn::Set(d, (hn::GetLane(a) & 0xFFFFFFFFU) * multiplier);
  };
#else
  const hn::Repartition<std::uint32_t, decltype(d)> d32;
  const auto product = [&](auto a, std::uint32_t multiplier) {
    return hn::MulEven(hn::BitCast(d32, a), hn::BitCast(d32, hn::Set(d, multiplier)));
  };
#endif
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < n; i += lanes) {
    const std::size_t left = n - i;
    HWY_ALIGN std::uint64_t spare[HWY_MAX_BYTES / sizeof(std::uint64_t)] = {};
    const bool whole = left >= lanes;
    if (!whole) {
      for (std::size_t k = 0; k < left; ++k) spare[k] = history[i + k];
    }
    const auto id = whole ? hn::LoadU(d, history + i) : hn::Load(d, spare);
    auto c0 = id;
    auto c1 = hn::ShiftRight<32>(id);
    auto c2 = hn::Set(d, flight);
    auto c3 = hn::Set(d, purpose);
    std::uint32_t key_0 = key[0];
    std::uint32_t key_1 = key[1];
    for (int round = 0; round < 10; ++round) {
      const auto product_0 = product(c0, 0xD2511F53U);
      const auto product_1 = product(c2, 0xCD9E8D57U);
      c0 = hn::Xor(hn::Xor(hn::ShiftRight<32>(product_1), c1), hn::Set(d, key_0));
      c1 = product_1;
      c2 = hn::Xor(hn::Xor(hn::ShiftRight<32>(product_0), c3), hn::Set(d, key_1));
      c3 = product_0;
      key_0 += 0x9E3779B9U;
      key_1 += 0xBB67AE85U;
    }
    const auto first = hn::Or(hn::And(c0, lower), hn::ShiftLeft<32>(c1));
    const auto second = hn::Or(hn::ShiftLeft<32>(c2), hn::And(c3, lower));
    if (whole) {
      hn::StoreU(first, d, polar_azimuth + i);
      hn::StoreU(second, d, chance + i);
      continue;
    }
    hn::Store(first, d, spare);
    for (std::size_t k = 0; k < left; ++k) polar_azimuth[i + k] = spare[k];
    hn::Store(second, d, spare);
    for (std::size_t k = 0; k < left; ++k) chance[i + k] = spare[k];
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
