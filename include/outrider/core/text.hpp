// Makes text from files and users safe to print: control characters and invalid UTF-8 become '?'.
//
// A character is printable if it is well-formed UTF-8 (no overlong form, no surrogate) and not a control
// character (below U+0020, U+007F, or U+0080 to U+009F), because terminals act on control characters.
#pragma once

#include <string>
#include <string_view>

namespace outrider {

/// Returns true if the whole text is printable, so that it can be used as a name in a report.
bool is_printable(std::string_view text);

/// Returns the text with a '?' for each byte that is not part of a printable character. The control
/// characters in `kept` stay. O(text).
std::string printable(std::string_view text, std::string_view kept = {});

/// Returns the lower case of an ASCII letter, and other characters as they are.
constexpr char lower_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Returns the text with ASCII letters in lower case.
std::string lower(std::string_view text);

inline constexpr std::string_view white_space = " \t\r\n\f\v";

/// Returns the text without the white space at both of its ends.
std::string_view trimmed(std::string_view text);

/// Returns the printable text as character data of HTML or SVG.
std::string markup_text(std::string_view text);

/// Returns a duration as text, e.g. "1 min 21 s", "42.0 s" or "0.31 s".
std::string duration_text(double seconds);

}  // namespace outrider
