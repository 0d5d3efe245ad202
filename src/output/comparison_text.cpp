// Comparisons of results in words.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "lichtmc/compare.hpp"
#include "lichtmc/visible_text.hpp"

namespace lichtmc {

namespace {

std::string number_text(const char* form, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, form, value);
  return buffer;
}

std::string p_value_text(double probability) {
  return probability < 1e-9 ? "less than 1e-9" : number_text("%.2g", probability);
}

std::string first_line_of(const Comparison& comparison) {
  std::string text = to_string(comparison.what) + ": " + std::to_string(comparison.figures.size()) + " compared";
  if (comparison.dark > 0) text += "; " + std::to_string(comparison.dark) + " are 0 in both";
  if (comparison.unknown > 0)
    text += "; " + std::to_string(comparison.unknown) + " excluded: their standard errors are unknown";
  if (comparison.unmatched > 0)
    text += "; " + std::to_string(comparison.unmatched) + " receivers excluded: not at the point of exactly one tile";
  return text + ".\n";
}

std::string line_of(const FigurePair& pair) {
  return "    " + visible_text(pair.name) + ": A " + number_text("%.5g", pair.a) + " +- " +
         number_text("%.2g", pair.error_a) + ", B " + number_text("%.5g", pair.b) + " +- " +
         number_text("%.2g", pair.error_b) + ", z " + number_text("%+.3g", pair.z()) + '\n';
}

}  // namespace

std::vector<const FigurePair*> worst_figures(const Comparison& comparison, std::size_t count) {
  std::vector<const FigurePair*> worst;
  for (const FigurePair& pair : comparison.figures) worst.push_back(&pair);
  count = std::min(count, worst.size());
  std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(count), worst.end(),
                    [](const FigurePair* a, const FigurePair* b) { return std::abs(a->z()) > std::abs(b->z()); });
  worst.resize(count);
  return worst;
}

std::string comparison_text(const Comparison& comparison, std::size_t count) {
  std::string text = first_line_of(comparison);
  if (comparison.figures.empty()) return text;
  text += "  B over A: " + number_text("%+.3g", 100.0 * comparison.difference) + " % with a standard error of " +
          number_text("%.2g", 100.0 * comparison.difference_error) + " % (mean of all)\n  chi-square " +
          number_text("%.5g", comparison.chi_square) + ", expected " +
          number_text("%.5g", comparison.expected_chi_square) + "; p-value " +
          p_value_text(comparison.chi_square_chance) + "\n  largest |z| " +
          number_text("%.3g", std::abs(comparison.largest_z)) + " (" +
          visible_text(comparison.figures[comparison.largest].name) + "); p-value " +
          p_value_text(comparison.largest_chance) + " for the largest of " + std::to_string(comparison.figures.size()) +
          '\n';
  if (comparison.agree) return text + "  They agree within their standard errors.\n";
  for (const FigurePair* pair : worst_figures(comparison, count)) text += line_of(*pair);
  text += "  They disagree: by chance this occurs less than once in a million comparisons.\n";
  if (comparison.what == ComparisonOf::tiles_at_receivers)
    text +=
        "  A tile gives the mean over its area, a receiver the value at one point. Smaller tiles reduce this "
        "difference.\n";
  return text;
}

}  // namespace lichtmc
