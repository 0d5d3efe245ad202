// The encoding of text files that users give.
#pragma once

#include <string>
#include <string_view>

namespace lichtmc {

// The text of a file as UTF-8: a byte order mark is removed, UTF-16 with a byte order mark is converted; any other
// text is returned unchanged. Throws InputError that names the file for UTF-32, UTF-16 without a byte order mark or
// with half a character, and for spreadsheet files (.xlsx, .ods, .xls), with `remedy`: what to do, a sentence.
std::string utf8_of(std::string_view bytes, const std::string& name,
                    const std::string& remedy = "Save it as CSV in UTF-8.");

}  // namespace lichtmc
