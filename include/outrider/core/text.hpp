// Makes text from files and users safe to print: control characters and invalid UTF-8 become '?'.
//
// A character is printable when it is well-formed UTF-8 (no overlong form, no surrogate) and no control
// character: none below U+0020, not U+007F, none from U+0080 to U+009F. Terminals act on those.
#pragma once

#include <string>
#include <string_view>

namespace outrider {

/// True when all of the text is printable: what may stand as a name in a report.
bool is_printable(std::string_view text);

/// The text with a '?' for each byte that belongs to no printable character; those in `kept` stay. O(text).
std::string printable(std::string_view text, std::string_view kept = {});

/// "1 min 21 s", "42.0 s", "0.31 s".
std::string duration_text(double seconds);

}  // namespace outrider
