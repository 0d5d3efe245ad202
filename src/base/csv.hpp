// Tables as text: rows of fields with separators between them (RFC 4180, and what spreadsheets write).
//
// The project reads its own tables and those of users with this reader. The libraries for CSV in Debian do not suffice:
// none tells the line of a row behind line ends in quotes, which a message needs, and fast-cpp-csv-parser does not read
// such line ends at all.
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace lichtmc {

struct CsvField {
  std::string text;     // without the quotes; blanks outside of quotes belong to it
  bool quoted = false;  // it was in quotes
};

struct CsvRow {
  std::vector<CsvField> fields;  // at least one; a row without any character has one empty field
  std::size_t line = 0;          // number of its first line, counted from 1 as editors do
  bool comment = false;          // it begins with #: its only field is the whole line
};

// A table that is not well-formed; `what` continues a sentence about the line.
struct CsvFault {
  std::size_t line = 0;
  std::string what;
};

// Reads a table row by row. A line ends with LF, CR LF or CR. A field in quotes (") may contain separators, line ends
// and doubled quotes. A quote inside a field without quotes is an ordinary character.
class CsvReader {
 public:
  // The separator is ',', ';', a tab or a blank; as a blank it is any number of blanks and tabs, and those at the start
  // and end of a line do not count. With `comments` a line whose first character behind blanks is # is one field. The
  // stream must outlive the reader.
  CsvReader(std::istream& in, char separator, bool comments = false);

  // Reads the next row; false at the end. Throws CsvFault for a quote that is not closed, or text behind one.
  bool next(CsvRow& row);

 private:
  int get();
  int peek();
  void skip_blanks();
  void read_line(std::string& text);
  bool read_field(CsvField& field);
  void read_quoted(CsvField& field);
  bool at_line_end(int c) const;
  void end_line(int c);

  std::streambuf* in_;
  char separator_;
  bool comments_;
  std::size_t line_ = 1;
};

// A text as a field of a table with commas, in quotes where that is necessary: CsvReader returns the same text.
std::string csv_field(std::string_view text);

}  // namespace lichtmc
