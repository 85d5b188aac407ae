// The one way to the terminal: names of files and values reach it as text, never as commands to it.
//
// Control characters and bytes that are no UTF-8 are printed as '?' (core/text.hpp); sentences are one line.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace outrider::cli {

/// Prints the text on standard output, with its ends of lines. main() tells of a failure.
void show_text(std::string_view text);

/// The same of a format and its arguments.
template <class... Arguments>
void show(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  show_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Prints "outrider: SENTENCE" on standard error.
void complain(std::string_view sentence);

/// Prints "outrider: warning: SENTENCE" on standard error, a line for each.
void warn(std::string_view sentence);
void warn(const std::vector<std::string>& sentences);

}  // namespace outrider::cli
