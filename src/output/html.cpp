#include "output/html.hpp"

#include <cmath>

#include "base/message.hpp"
#include "output/svg.hpp"

namespace lichtmc {

std::string element(std::string_view tag, std::string_view content, std::string_view attributes) {
  return "<" + std::string(tag) + std::string(attributes) + ">" + std::string(content) + "</" + std::string(tag) +
         ">\n";
}

std::string text_element(std::string_view tag, std::string_view text, std::string_view attributes) {
  return element(tag, escaped(text), attributes);
}

std::string heading(std::string_view text) {
  return text_element("h2", text);
}

std::string number_cell(double value) {
  if (!std::isfinite(value)) return "<td>–</td>";
  return "<td data-value=\"" + to_text(value) + "\">" + short_number(value) + "</td>";
}

std::string flux_cell(double value) {
  constexpr int digits = 5;
  return "<td data-value=\"" + to_text(value) + "\">" + rounded(value, digits) + "</td>";
}

std::string count_cell(std::uint64_t value) {
  const std::string text = std::to_string(value);
  return "<td data-value=\"" + text + "\">" + text + "</td>";
}

std::string text_cell(std::string_view text) {
  return "<td class=\"text\">" + escaped(text) + "</td>";
}

std::string table_head(const std::vector<std::string>& names) {
  std::string row;
  for (const std::string& name : names) row += "<th>" + escaped(name) + "</th>";
  return "<thead><tr>" + row + "</tr></thead>\n";
}

std::string list_of(const std::vector<std::string>& sentences) {
  std::string items;
  for (const std::string& sentence : sentences) items += text_element("li", sentence);
  return element("ul", items);
}

}  // namespace lichtmc
