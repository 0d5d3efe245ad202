// The file of a message: "lamp.ies:14: what is wrong. What to do."
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lichtmc {

struct Origin {
  std::string source;  // name of the file

  // Throws InputError. line: counted from 1, 0 for none; what: one or two sentences on one line.
  [[noreturn]] void refuse(std::size_t line, const std::string& what) const;
  [[noreturn]] void refuse(const std::string& what) const { refuse(0, what); }
};

// A word of a file as it stands there, in double quotes; the start of it if it is long.
std::string in_double_quotes(std::string_view word);

}  // namespace lichtmc
