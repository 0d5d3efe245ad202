// HTML elements of the report.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lichtmc {

// <tag attributes>content</tag>. `content` is HTML; `attributes` begin with a space.
std::string element(std::string_view tag, std::string_view content, std::string_view attributes = "");

// The same for text, which is escaped. All functions below escape their text.
std::string text_element(std::string_view tag, std::string_view text, std::string_view attributes = "");

// The heading of a section.
std::string heading(std::string_view text);

std::string list_of(const std::vector<std::string>& sentences);

// The header row of a table.
std::string table_head(const std::vector<std::string>& names);

// A cell with a number, sortable; "–" if the number is not finite.
std::string number_cell(double value);
// To five digits: so that fluxes and their sums agree.
std::string flux_cell(double value);
std::string count_cell(std::uint64_t value);
std::string text_cell(std::string_view text);

}  // namespace lichtmc
