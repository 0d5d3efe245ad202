#include "output/area_words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/message.hpp"

namespace lichtmc {

namespace {

std::string with_decimals(double value, int decimals) {
  std::array<char, 400> digits{};  // the largest double has 309 before the point
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed,
                                 std::max(0, decimals));
  return {digits.data(), end.ptr};
}

// The decimal place of the first digit: 349 → 2, 0.055 → -2.
int first_place(double value) {
  return static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
}

std::string with_unit(const std::string& text, Quantity quantity) {
  return text + " " + written_irradiance_unit(quantity);
}

const char* mean_word(Quantity quantity) {
  return quantity == Quantity::photometric ? "Em" : "mean";
}

const char* uniformity_word(Quantity quantity) {
  return quantity == Quantity::photometric ? "U0" : "uniformity";
}

}  // namespace

std::string figure_text(const Figure& figure, int most_digits) {
  constexpr int furthest_place = 7;  // numbers beyond have a power of ten
  const double value = figure.value;
  const double error = figure.standard_error;
  if (!std::isfinite(value)) return "–";
  if (!std::isfinite(error)) return short_number(value);
  if (!(error > 0.0)) return rounded(value, most_digits);
  const int last =
      std::max(first_place(error), value != 0.0 ? first_place(value) - (most_digits - 1) : first_place(error));
  const double step = std::pow(10.0, last);
  const double shown_error = step * std::ceil(error / step - 1e-9);
  if (last < -furthest_place || last >= furthest_place) return short_number(value) + " ± " + rounded(error, 2);
  return with_decimals(step * std::round(value / step), -last) + " ± " + with_decimals(shown_error, -last);
}

std::string uniformity_target_text(double target) {
  constexpr std::size_t least = 4;  // "0.60"
  std::string text = decimal(target, 3);
  if (text.find('.') == std::string::npos) text += '.';
  while (text.size() < least) text += '0';
  return text;
}

std::string area_title(const Area& area) {
  const AreaProperties& properties = area.properties;
  return properties.role.empty() || properties.role == properties.name ? properties.name
                                                                       : properties.name + " (" + properties.role + ")";
}

bool has_maintenance(const AreaResult& result) {
  return std::isfinite(result.initial_mean.value) && result.initial_mean.value != result.mean.value;
}

std::string area_figures_text(const AreaResult& result, Quantity quantity) {
  std::string text = mean_word(quantity) + (" " + with_unit(figure_text(result.mean), quantity));
  if (has_maintenance(result)) text += " (initially " + with_unit(figure_text(result.initial_mean), quantity) + ")";
  return text + ", " + uniformity_word(quantity) + " " + figure_text(result.uniformity, 3);
}

std::string area_target_text(const AreaResult& result, Quantity quantity) {
  const AreaProperties& properties = result.area.properties;
  if (!properties.target_lx && !properties.target_uniformity) return {};
  std::string text = "target ";
  if (properties.target_lx) text += with_unit(rounded(*properties.target_lx, 4), quantity);
  if (properties.target_uniformity)
    text += (properties.target_lx ? ", " : std::string(uniformity_word(quantity)) + " ") +
            uniformity_target_text(*properties.target_uniformity);
  if (result.verdict == Verdict::none) return text;
  return text + ": " + verdict_text(result.verdict, result.mean_verdict, result.uniformity_verdict, quantity);
}

std::string verdict_text(Verdict verdict, Verdict of_mean, Verdict of_uniformity, Quantity quantity) {
  std::string text(to_string(verdict));
  if (of_mean == Verdict::none || of_uniformity == Verdict::none || of_mean == of_uniformity) return text;
  const bool mean = of_mean == verdict;
  const Verdict other = mean ? of_uniformity : of_mean;
  text += std::string(" (") + (mean ? mean_word(quantity) : uniformity_word(quantity));
  if (other == Verdict::undecided)
    text += std::string("; ") + (mean ? uniformity_word(quantity) : mean_word(quantity)) + " undecided";
  return text + ")";
}

std::string area_quantity_text(const Area& area, Quantity quantity) {
  const std::string word(irradiance_word(quantity));
  std::string text = area.quantity == AreaQuantity::normal       ? word + " on the area"
                     : area.quantity == AreaQuantity::horizontal ? "horizontal " + word
                                                                 : std::string(to_string(area.quantity)) + " " + word;
  if (area.above_floor_m) text += ", " + decimal(*area.above_floor_m, 3) + " m above the floor";
  return text;
}

std::string area_left_out_text(const Area& area) {
  std::uint64_t count = 0;
  std::string reasons;
  for (const AreaLeftOut& left_out : area.left_out) {
    count += left_out.points;
    reasons += (reasons.empty() ? "" : ", ") + std::to_string(left_out.points) + " " + left_out.why;
  }
  if (count == 0) return {};
  return std::to_string(count) + " of " + to_text(count + area.cells.size(), "cell") +
         (count == 1 ? " has no point: " : " have no point: ") + reasons;
}

std::string area_line(const AreaResult& result, Quantity quantity) {
  const std::string target = area_target_text(result, quantity);
  return area_title(result.area) + ": " + area_figures_text(result, quantity) + (target.empty() ? "" : ", " + target);
}

}  // namespace lichtmc
