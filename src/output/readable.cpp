#include "output/readable.hpp"

#include <cmath>

#include "base/message.hpp"

namespace lichtmc {

std::string short_count(std::uint64_t count) {
  const auto number = static_cast<double>(count);
  return count < 999'500 ? short_number(number) : short_number(1e-6 * number) + " million";
}

std::string percent(double share) {
  return std::isfinite(share) ? short_number(100.0 * share) + " %" : "unknown";
}

}  // namespace lichtmc
