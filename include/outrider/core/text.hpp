// Makes text from files and users safe to print: control characters and invalid UTF-8 become '?'.
//
// A character is printable if it is well-formed UTF-8 (no overlong form, no surrogate) and neither a control
// character (below U+0020, U+007F, or U+0080 to U+009F), on which terminals act, nor one that ends a line or
// turns the direction of the text after it (U+061C, U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069).
#pragma once

#include <string>
#include <string_view>

namespace outrider {

/// Returns true if the whole text is printable, so that it can be used as a name in a report.
bool is_printable(std::string_view text);

/// Returns the text with a '?' for each character that is not printable and for each byte that is part of
/// none. The ASCII characters in `kept` stay. O(text).
std::string printable(std::string_view text, std::string_view kept = {});

/// Returns the text of a stranger for use in a sentence: printable, and cut to `most` bytes, with "..." after
/// that. O(most).
std::string excerpt(std::string_view text, std::size_t most = 80);

/// Returns a number for use in a sentence: with nine significant digits, or thousandths if they are more, and
/// without the zeros at its end. Sizes below 10^-12, as rounding leaves them, are 0; there is no -0.
std::string short_number(double value);

/// Returns a place for use in a sentence: "(1.5, -2)".
std::string place_text(double x, double y);

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
