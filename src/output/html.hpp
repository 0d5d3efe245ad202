// Pieces of HTML: what the page of a report is put together from.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace lichtmc {

// <tag attributes>content</tag>. `content` is HTML; `attributes` begin with a space.
std::string element(std::string_view tag, std::string_view content, std::string_view attributes = "");

// The same around text, which is escaped; so is what all functions below take.
std::string text_element(std::string_view tag, std::string_view text, std::string_view attributes = "");

// Of a section.
std::string heading(std::string_view text);

std::string list_of(const std::vector<std::string>& sentences);

// A table's first row.
std::string table_head(std::initializer_list<std::string> names);

// A cell with a number that can be sorted by; "–" where there is none.
std::string number_cell(double value);
std::string count_cell(std::uint64_t value);
std::string text_cell(std::string_view text);

}  // namespace lichtmc
