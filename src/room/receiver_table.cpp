#include "lichtmc/receiver_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "base/csv.hpp"
#include "base/message.hpp"
#include "base/read_file.hpp"
#include "base/text_encoding.hpp"
#include "base/utf8.hpp"
#include "lichtmc/error.hpp"
#include "room/receiver_columns.hpp"

namespace lichtmc {

namespace {

constexpr std::string_view forms = "x,y,z,nx,ny,nz or x,y,z,nx,ny,nz,name, or a heading with these names in any order";

// Blanks, no-break spaces (U+00A0, U+202F) and apostrophes inside a number separate thousands.
bool has_thousands(std::string_view number) {
  for (const std::string_view mark : {" ", "\xC2\xA0", "\xE2\x80\xAF", "'", "\xE2\x80\x99"}) {
    if (number.find(mark) != std::string_view::npos) return true;
  }
  return std::count(number.begin(), number.end(), ',') + std::count(number.begin(), number.end(), '.') > 1;
}

std::string separator_word(char separator) {
  switch (separator) {
    case '\t':
      return "tabs";
    case ';':
      return "semicolons";
    case ',':
      return "commas";
    default:
      return "blanks";
  }
}

// Reads the rows of one table.
class TableReader {
 public:
  TableReader(const std::string& text, const std::string& name) : text_(text), name_(name) { find_separator(); }

  ReceiverTable read();

 private:
  void find_separator();
  std::string where(std::size_t row) const { return name_ + ", row " + std::to_string(row); }
  void read_comment(const CsvRow& row);
  void read_row(const CsvRow& row);
  bool is_heading(const CsvRow& row) const;
  void check_count(const CsvRow& row) const;
  double number(const CsvRow& row, std::size_t column);
  void note_decimal_mark(std::string_view field, std::size_t row);
  void read_optics(const CsvRow& row, Receiver& receiver);
  std::string name_in(const CsvRow& row) const;
  [[noreturn]] void refuse_number(const CsvRow& row, std::size_t column, const std::string& cause) const;

  const std::string& text_;
  const std::string& name_;
  char separator_ = ',';
  std::size_t separator_line_ = 0;  // of "sep=;", which some spreadsheet programs read and write; 0 if there is none
  ReceiverColumns columns_;
  bool started_ = false;       // a heading or a row of numbers has been read
  std::size_t point_row_ = 0;  // first rows with a decimal point and with a decimal comma; 0: none
  std::size_t comma_row_ = 0;
  std::size_t foreign_row_ = 0;  // first row with a name that is not UTF-8
  ReceiverTable table_;
};

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = first_character(text).bytes;
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

bool is_empty(const CsvRow& row) {
  for (const CsvField& field : row.fields) {
    if (!trimmed(field.text).empty()) return false;
  }
  return true;
}

// The first line that is neither empty nor a comment decides.
void TableReader::find_separator() {
  std::size_t line = 0;
  for (std::string_view rest = text_; !rest.empty();) {
    ++line;
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    const std::string_view row = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + (rest.substr(end).starts_with("\r\n") ? 2 : 1), rest.size()));
    if (row.empty() || row.starts_with('#')) continue;
    if (!row.starts_with("sep=")) {
      separator_ = separator_of(row);
      return;
    }
    separator_line_ = line;
    separator_ = row.size() == 5 ? row[4] : '\t';  // a tab at the end has been trimmed
    if (row.size() > 5 || (separator_ != ',' && separator_ != ';' && separator_ != '\t'))
      throw InputError(where(line) + " names the separator " + in_quotes(row.substr(4)) +
                       " (allowed: a comma, a semicolon or a tab). Save the table with one of these.");
    return;
  }
}

// Programs for numbers write headings as comments ("# x,y,z,nx,ny,nz"). Other comments say nothing about columns.
void TableReader::read_comment(const CsvRow& row) {
  if (started_) return;
  std::string_view text = row.fields.front().text;
  text.remove_prefix(std::min(text.find_first_not_of('#'), text.size()));
  std::istringstream in{std::string(text)};
  CsvReader reader(in, separator_of(trimmed(text)));
  CsvRow fields;
  try {
    if (reader.next(fields) && names_all_columns(fields)) columns_ = columns_of(fields, where(row.line));
  } catch (const CsvFault&) {  // a sentence with a quote
  }
}

bool TableReader::is_heading(const CsvRow& row) const {
  if (names_all_columns(row)) return true;
  for (std::size_t k = 0; k < std::min<std::size_t>(row.fields.size(), 6); ++k) {
    if (looks_like_number(trimmed(row.fields[k].text))) return false;
  }
  return true;
}

void TableReader::check_count(const CsvRow& row) const {
  const std::size_t found = row.fields.size();
  if (found >= columns_.least && found <= columns_.most) return;
  std::string text = where(row.line) + ", has " + to_text(found, "field") + ", but ";
  text +=
      columns_.heading ? "the heading has " + std::to_string(columns_.least) : "a table without a heading has 6 or 7";
  text += "; the fields are separated by " + separator_word(separator_) + " (allowed: " + std::string(forms) + "). ";
  text += separator_ == ',' && found > columns_.most
              ? "If numbers have decimal commas or separators of thousands, write them as 1500.5, or separate the "
                "columns with semicolons; a name with a comma needs quotes."
              : "Give every receiver its position in metres and its normal, separated in the same way in all rows.";
  throw InputError(text);
}

void TableReader::refuse_number(const CsvRow& row, std::size_t column, const std::string& cause) const {
  throw InputError(where(row.line) + ": the value " + in_quotes(trimmed(row.fields[columns_.numbers[column]].text)) +
                   " in the column " + std::string(receiver_numbers[column]) + " cannot be used: " + cause);
}

// One mark in the whole table: otherwise "1,500" could be a thousand and a half.
void TableReader::note_decimal_mark(std::string_view field, std::size_t row) {
  if (field.find('.') != std::string_view::npos && point_row_ == 0) point_row_ = row;
  if (field.find(',') != std::string_view::npos && comma_row_ == 0) comma_row_ = row;
  if (point_row_ == 0 || comma_row_ == 0) return;
  throw InputError(name_ + " has decimal points, first in row " + std::to_string(point_row_) +
                   ", and decimal commas, first in row " + std::to_string(comma_row_) +
                   " (allowed: one of them in the whole table, and no separators of thousands). Write all numbers in "
                   "one form.");
}

double TableReader::number(const CsvRow& row, std::size_t column) {
  std::string text(trimmed(row.fields[columns_.numbers[column]].text));
  if (text.empty()) refuse_number(row, column, "it is empty (allowed: a number, for example 0.5). Give the number.");
  if (looks_like_number(text) && has_thousands(text))
    refuse_number(row, column,
                  "it has separators of thousands, or two numbers in one field (allowed: a number such as 1500.5). "
                  "Write it without them.");
  if (separator_ == ',' && text.find(',') != std::string::npos)
    refuse_number(row, column,
                  "it has a comma, but commas separate the columns (allowed: a number such as 1.5). Write decimal "
                  "points, or separate the columns with semicolons.");
  note_decimal_mark(text, row.line);
  if (const std::size_t comma = text.find(','); comma != std::string::npos) text[comma] = '.';
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range)
    refuse_number(row, column,
                  "it is outside the range of floating-point numbers (allowed: 0, and sizes from 1e-307 to 1e308). "
                  "Correct it.");
  if (error != std::errc() || stop != end)
    refuse_number(row, column,
                  "it is not a number (allowed: a number, for example 0.5" +
                      std::string(columns_.heading ? "" : "; without a heading the columns are x,y,z,nx,ny,nz,name") +
                      "). Correct it.");
  if (!std::isfinite(value)) refuse_number(row, column, "it is not finite (allowed: a finite number). Correct it.");
  return value;
}

// Empty if the row has none. A number is a name only if a heading says so: it may as well be part of another number.
std::string TableReader::name_in(const CsvRow& row) const {
  if (columns_.heading && !columns_.name) return {};
  const std::size_t column = columns_.name.value_or(6);
  if (column >= row.fields.size()) return {};
  const CsvField& field = row.fields[column];
  const std::string text(field.quoted ? std::string_view(field.text) : trimmed(field.text));
  if (!columns_.heading && looks_like_number(text))
    throw InputError(where(row.line) + ": the seventh field is the number " + in_quotes(text) +
                     ", and no heading says whether it is a name (allowed: " + std::string(forms) +
                     "). If it is, begin the table with x,y,z,nx,ny,nz,name; if these are decimal commas, write "
                     "decimal points, or separate the columns with semicolons.");
  return text;
}

// Area, field of view, concentrator and filter; an empty field means that of a receiver without the column.
void TableReader::read_optics(const CsvRow& row, Receiver& receiver) {
  const auto value_in = [&](std::size_t column, double low, double high, const char* allowed) {
    const bool given = columns_.found[column] && !trimmed(row.fields[columns_.numbers[column]].text).empty();
    if (!given) return std::optional<double>();
    const double value = number(row, column);
    if (!(value >= low && value <= high)) refuse_number(row, column, std::string(allowed) + " Correct it.");
    return std::optional<double>(value);
  };
  constexpr double any = std::numeric_limits<double>::max();
  const auto area = value_in(area_number, 0.0, any, "it is negative (allowed: the area in m², 0 or more).");
  const auto fov =
      value_in(fov_number, 0.0, 90.0, "it is outside the range (allowed: 0 to 90, the half angle in degrees).");
  const auto gain = value_in(filter_number, 0.0, any, "it is negative (allowed: 0 or more).");
  receiver.area_m2 = area.value_or(receiver.area_m2);
  receiver.half_angle_deg = fov.value_or(receiver.half_angle_deg);
  receiver.concentrator_index =
      value_in(concentrator_number, 1.0, any, "it is below 1 (allowed: a refractive index, 1 or more).");
  receiver.filter_gain = gain.value_or(receiver.filter_gain);
}

void TableReader::read_row(const CsvRow& row) {
  if (!started_ && is_heading(row)) {
    columns_ = columns_of(row, where(row.line));
    started_ = true;
    return;
  }
  started_ = true;
  check_count(row);
  Receiver receiver;
  for (int k = 0; k < 3; ++k) {
    receiver.position[k] = number(row, static_cast<std::size_t>(k));
    receiver.normal[k] = number(row, static_cast<std::size_t>(k) + 3);
    if (!columns_.cells) continue;
    receiver.cell_u[k] = number(row, static_cast<std::size_t>(k) + 6);
    receiver.cell_v[k] = number(row, static_cast<std::size_t>(k) + 9);
  }
  read_optics(row, receiver);
  if (receiver.normal == glm::dvec3(0.0)) {
    throw InputError(where(row.line) +
                     ", has the normal 0,0,0 (allowed: any other). Give the direction that the receiver faces, for "
                     "example 0,1,0 for upwards.");
  }
  receiver.name = name_in(row);
  if (foreign_row_ == 0 && !is_utf8(receiver.name)) foreign_row_ = row.line;
  if (receiver.name.empty()) receiver.name = "receiver_" + std::to_string(table_.receivers.size());
  table_.receivers.push_back(std::move(receiver));
}

ReceiverTable TableReader::read() {
  std::istringstream in(text_);
  CsvReader reader(in, separator_, true);
  CsvRow row;
  try {
    while (reader.next(row)) {
      if (row.comment) {
        read_comment(row);
      } else if (row.line != separator_line_ && !is_empty(row)) {
        read_row(row);
      }
    }
  } catch (const CsvFault& fault) {
    throw InputError(where(fault.line) + ", " + fault.what +
                     " (allowed: a field in quotes from separator to separator, with quotes inside doubled). Correct "
                     "the quotes.");
  }
  if (table_.receivers.empty())
    throw InputError(name_ + " contains no receiver (allowed: at least one row " + std::string(forms) + ").");
  if (foreign_row_ != 0)
    table_.notes.push_back(where(foreign_row_) +
                           ": the name is not UTF-8. Tables of results keep its bytes; elsewhere some characters are "
                           "replaced. To avoid that, save the table as CSV in UTF-8.");
  if (!columns_.ignored.empty()) {
    std::string list;
    for (const std::string& column : columns_.ignored) list += (list.empty() ? "" : ", ") + column;
    const bool one = columns_.ignored.size() == 1;
    table_.notes.push_back(name_ + (one ? ": the column " : ": the columns ") + list + (one ? " is" : " are") +
                           " not read.");
  }
  return std::move(table_);
}

}  // namespace

ReceiverTable parse_receiver_table(std::string_view bytes, const std::string& name) {
  const std::string text = utf8_of(bytes, name);
  return TableReader(text, name).read();
}

ReceiverTable read_receiver_table(const std::filesystem::path& file) {
  const std::string bytes =
      require_regular_file(file, largest_receiver_table, in_quotes(file.string()),
                           "Check the name given to --receivers; --receivers - reads a table from stdin.");
  return parse_receiver_table(bytes, in_quotes(file.string()));
}

}  // namespace lichtmc
