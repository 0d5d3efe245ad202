// Parts of messages: numbers, counts and names, in one form for all errors.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lichtmc {

// A number in the shortest form that reads back as the same double: "0.1", "1e+30", "nan".
std::string to_text(double value);

// A number rounded to this many digits (2 to 9), as people write it: "0.123", "12300", "0.00004", "1.6·10¹³".
std::string rounded(double value, int digits);
// A share (0 … 1) in percent; "unknown" if it is not finite.
std::string percent(double share);
std::string short_number(double value);  // to three digits

// A number with at most this many decimals: 2.50004 with three: "2.5".
std::string decimal(double value, int decimals);

// A coordinate in m, to the millimetre or, if that is finer, to three digits: "-5334759.625", "12.5", "0.000123".
std::string position_text(double coordinate_m);

// A count with its noun, in the singular or plural: "1 triangle", "12 triangles".
std::string to_text(std::size_t count, std::string_view singular);

// A name in quotes, "'name'", as visible_text(); an empty name gives "(no name)".
std::string in_quotes(std::string_view name);

// A list of names that shows the first few: "'a', 'b', 'c', 'd', 'e' and 4 more".
class Names {
 public:
  void add(const std::string& text);
  std::size_t count() const { return count_; }
  std::string text() const;

 private:
  std::size_t count_ = 0;
  std::string text_;
};

}  // namespace lichtmc
