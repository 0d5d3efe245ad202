#include "room/receiver_columns.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/message.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// A heading taken apart: "x (m)" is x with the unit m.
struct Name {
  std::string column;
  std::string unit;
};

Name name_of(std::string_view heading) {
  const std::string text = lower(trimmed(heading));
  const std::size_t mark = text.find_first_of("([/");
  if (mark == std::string::npos) return {text, {}};
  std::string_view unit = trimmed(std::string_view(text).substr(mark + 1));
  const char closing = text[mark] == '(' ? ')' : text[mark] == '[' ? ']' : '\0';
  if (closing != '\0') {
    if (unit.empty() || unit.back() != closing) return {text, {}};
    unit = trimmed(unit.substr(0, unit.size() - 1));
  }
  return {std::string(trimmed(std::string_view(text).substr(0, mark))), std::string(unit)};
}

// Index into receiver_numbers.
std::optional<std::size_t> number_column(std::string_view heading) {
  const auto found = std::find(receiver_numbers.begin(), receiver_numbers.end(), name_of(heading).column);
  if (found == receiver_numbers.end()) return std::nullopt;
  return static_cast<std::size_t>(found - receiver_numbers.begin());
}

// The units that a column may have; the first one names them in messages.
std::vector<std::string_view> units_of(std::size_t column) {
  const std::string_view name = receiver_numbers[column];
  if (name == "area") return {"square metres", "m²", "m^2", "m2", "sqm"};
  if (name == "fov") return {"degrees, the half angle", "deg", "degree", "degrees", "°"};
  const bool length = column < 3 || (column >= needed_numbers && column < numbers_of_cell);
  if (length) return {"metres", "m", "metre", "metres", "meter", "meters"};
  return {column < needed_numbers ? "numbers without a unit, the direction of the normal" : "numbers without a unit",
          "1", "-"};
}

void check_unit(std::string_view heading, std::size_t column, const std::string& where) {
  const std::string unit = name_of(heading).unit;
  const std::vector<std::string_view> units = units_of(column);
  if (unit.empty() || std::find(units.begin() + 1, units.end(), unit) != units.end()) return;
  throw InputError(where + " names the column " + in_quotes(heading) + " (allowed: " + std::string(units.front()) +
                   "). Convert the column, and correct its heading.");
}

std::vector<CsvField> fields_by(std::string_view row, char separator) {
  std::istringstream in{std::string(row)};
  CsvReader reader(in, separator);
  CsvRow fields;
  try {
    if (reader.next(fields)) return fields.fields;
  } catch (const CsvFault&) {  // reported when the table is read
  }
  return {};
}

bool begins_with_numbers(const std::vector<CsvField>& fields, char separator) {
  if (fields.size() < needed_numbers) return false;
  return std::all_of(fields.begin(), fields.begin() + needed_numbers, [separator](const CsvField& field) {
    const std::string_view text = trimmed(field.text);
    const bool one_number = text.find_first_of(separator == ',' ? ",; \t" : "; \t") == std::string_view::npos;
    return looks_like_number(text) && one_number;
  });
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view no_break_space = "\xC2\xA0";
  for (;;) {
    if (text.starts_with(' ') || text.starts_with('\t')) {
      text.remove_prefix(1);
    } else if (text.ends_with(' ') || text.ends_with('\t')) {
      text.remove_suffix(1);
    } else if (text.starts_with(no_break_space)) {
      text.remove_prefix(2);
    } else if (text.ends_with(no_break_space)) {
      text.remove_suffix(2);
    } else {
      return text;
    }
  }
}

bool looks_like_number(std::string_view text) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  if (text.empty()) return false;
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  if (digit(text.front())) return true;
  if (text.front() == '.' || text.front() == ',') return text.size() > 1 && digit(text[1]);
  const std::string word = lower(text);
  return word == "nan" || word == "inf" || word == "infinity";
}

bool names_all_columns(const CsvRow& row) {
  std::array<bool, receiver_numbers.size()> found{};
  for (const CsvField& field : row.fields) {
    if (const auto column = number_column(field.text)) found[*column] = true;
  }
  return std::all_of(found.begin(), found.begin() + needed_numbers, [](bool is) { return is; });
}

ReceiverColumns columns_of(const CsvRow& heading, const std::string& where) {
  ReceiverColumns columns;
  columns.heading = true;
  columns.least = columns.most = heading.fields.size();
  std::array<bool, receiver_numbers.size()>& found = columns.found;
  const auto twice = [&where](std::string_view text) {
    throw InputError(where + " names the column " + in_quotes(trimmed(text)) +
                     " twice (allowed: once). Remove or rename one of them.");
  };
  for (std::size_t k = 0; k < heading.fields.size(); ++k) {
    const std::string& text = heading.fields[k].text;
    if (const auto number = number_column(text)) {
      if (found[*number]) twice(text);
      found[*number] = true;
      check_unit(text, *number, where);
      columns.numbers[*number] = k;
    } else if (name_of(text).column == "name") {
      if (columns.name) twice(text);
      columns.name = k;
    } else {
      columns.ignored.push_back(in_quotes(trimmed(text)));
    }
  }
  std::string missing;
  columns.cells =
      std::any_of(found.begin() + needed_numbers, found.begin() + numbers_of_cell, [](bool is) { return is; });
  for (std::size_t k = 0; k < (columns.cells ? numbers_of_cell : needed_numbers); ++k) {
    if (!found[k]) missing += (missing.empty() ? "" : ", ") + std::string(receiver_numbers[k]);
  }
  if (missing.empty()) return columns;
  std::string others;
  constexpr std::size_t shown = 12;
  for (std::size_t k = 0; k < std::min(shown, columns.ignored.size()); ++k)
    others += (k > 0 ? ", " : "") + columns.ignored[k];
  if (columns.ignored.size() > shown) others += ", …";
  throw InputError(where + " is a heading without " + missing + (others.empty() ? "" : "; it has " + others) +
                   " (allowed: x, y, z, nx, ny, nz in any order, for cells ux, uy, uz, vx, vy, vz, and area, fov, "
                   "concentrator_index, filter_gain; other columns are not read). Name the columns of the position in "
                   "metres and of the normal so.");
}

char separator_of(std::string_view first_row) {
  char best = ',';
  std::size_t most = 0;
  for (const char separator : {'\t', ';', ',', ' '}) {
    CsvRow row;
    row.fields = fields_by(first_row, separator);
    if (names_all_columns(row) || begins_with_numbers(row.fields, separator)) return separator;
    if (separator != ' ' && row.fields.size() > most) {
      most = row.fields.size();
      best = separator;
    }
  }
  return best;
}

}  // namespace lichtmc
