#include "inspect/finding_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lichtmc {

void add(Inspection& facts, Severity severity, const char* topic, std::string text, std::string advice) {
  facts.findings.push_back({severity, topic, std::move(text), std::move(advice)});
}

std::string in_percent(double share) {
  return short_number(100.0 * share) + " %";
}

std::string coordinates(const glm::dvec3& point, const char* separator) {
  // To the millimetre; in models of a few millimetres, to a thousandth of the coordinate.
  const double largest = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
  const int decimals = largest >= 0.1 || largest == 0.0 ? 3 : std::min(12, 3 - static_cast<int>(std::log10(largest)));
  return decimal(point.x, decimals) + separator + decimal(point.y, decimals) + separator + decimal(point.z, decimals);
}

std::string text_of(const glm::dvec3& point) {
  return "(" + coordinates(point, ", ") + ")";
}

std::string size_text(const glm::dvec3& size) {
  return short_number(size.x) + " × " + short_number(size.y) + " × " + short_number(size.z) + " m";
}

}  // namespace lichtmc
