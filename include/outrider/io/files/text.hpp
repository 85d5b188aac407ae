// Reads lines, words, numbers and lists of text formats.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
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

/// Returns the words as numbers; nothing unless all are finite numbers whose size is at most `largest`.
inline std::optional<std::vector<double>> numbers_of(std::span<const std::string_view> words,
                                                     double largest = std::numeric_limits<double>::max()) {
  std::vector<double> result;
  for (const std::string_view word : words) {
    const auto value = number<double>(word);
    if (!value || std::abs(*value) > largest) return std::nullopt;
    result.push_back(*value);
  }
  return result;
}

/// Returns the parts between separators, without the white space around them. An empty text is one part.
inline std::vector<std::string_view> parts_between(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Returns those of the parts that are not empty.
inline std::vector<std::string_view> filled_parts_between(std::string_view text, char separator) {
  std::vector<std::string_view> parts = parts_between(text, separator);
  std::erase(parts, "");
  return parts;
}

/// Returns the name of a file without ".gz" at its end.
inline std::string_view without_gz(std::string_view name) {
  return name.substr(0, name.size() - (name.ends_with(".gz") ? 3 : 0));
}

/// The lines of a text, one after the other.
struct TextLines {
  std::string_view rest;
  const std::string& name;  ///< the file
  std::size_t number = 0;   ///< the number of the line, from 1
  std::string_view line = {};

  /// Takes the next line. Returns false at the end.
  bool next() {
    const bool more = !rest.empty();
    ++number;
    line = take_line(rest);
    return more;
  }
  /// Takes the next line that has more than white space and a comment, which begins with '#'; `line` is then
  /// without the comment.
  bool next_filled() {
    while (next()) {
      line = line.substr(0, line.find('#'));
      if (line.find_first_not_of(white_space) != std::string_view::npos) return true;
    }
    return false;
  }
  /// Returns the place of the line for a fault, "name:number".
  [[nodiscard]] std::string where() const { return name + ':' + std::to_string(number); }
};

}  // namespace outrider
