#include "inspect/finding_text.hpp"

#include <utility>

#include "base/message.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t shown_names = 5;

}  // namespace

void add(Inspection& facts, Severity severity, const char* topic, std::string text, std::string advice) {
  facts.findings.push_back({severity, topic, std::move(text), std::move(advice)});
}

std::string in_percent(double share) {
  return short_number(100.0 * share) + " %";
}

std::string text_of(const glm::dvec3& point) {
  return "(" + short_number(point.x) + ", " + short_number(point.y) + ", " + short_number(point.z) + ")";
}

std::string size_text(const glm::dvec3& size) {
  return short_number(size.x) + " × " + short_number(size.y) + " × " + short_number(size.z) + " m";
}

void Names::add(const std::string& text) {
  if (count_++ < shown_names) text_ += (text_.empty() ? "" : ", ") + text;
}

std::string Names::text() const {
  return count_ > shown_names ? text_ + " and " + std::to_string(count_ - shown_names) + " more" : text_;
}

}  // namespace lichtmc
