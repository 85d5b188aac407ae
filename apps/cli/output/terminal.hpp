// The only output to the terminal: file names and values reach it as text, never as control sequences.
//
// Control characters and bytes that are not valid UTF-8 are printed as '?' (core/text.hpp). Sentences are one
// line.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace outrider::cli {

/// Prints the text on standard output, with its line breaks. run_tool() reports a failure.
void show_text(std::string_view text);

/// Formats the arguments and prints the text as show_text() does.
template <class... Arguments>
void show(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  show_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Prints "outrider: SENTENCE" on standard error.
void complain(std::string_view sentence);

/// Prints "outrider: warning: SENTENCE" on standard error, one line per sentence.
void warn(std::string_view sentence);
void warn(const std::vector<std::string>& sentences);

/// Prints the sentence as complain() does, and the text on standard output, both as they are and without
/// allocating memory.
void complain_without_memory(const char* sentence, const char* text);

}  // namespace outrider::cli
