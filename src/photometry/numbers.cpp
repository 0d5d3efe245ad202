#include "photometry/numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/visible_text.hpp"

namespace lichtmc {

namespace {

bool is_separator(char c) {
  return static_cast<unsigned char>(c) <= ' ' || c == ',';
}

// A count: `word` is how it is written, `value` its value.
long whole_number(const Origin& origin, std::size_t line, std::string_view what, std::string_view word, double value,
                  long low, long high, std::vector<std::string>& notes) {
  if (value != std::floor(value))
    origin.refuse(line, "the " + std::string(what) + " is " + to_text(value) + ". Allowed: a whole number, " +
                            std::to_string(low) + " to " + std::to_string(high) + ".");
  if (value > static_cast<double>(high))
    origin.refuse(line, "the " + std::string(what) + " is " + decimal(value, 0) + "; at most " + std::to_string(high) +
                            " are read. Correct the number, or use a file with a coarser grid.");
  if (value < static_cast<double>(low))
    origin.refuse(line, "the " + std::string(what) + " is " + decimal(value, 0) + "; at least " + std::to_string(low) +
                            (low == 1 ? " is" : " are") + " needed. Correct the number.");
  if (word.find_first_of(".,eE") != std::string_view::npos)
    notes.push_back("Line " + std::to_string(line) + ": the " + std::string(what) + " is written " +
                    in_double_quotes(word) + "; it is read as " + decimal(value, 0) + ".");
  return static_cast<long>(value);
}

}  // namespace

void Origin::refuse(std::size_t line, const std::string& what) const {
  throw InputError(visible_text(source) + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what);
}

std::string in_double_quotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  if (word.size() <= longest) return "\"" + visible_text(word) + "\"";
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(word[end]) & 0xC0U) == 0x80U) --end;
  return "\"" + visible_text(word.substr(0, end)) + "…\"";
}

std::optional<double> number_of(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value + 0.0;  // −0 is 0
}

NumberStream::NumberStream(std::string_view text, std::size_t first_line, const Origin& origin,
                           std::vector<std::string>& notes)
    : text_(text), line_(first_line), next_line_(first_line), origin_(&origin), notes_(&notes) {}

void NumberStream::skip_separators() {
  while (at_ < text_.size() && is_separator(text_[at_])) {
    const char c = text_[at_++];
    const bool pair = c == '\r' && at_ < text_.size() && text_[at_] == '\n';
    if ((c == '\n' || c == '\r') && !pair) ++next_line_;
  }
}

std::string_view NumberStream::word() {
  skip_separators();
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_separator(text_[at_])) ++at_;
  line_ = next_line_;
  return text_.substr(start, at_ - start);
}

bool NumberStream::at_end() {
  skip_separators();
  return at_ == text_.size();
}

std::size_t NumberStream::skip_all() {
  std::size_t words = 0;
  while (!at_end()) {
    word();
    ++words;
  }
  return words;
}

double NumberStream::number(std::string_view what) {
  if (at_end()) origin_->refuse("the file ends where the " + std::string(what) + " should follow. Get the whole file.");
  const std::string_view found = word();
  const std::optional<double> value = number_of(found);
  if (!value)
    origin_->refuse(line_, in_double_quotes(found) + " is not a number (" + std::string(what) +
                               "). Write a number there, such as 50 or 0.95.");
  return *value;
}

long NumberStream::whole(std::string_view what, long low, long high) {
  if (!at_end()) {
    const std::size_t start = at_;
    const double value = number(what);
    return whole_number(*origin_, line_, what, text_.substr(start, at_ - start), value, low, high, *notes_);
  }
  return static_cast<long>(number(what));
}

NumberLines::NumberLines(std::string_view text, const Origin& origin, std::vector<std::string>& notes)
    : lines_(text), origin_(&origin), notes_(&notes) {}

bool NumberLines::at_end() {
  std::string_view line;
  while (!ahead_) {
    if (!lines_.next(line)) return true;
    // ^Z ends a file of DOS.
    if (without_blanks(line).empty() && (skip_empty_ || without_blanks(lines_.rest()).empty())) continue;
    ahead_ = line;
  }
  return false;
}

std::string_view NumberLines::next(std::string_view what) {
  if (at_end()) origin_->refuse("the file ends where the " + std::string(what) + " should follow. Get the whole file.");
  const std::string_view line = *ahead_;
  ahead_.reset();
  line_ = lines_.line();
  return without_blanks(line);
}

std::size_t NumberLines::skip_all() {
  skip_empty_lines();
  std::size_t count = 0;
  while (!at_end()) {
    ahead_.reset();
    ++count;
  }
  return count;
}

std::string NumberLines::text(std::string_view what) {
  return text_of(next(what));
}

double NumberLines::number(std::string_view what) {
  const std::string_view word = next(what);
  std::optional<double> value;
  if (std::count(word.begin(), word.end(), ',') == 1 && word.find('.') == std::string_view::npos) {
    std::string point(word);
    std::replace(point.begin(), point.end(), ',', '.');
    value = number_of(point);
  } else {
    value = number_of(word);
  }
  if (!value)
    origin_->refuse(line_, (word.empty() ? "an empty line" : in_double_quotes(word)) + " is not a number (" +
                               std::string(what) + "); is a line missing above? Correct the file, or get it anew.");
  return *value;
}

long NumberLines::whole(std::string_view what, long low, long high) {
  const bool ended = at_end();
  const std::string_view word = ended ? std::string_view() : without_blanks(*ahead_);
  const double value = number(what);
  return whole_number(*origin_, line_, what, word, value, low, high, *notes_);
}

}  // namespace lichtmc
