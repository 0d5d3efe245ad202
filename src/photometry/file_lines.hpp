// Lines of a text file, which end with LF, CR LF or CR.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lichtmc {

// Goes through a text line by line, without copies. The text must outlive it.
class FileLines {
 public:
  // first_line: the number of the first line of the text.
  explicit FileLines(std::string_view text, std::size_t first_line = 1) : rest_(text), line_(first_line - 1) {}

  // The next line, without its end; false behind the last one.
  bool next(std::string_view& line);
  // Number of the line that was read last, from 1.
  std::size_t line() const { return line_; }
  // What follows it.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t line_;
};

// Without blanks, tabs and other control characters at both ends.
std::string_view without_blanks(std::string_view text);

// Whether a text begins with `start`; upper and lower case of ASCII are the same.
bool begins_with(std::string_view text, std::string_view start);
bool same_word(std::string_view a, std::string_view b);

bool is_utf8(std::string_view text);

// A text of the file as UTF-8: what is not UTF-8 is taken as Windows-1252, in which most programs for photometric files
// write.
std::string text_of(std::string_view bytes);

}  // namespace lichtmc
