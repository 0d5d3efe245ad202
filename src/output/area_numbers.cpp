#include "output/area_numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/message.hpp"

namespace lichtmc {

AreaNumbers::AreaNumbers(const AreaDrawing& drawing, Quantity quantity) : unit_(written_irradiance_unit(quantity)) {
  constexpr double least = 0.1;
  constexpr double greatest = 1e5;
  double highest = 0.0;
  for (std::size_t k = 0; k < drawing.values.size(); ++k) {
    if (drawing.has_point[k]) highest = std::max(highest, drawing.values[k]);
  }
  if (!(highest > 0.0)) return;
  if (highest < least || highest >= greatest) {
    const int thousands = static_cast<int>(std::floor(std::log10(highest) / 3.0));
    factor_ = std::pow(10.0, -3.0 * thousands);
    unit_ = rounded(1.0 / factor_, 2) + " " + unit_;
  }
  decimals_ = std::clamp(2 - static_cast<int>(std::floor(std::log10(highest * factor_))), 0, 3);
}

std::string AreaNumbers::text(double value) const {
  std::array<char, 400> digits{};  // the largest double has 309 before the point
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value * factor_, std::chars_format::fixed, decimals_);
  return {digits.data(), end.ptr};
}

}  // namespace lichtmc
