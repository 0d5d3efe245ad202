// Texts from files in a form that is safe to print.
#pragma once

#include <string>
#include <string_view>

namespace lichtmc {

// A text on one line, as a terminal can show it. Names in room files and tables may contain any character; printed as
// they are, some would move the cursor, change the order of the text or add a line that looks like a message. Each of
// these becomes the visible escape \uXXXX (four hexadecimal digits, as in JSON): control characters (U+0000 … U+001F,
// U+007F … U+009F), the line and paragraph separators U+2028 and U+2029, the marks and overrides of writing direction
// (Unicode property Bidi_Control) and U+FEFF. A byte that is not UTF-8 becomes \xXX. All other text is unchanged.
std::string visible_text(std::string_view text);

}  // namespace lichtmc
