// Reads lines, words and numbers of text formats.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/text.hpp"

namespace outrider {

/// Removes the next line from `rest` and returns it without its end ("\n" or "\r\n").
inline std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// Removes the next word and the white space before it from `rest`. Returns the word; empty at the end.
inline std::string_view take_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(white_space), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(white_space));
  rest.remove_prefix(word.size());
  return word;
}

/// Returns the first words of a text, at most `most`.
inline std::vector<std::string_view> words(std::string_view text, std::size_t most = std::string_view::npos) {
  std::vector<std::string_view> result;
  for (std::string_view word; result.size() < most && !(word = take_word(text)).empty();)
    result.push_back(word);
  return result;
}

/// Parses the whole text as a finite number or an integer; a leading + is allowed. Returns nothing otherwise.
template <class Number>
std::optional<Number> number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() ||
      !std::isfinite(static_cast<double>(value))) {
    return std::nullopt;
  }
  return value;
}

}  // namespace outrider
