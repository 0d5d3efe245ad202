#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/message.hpp"
#include "lichtmc/compare.hpp"
#include "lichtmc/units.hpp"
#include "lichtmc/visible_text.hpp"
#include "output/area_words.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t columns_of_designs = 4;  // name, A, B, B − A

using DesignRow = std::array<std::string, columns_of_designs>;

std::size_t length_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// In columns; rows with a name alone take no part in its width.
std::string table_of(const std::vector<DesignRow>& rows) {
  std::array<std::size_t, columns_of_designs> width{};
  for (const DesignRow& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k > 0 || !row[1].empty()) width[k] = std::max(width[k], length_of(row[k]));
    }
  }
  std::string text;
  for (const DesignRow& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      line += row[k];
      if (length_of(row[k]) < width[k]) line.append(width[k] - length_of(row[k]), ' ');
      line += "   ";
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string signed_text(const Figure& figure, int digits) {
  const std::string text = figure_text({std::abs(figure.value), figure.standard_error}, digits);
  return figure.value > 0.0 ? "+" + text : figure.value < 0.0 ? "−" + text : text;
}

std::string target_of(const DesignArea& area, const std::string& unit) {
  std::string text;
  if (area.target_mean) text += rounded(*area.target_mean, 4) + " " + unit;
  if (area.target_uniformity) text += (text.empty() ? "U0 " : ", ") + uniformity_target_text(*area.target_uniformity);
  return text;
}

// "fail (U0)", behind the target if the designs have different ones. "–" without a target.
std::string verdict_cell(const DesignArea& area, const std::string& unit, bool with_target) {
  const std::string target = target_of(area, unit);
  if (target.empty()) return "–";
  const Quantity quantity = unit == "lx" ? Quantity::photometric : Quantity::radiometric;
  const std::string verdict = area.verdict == Verdict::none
                                  ? "–"
                                  : verdict_text(area.verdict, area.mean_verdict, area.uniformity_verdict, quantity);
  return with_target ? target + ": " + verdict : verdict;
}

// Heights above the floor, in m, to a millimetre.
std::string height_change(double a, double b) {
  const std::string size = decimal(std::abs(b - a), 3);
  return size == "0" ? size : (b > a ? "+" : "−") + size;
}

void add_area(const DesignAreas& pair, const std::string& unit, bool photometric, std::vector<DesignRow>& rows) {
  const DesignArea& one = pair.a ? *pair.a : *pair.b;
  std::string title = visible_text(one.name);
  if (!one.role.empty() && one.role != one.name) title += " (" + visible_text(one.role) + ")";
  rows.push_back({title});
  const auto text = [](const std::optional<DesignArea>& area, const auto& words) {
    return area ? words(*area) : std::string("missing");
  };
  const auto row = [&](const std::string& name, const auto& words, const std::string& difference) {
    rows.push_back({"  " + name, text(pair.a, words), text(pair.b, words), difference});
  };
  row((photometric ? "Em, " : "mean, ") + unit, [](const DesignArea& area) { return figure_text(area.mean); },
      pair.a && pair.b ? signed_text(pair.mean_difference, 4) : std::string());
  row(
      photometric ? "U0" : "uniformity", [](const DesignArea& area) { return figure_text(area.uniformity, 3); },
      pair.a && pair.b ? signed_text(pair.uniformity_difference, 3) : std::string());
  const std::string target_a = pair.a ? target_of(*pair.a, unit) : std::string();
  const std::string target_b = pair.b ? target_of(*pair.b, unit) : std::string();
  if (!target_a.empty() || !target_b.empty()) {
    const bool same = !pair.a || !pair.b || target_a == target_b;
    row(
        same ? "target " + (pair.a ? target_a : target_b) : "target",
        [&](const DesignArea& area) { return verdict_cell(area, unit, !same); }, "");
  }
  if (pair.a && pair.b && pair.a->above_floor_m && pair.b->above_floor_m) {
    const std::string change = height_change(*pair.a->above_floor_m, *pair.b->above_floor_m);
    if (change != "0")
      row(
          "height, m", [](const DesignArea& area) { return decimal(*area.above_floor_m, 3); }, change);
  }
  if (pair.a && pair.b && (pair.a->points != pair.b->points || pair.a->quantity != pair.b->quantity))
    row(
        "points", [](const DesignArea& area) { return std::to_string(area.points) + ", " + area.quantity; }, "");
}

std::string change_of(double a, double b) {
  return (b > a ? "+" : b < a ? "−" : "") + rounded(std::abs(b - a), 4);
}

std::string maintenance_cell(const DesignTotals& total) {
  const double least = total.least_maintenance_factor;
  const double greatest = total.greatest_maintenance_factor;
  if (std::isnan(least)) return "unknown";
  return least == greatest ? rounded(least, 4) : rounded(least, 4) + " to " + rounded(greatest, 4);
}

// Whether the figures of both are of equally old and dirty luminaires.
std::string maintenance_remark(const DesignTotals& a, const DesignTotals& b) {
  if (std::isnan(a.least_maintenance_factor) || std::isnan(b.least_maintenance_factor))
    return "A maintenance factor is unknown: maintained values may stand beside initial ones.\n";
  if (a.least_maintenance_factor != b.least_maintenance_factor ||
      a.greatest_maintenance_factor != b.greatest_maintenance_factor)
    return "The maintenance factors differ: a part of the differences is due to them.\n";
  return {};
}

}  // namespace

std::string designs_text(const DesignComparison& designs) {
  const bool photometric = designs.unit == "lm";
  const std::string unit = written_irradiance_unit(photometric ? Quantity::photometric : Quantity::radiometric);
  std::vector<DesignRow> rows{{"", "A", "B", "B − A"}};
  for (const DesignAreas& pair : designs.areas) add_area(pair, unit, photometric, rows);
  const DesignTotals& a = designs.total_a;
  const DesignTotals& b = designs.total_b;
  rows.push_back({photometric ? "luminous flux, lm" : "radiant flux, W", rounded(a.power, 4), rounded(b.power, 4),
                  change_of(a.power, b.power)});
  if (a.watts || b.watts) {
    const auto text = [](const std::optional<double>& watts) { return watts ? rounded(*watts, 4) : "unknown"; };
    rows.push_back({"power of the luminaires, W", text(a.watts), text(b.watts),
                    a.watts && b.watts ? change_of(*a.watts, *b.watts) : std::string()});
  }
  std::string remark;
  if (photometric) {
    rows.push_back({"maintenance factor", maintenance_cell(a), maintenance_cell(b), ""});
    remark = maintenance_remark(a, b);
  }
  return "A: " + visible_text(designs.a) + "\nB: " + visible_text(designs.b) + "\n\n" + table_of(rows) +
         (remark.empty() ? "" : "\n" + remark);
}

}  // namespace lichtmc
