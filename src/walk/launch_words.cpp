#include "walk/launch_words.hpp"

#include <cassert>
#include <numeric>

#include "chance/draw_many.hpp"
#include "chance/moments.hpp"
#include "chance/sobol.hpp"

namespace lichtmc {

void LaunchWords::draw_emission(std::uint64_t first, std::uint32_t n, std::uint32_t* polar, std::uint32_t* azimuth,
                                std::uint64_t* chance) const {
  std::array<std::uint64_t, batch_histories> history;
  std::iota(history.begin(), history.end(), first);
  draw_many(stream_, n, history.data(), 0, Purpose::emission, polar, azimuth, chance);
}

QuasiRandomWords::QuasiRandomWords(const Stream& stream, std::uint32_t set) : LaunchWords(stream) {
  assert(set > 0 && set <= batch_histories && (set & (set - 1)) == 0);
  for (std::uint32_t k = 0; k < set; ++k)
    points_.push_back({sobol(k, 0), sobol(k, 1), sobol(k, 2), {sobol(k, 3), sobol(k, 4), sobol(k, 5)}});
}

void QuasiRandomWords::draw_emission(std::uint64_t first, std::uint32_t n, std::uint32_t* polar, std::uint32_t* azimuth,
                                     std::uint64_t* chance) const {
  Words shift{};
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint64_t k = (first + i) % points_.size();
    if (i == 0 || k == 0) shift = stream_.draw((first + i) / points_.size(), 0, Purpose::shift);
    const Point& point = points_[k];
    polar[i] = point.polar ^ shift[0];
    azimuth[i] = point.azimuth ^ shift[1];
    chance[i] = std::uint64_t{point.emitter ^ shift[2]} << 32 | shift[3];
  }
}

Words QuasiRandomWords::place(std::uint64_t history) const {
  const Point& point = points_[history % points_.size()];
  const Words shift = stream_.draw(history / points_.size(), 0, Purpose::place_shift);
  return {point.place[0] ^ shift[0], shift[3], point.place[1] ^ shift[1], point.place[2] ^ shift[2]};
}

}  // namespace lichtmc
