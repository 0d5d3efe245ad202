#include "base/names.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>

#include "base/message.hpp"
#include "base/utf8.hpp"

namespace lichtmc {

namespace {

// The characters of a UTF-8 text; each byte of an invalid one is a character.
std::u32string characters_of(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) {
    const Character next = first_character(text);
    characters.push_back(next.bytes > 0 ? next.code : static_cast<unsigned char>(text.front()));
    text.remove_prefix(std::max<std::size_t>(next.bytes, 1));
  }
  return characters;
}

// A part of a pattern that stands for one character: it ends before `end`.
struct OneCharacter {
  bool fits = false;
  std::size_t end = 0;
};

// The set "[…]" that begins at `begin`; none if it has no end, so that "[" stands for itself.
std::optional<OneCharacter> fits_set(const std::u32string& pattern, std::size_t begin, char32_t c) {
  std::size_t k = begin + 1;
  const bool inverted = k < pattern.size() && (pattern[k] == U'!' || pattern[k] == U'^');
  if (inverted) ++k;
  bool inside = false;
  for (const std::size_t first = k; k < pattern.size(); ++k) {
    if (pattern[k] == U']' && k > first) return OneCharacter{inside != inverted, k + 1};
    if (k + 2 < pattern.size() && pattern[k + 1] == U'-' && pattern[k + 2] != U']') {
      inside = inside || (pattern[k] <= c && c <= pattern[k + 2]);
      k += 2;
    } else {
      inside = inside || pattern[k] == c;
    }
  }
  return std::nullopt;
}

OneCharacter fits_one(const std::u32string& pattern, std::size_t at, char32_t c) {
  if (pattern[at] == U'?') return {true, at + 1};
  if (pattern[at] == U'[') {
    if (const auto set = fits_set(pattern, at, c)) return *set;
  }
  return {pattern[at] == c, at + 1};
}

}  // namespace

bool matches_pattern(std::string_view pattern_text, std::string_view name_text) {
  if (pattern_text == name_text) return true;
  const std::u32string pattern = characters_of(pattern_text);
  const std::u32string name = characters_of(name_text);
  std::size_t p = 0;
  std::size_t n = 0;
  // After a "*": where the pattern goes on, and the first character of the name that the "*" does not take yet. The
  // last "*" alone needs to take more, so that the time is at most length × length.
  std::optional<std::size_t> after_star;
  std::size_t taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == U'*') {
      after_star = ++p;
      taken = n;
      continue;
    }
    const OneCharacter one = p < pattern.size() ? fits_one(pattern, p, name[n]) : OneCharacter{};
    if (one.fits) {
      p = one.end;
      ++n;
    } else if (after_star) {
      p = *after_star;
      n = ++taken;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == U'*') ++p;
  return p == pattern.size();
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const bool same = lower(a[i - 1]) == lower(b[k - 1]);
      row[k] = std::min({last[k] + 1, row[k - 1] + 1, last[k - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && k > 1 && lower(a[i - 1]) == lower(b[k - 2]) && lower(a[i - 2]) == lower(b[k - 1]);
      if (swapped) row[k] = std::min(row[k], before[k - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string nearest_names(std::string_view name, std::vector<std::string> names) {
  constexpr std::size_t shown = 5;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  if (names.empty()) return "none";
  constexpr std::size_t longest = 200;  // the time grows with the product of the lengths
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& one : names) {
    if (one.size() > longest || name.size() > longest) continue;
    const std::size_t distance = edit_distance(name, one);
    const bool contains = one.find(name) != std::string::npos || (!one.empty() && name.find(one) != std::string::npos);
    if (3 * distance <= std::max(name.size(), one.size()) || contains) near.emplace_back(distance, one);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (near.empty()) {
    for (const std::string& one : names) near.emplace_back(0, one);
  }
  std::string list;
  for (std::size_t k = 0; k < std::min(shown, near.size()); ++k)
    list += (k == 0 ? "" : ", ") + in_quotes(near[k].second);
  if (near.size() > shown) list += ", …";
  return list;
}

}  // namespace lichtmc
