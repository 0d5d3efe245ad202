// Numbers of photometric files, with the lines in which they stand.
//
// Independent of the locale: "." is the decimal point, in EULUMDAT files "," as well. "nan" and "inf" are no numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "photometry/file_lines.hpp"
#include "photometry/origin.hpp"

namespace lichtmc {

// A finite number that is the whole word; none otherwise.
std::optional<double> number_of(std::string_view word);

// The numbers of an IES file: words between blanks, commas and line ends.
class NumberStream {
 public:
  // notes: where a count that is not written as a whole number ("4.0") is noted.
  NumberStream(std::string_view text, std::size_t first_line, const Origin& origin, std::vector<std::string>& notes);

  // The next number. Refuses the file if it has ended, or the word is not a number; what: its meaning.
  double number(std::string_view what);
  // A whole number within limits.
  long whole(std::string_view what, long low, long high);
  // Whether no word follows.
  bool at_end();
  // Number of the words that follow, which are passed over.
  std::size_t skip_all();

  std::size_t line() const { return line_; }  // of the last number
  std::size_t bytes_left() const { return text_.size() - at_; }
  const Origin& origin() const { return *origin_; }

 private:
  std::string_view word();
  void skip_separators();

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_;
  std::size_t next_line_;
  const Origin* origin_;
  std::vector<std::string>* notes_;
};

// The lines of a EULUMDAT file: each has one text or one number.
class NumberLines {
 public:
  NumberLines(std::string_view text, const Origin& origin, std::vector<std::string>& notes);

  std::string text(std::string_view what);
  double number(std::string_view what);
  long whole(std::string_view what, long low, long high);
  // From now on empty lines do not count.
  void skip_empty_lines() { skip_empty_ = true; }
  bool at_end();
  std::size_t skip_all();

  std::size_t line() const { return line_; }
  std::size_t bytes_left() const { return lines_.rest().size(); }
  const Origin& origin() const { return *origin_; }

 private:
  std::string_view next(std::string_view what);

  FileLines lines_;
  std::size_t line_ = 0;
  std::optional<std::string_view> ahead_;
  bool skip_empty_ = false;
  const Origin* origin_;
  std::vector<std::string>* notes_;
};

}  // namespace lichtmc
