#include "log/log_lines.hpp"

#include <fmt/format.h>

#include <cmath>

namespace outrider {

Status for_each_line(const NamedText& text,
                     const std::function<Status(std::span<const std::string_view>)>& read) {
  constexpr std::size_t most_lines = 2'000'000;
  TextLines lines{text.text, text.name};
  while (lines.next_filled()) {
    if (lines.number > most_lines) {
      return bad_input(fmt::format("more than {} lines; shorten the file", most_lines), lines.where());
    }
    if (auto ok = read(words(lines.line)); !ok) return bad_input(ok.error().sentence, lines.where());
  }
  return {};
}

Outcome<std::vector<double>> line_numbers(std::span<const std::string_view> words, std::size_t count,
                                          std::string_view takes) {
  std::vector<double> result;
  for (const std::string_view word : words) {
    const auto value = number<double>(word);
    if (!value || std::abs(*value) > 1e12) {
      return bad_input(fmt::format("'{}' is no number of use; a line is {}", excerpt(word), takes));
    }
    result.push_back(*value);
  }
  if (result.size() == count) return result;
  return bad_input(fmt::format("{} numbers where a line is {}", result.size(), takes));
}

}  // namespace outrider
