#include "output/report_areas.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/overrides.hpp"
#include "lichtmc/units.hpp"
#include "lichtmc/visible_text.hpp"
#include "output/area_words.hpp"
#include "output/html.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

// A verdict with a sign, so that it does not need its colour.
std::string verdict_mark(Verdict verdict, bool with_word) {
  if (verdict == Verdict::none) return {};
  const std::string word(to_string(verdict));
  const std::string sign = verdict == Verdict::pass ? "✓" : verdict == Verdict::fail ? "✗" : "?";
  return " <span class=\"verdict " + word + "\">" + sign + (with_word ? " " + word : "") + "</span>";
}

std::string area_figure_cell(const Figure& figure, const std::string& second_line = {}) {
  std::string text = escaped(figure_text(figure));
  if (!second_line.empty()) text += element("small", escaped(second_line));
  if (!std::isfinite(figure.value)) return element("td", text);
  return element("td", text, " data-value=\"" + to_text(figure.value) + "\"");
}

std::string target_cell(const std::optional<double>& target, bool uniformity, Verdict verdict) {
  if (!target) return element("td", "–");
  const std::string text = uniformity ? uniformity_target_text(*target) : rounded(*target, 4);
  return element("td", "≥ " + text + verdict_mark(verdict, false), " data-value=\"" + to_text(*target) + "\"");
}

std::string area_cell(const AreaResult& result, Quantity quantity) {
  const Area& area = result.area;
  std::string html = text_element("b", area.properties.name);
  std::string second = area.properties.role == area.properties.name ? std::string() : area.properties.role;
  if (!second.empty()) second += "; ";
  second += area_quantity_text(area, quantity);
  return element("td", html + text_element("small", second), " class=\"text\"");
}

std::string initial_text(const AreaResult& result, const Figure& initial, Quantity quantity) {
  return has_maintenance(result) ? "initially " + figure_text(initial) + " " + written_irradiance_unit(quantity)
                                 : std::string();
}

// Which of its targets decides the verdict of an area, if it has two: " (U0)".
std::string reason_of(const AreaResult& area, Quantity quantity) {
  const std::string words = verdict_text(area.verdict, area.mean_verdict, area.uniformity_verdict, quantity);
  return words.substr(to_string(area.verdict).size());
}

// "Fails: desk (U0), board."
std::string areas_with(const Result& result, Verdict verdict, const char* one, const char* many) {
  Names names;
  for (const AreaResult& area : result.areas) {
    if (area.verdict == verdict) names.add(visible_text(area.area.properties.name) + reason_of(area, result.quantity));
  }
  if (names.count() == 0) return {};
  return std::string(names.count() == 1 ? one : many) + names.text() + ".";
}

// The verdict of all areas together.
std::string overall_verdict(const Result& result) {
  const auto has = [&result](Verdict verdict) {
    return std::any_of(result.areas.begin(), result.areas.end(),
                       [verdict](const AreaResult& area) { return area.verdict == verdict; });
  };
  const Verdict worst = has(Verdict::fail)        ? Verdict::fail
                        : has(Verdict::undecided) ? Verdict::undecided
                                                  : Verdict::pass;
  if (worst == Verdict::pass && !has(Verdict::pass)) return {};
  const char* headline = worst == Verdict::pass   ? "All targets are reached."
                         : worst == Verdict::fail ? "Not all targets are reached."
                                                  : "Not yet decided whether all targets are reached.";
  std::string html = text_element("b", headline);
  for (const std::string& sentence :
       {areas_with(result, Verdict::fail, "Fails: ", "Fail: "),
        areas_with(result, Verdict::undecided, "Undecided within its error: ", "Undecided within their errors: "),
        worst == Verdict::pass ? std::string() : areas_with(result, Verdict::pass, "Passes: ", "Pass: ")}) {
    if (!sentence.empty()) html += " " + escaped(sentence);
  }
  return element("p", html, " class=\"overall " + std::string(to_string(worst)) + "\"");
}

std::string meaning_of_table(const Result& result) {
  const bool lm = result.quantity == Quantity::photometric;
  std::string text = std::string(lm ? "Em: mean " : "Mean: ") + std::string(irradiance_word(result.quantity)) +
                     " of the points of an area; " + (lm ? "U0 = Emin/Em" : "uniformity: lowest over mean value") +
                     ". After ±: the standard error of the calculation. ";
  const bool undecided = std::any_of(result.areas.begin(), result.areas.end(),
                                     [](const AreaResult& area) { return area.verdict == Verdict::undecided; });
  if (undecided)
    text += "Undecided: the target is less than two standard errors from the figure; a longer calculation decides. ";
  return text;
}

}  // namespace

std::string maintenance_text(const Room& room) {
  const std::string maintained = maintained_text(room);
  return maintained.empty() ? "Maintenance factor 1: the figures are initial values, of new and clean luminaires."
                            : maintained + ".";
}

std::string area_verdicts(const ReportContent& content) {
  const Result& result = *content.result;
  if (result.areas.empty()) return {};
  const std::string unit = ", " + written_irradiance_unit(result.quantity);
  const bool lm = result.quantity == Quantity::photometric;
  std::string rows;
  for (const AreaResult& area : result.areas) {
    const AreaProperties& asked = area.area.properties;
    rows += "<tr>" + area_cell(area, result.quantity) +
            area_figure_cell(area.mean, initial_text(area, area.initial_mean, result.quantity)) +
            target_cell(asked.target_lx, false, area.mean_verdict) + area_figure_cell(area.uniformity) +
            target_cell(asked.target_uniformity, true, area.uniformity_verdict) +
            area_figure_cell(area.minimum, initial_text(area, area.initial_minimum, result.quantity)) +
            area_figure_cell(area.maximum) +
            element("td", area.verdict == Verdict::none ? "no target" : verdict_mark(area.verdict, true)) + "</tr>\n";
  }
  const std::vector<std::string> names =
      lm ? std::vector<std::string>{"area",      "Em" + unit,   "target Em" + unit, "U0",
                                    "target U0", "Emin" + unit, "Emax" + unit,      "result"}
         : std::vector<std::string>{"area",   "mean" + unit,   "target" + unit,  "uniformity",
                                    "target", "lowest" + unit, "highest" + unit, "result"};
  const std::string maintenance = lm ? maintenance_text(*content.room) : std::string();
  return heading("Calculation areas") + overall_verdict(result) +
         element("div", element("table", table_head(names) + element("tbody", rows), " id=\"areas\""),
                 " class=\"scroll\"") +
         text_element("p", meaning_of_table(result) + maintenance, " class=\"muted\"");
}

std::string area_plans(const ReportContent& content) {
  std::string html;
  for (const std::string& plan : content.area_plans) html += element("figure", plan, " class=\"area-plan\"");
  return html;
}

std::string area_details(const ReportContent& content) {
  const Result& result = *content.result;
  if (result.areas.empty()) return {};
  const std::string unit = ", " + written_irradiance_unit(result.quantity);
  const bool lm = result.quantity == Quantity::photometric;
  std::string rows;
  for (const AreaResult& one : result.areas) {
    const Area& area = one.area;
    const std::string grid = std::to_string(area.columns) + " × " + std::to_string(area.rows);
    const std::string cell = rounded(glm::length(area.u), 4) + " × " + rounded(glm::length(area.v), 4);
    std::string measured = area.properties.cells ? "means of the cells" : "points at the centres of the cells";
    if (const std::string left_out = area_left_out_text(area); !left_out.empty()) measured += "; " + left_out;
    for (const std::string& note : area.notes) measured += ". " + note;
    rows += "<tr>" + text_cell(area_title(area)) + element("td", grid) + element("td", cell) +
            count_cell(area.cells.size()) + number_cell(area.margin_m) + area_figure_cell(one.diversity) +
            number_cell(one.lowest) + number_cell(one.highest) + text_cell(measured) + "</tr>\n";
  }
  return heading("Grids of the calculation areas") +
         element("div",
                 element("table",
                         table_head({"area", "cells", "size of a cell, m", "points", "margin, m",
                                     lm ? "Ud = Emin/Emax" : "lowest over highest", "lowest point" + unit,
                                     "highest point" + unit, "measured"}) +
                             element("tbody", rows),
                         " id=\"area-details\""),
                 " class=\"scroll\"") +
         text_element("p",
                      "Emin, Emax and what follows from them are corrected for the statistical errors of the points, "
                      "which make the lowest of many values too low and the highest too high. The lowest and the "
                      "highest point are given as they were computed. areas.csv and areas/ contain all figures and "
                      "points.",
                      " class=\"muted\"");
}

}  // namespace lichtmc
