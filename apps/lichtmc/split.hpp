// Parts of an argument of the command line.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace lichtmc::app {

// The parts between separators, also empty ones.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

}  // namespace lichtmc::app
