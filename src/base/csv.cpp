#include "base/csv.hpp"

namespace lichtmc {

namespace {

constexpr int end_of_text = std::char_traits<char>::eof();

bool is_blank(int c) {
  return c == ' ' || c == '\t';
}

}  // namespace

CsvReader::CsvReader(std::istream& in, char separator, bool comments)
    : in_(in.rdbuf()), separator_(separator), comments_(comments) {}

int CsvReader::get() {
  return in_->sbumpc();
}

int CsvReader::peek() {
  return in_->sgetc();
}

// Blanks between fields, or around quotes; a tab may be the separator.
void CsvReader::skip_blanks() {
  while (is_blank(peek()) && (peek() != separator_ || separator_ == ' ')) get();
}

bool CsvReader::at_line_end(int c) const {
  return c == end_of_text || c == '\n' || c == '\r';
}

// Counts a line end; c is its first character.
void CsvReader::end_line(int c) {
  if (c == end_of_text) return;
  if (c == '\r' && peek() == '\n') get();
  ++line_;
}

void CsvReader::read_line(std::string& text) {
  int c = get();
  for (; !at_line_end(c); c = get()) text += static_cast<char>(c);
  end_line(c);
}

// The opening quote has been read. A line end in it is kept as it is.
void CsvReader::read_quoted(CsvField& field) {
  field.quoted = true;
  const std::size_t opened = line_;
  for (int c = get();; c = get()) {
    if (c == end_of_text) throw CsvFault{opened, "opens a quote that is not closed"};
    if (c == '"') {
      if (peek() != '"') break;
      get();
    }
    field.text += static_cast<char>(c);
    if (c == '\n' || (c == '\r' && peek() != '\n')) ++line_;
  }
  if (separator_ == ' ') return;  // the next field may follow at once
  skip_blanks();
  if (const int c = peek(); c != separator_ && !at_line_end(c))
    throw CsvFault{line_, "has text between a closing quote and the next separator"};
}

// Returns whether another field follows in the row.
bool CsvReader::read_field(CsvField& field) {
  if (separator_ == ' ') skip_blanks();
  bool blank = true;
  int c = get();
  for (; c != separator_ && !at_line_end(c); c = get()) {
    if (separator_ == ' ' && c == '\t') break;
    if (c == '"' && blank) {
      field.text.clear();
      read_quoted(field);
      c = get();
      break;
    }
    blank = blank && is_blank(c);
    field.text += static_cast<char>(c);
  }
  if (separator_ == ' ') {
    while (is_blank(c)) c = get();
    if (at_line_end(c)) {
      end_line(c);
      return false;
    }
    in_->sungetc();
    return true;
  }
  if (c == separator_) return true;
  end_line(c);
  return false;
}

bool CsvReader::next(CsvRow& row) {
  if (peek() == end_of_text) return false;
  row.fields.clear();
  row.line = line_;
  if (comments_) skip_blanks();
  row.comment = comments_ && peek() == '#';
  row.fields.emplace_back();
  if (row.comment) {
    read_line(row.fields.back().text);
    return true;
  }
  while (read_field(row.fields.back())) row.fields.emplace_back();
  return true;
}

// Blanks at the ends are quoted because some programs remove them from fields without quotes.
std::string csv_field(std::string_view text) {
  const bool blank_ends = !text.empty() && (is_blank(text.front()) || is_blank(text.back()));
  if (text.find_first_of(",\"\r\n") == std::string_view::npos && !blank_ends) return std::string(text);
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

}  // namespace lichtmc
