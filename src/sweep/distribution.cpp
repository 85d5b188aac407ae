#include "outrider/sweep/distribution.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

struct DistributionRow {
  std::string_view name;
  Distribution::Kind kind;
  std::string_view form;
};
constexpr std::array<DistributionRow, 5> distributions = {{
    {"uniform", Distribution::Kind::uniform, "uniform(low,high) with low < high"},
    {"log_uniform", Distribution::Kind::log_uniform, "log_uniform(low,high) with 0 < low < high"},
    {"integer", Distribution::Kind::integer, "integer(low,high) with whole numbers, low <= high"},
    {"normal", Distribution::Kind::normal, "normal(mean,deviation) with a deviation above 0"},
    {"choice", Distribution::Kind::choice, "choice(a,b,...) with two words or more"},
}};
constexpr double largest_integer = 9e15;

bool in_a_name(char c) { return (c >= 'a' && c <= 'z') || c == '_'; }

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.emplace_back(trimmed(text.substr(begin, end == std::string_view::npos ? end : end - begin)));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

/// Splits at semicolons, or at commas if there are none.
std::vector<std::string> split_list(std::string_view text) {
  return split(text, text.find(';') == std::string_view::npos ? ',' : ';');
}

bool has_empty(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word.empty()) return true;
  }
  return false;
}

std::optional<Distribution> parse_arguments(const DistributionRow& row, std::string_view arguments) {
  Distribution found{.kind = row.kind};
  if (row.kind == Distribution::Kind::choice) {
    found.words = split_list(arguments);
    if (found.words.size() < 2 || has_empty(found.words)) return std::nullopt;
    return found;
  }
  const auto words = split(arguments, ',');
  if (words.size() != 2) return std::nullopt;
  const auto first = number<double>(words[0]), second = number<double>(words[1]);
  if (!first || !second) return std::nullopt;
  found.first = *first;
  found.second = *second;
  const bool whole = std::floor(*first) == *first && std::floor(*second) == *second &&
                     std::abs(*first) <= largest_integer && std::abs(*second) <= largest_integer;
  const bool ordered = *first < *second && std::isfinite(*second - *first);
  switch (row.kind) {
    case Distribution::Kind::uniform: return ordered ? std::optional(found) : std::nullopt;
    case Distribution::Kind::log_uniform: return ordered && *first > 0 ? std::optional(found) : std::nullopt;
    case Distribution::Kind::integer: return whole && *first <= *second ? std::optional(found) : std::nullopt;
    case Distribution::Kind::normal: return *second > 0 ? std::optional(found) : std::nullopt;
    case Distribution::Kind::choice: break;
  }
  return std::nullopt;
}

/// Reads the first NAME(ARGUMENTS) in `text` into `into`, and removes it with the text before. Returns false
/// if there is none.
Outcome<bool> take_distribution(std::string_view& text, Varied& into) {
  for (std::size_t open = text.find('('); open != std::string_view::npos; open = text.find('(', open + 1)) {
    std::size_t begin = open;
    while (begin > 0 && in_a_name(text[begin - 1])) --begin;
    if (begin == open) continue;
    const std::string_view name = text.substr(begin, open - begin);
    const DistributionRow* row = nullptr;
    for (const DistributionRow& one : distributions) {
      if (one.name == name) row = &one;
    }
    if (row == nullptr) {
      return bad_input(fmt::format("there is no distribution '{}'; take one of uniform, log_uniform, "
                                   "integer, normal and choice",
                                   excerpt(name)),
                       into.key);
    }
    const std::size_t close = text.find(')', open);
    const auto found = close == std::string_view::npos
                           ? std::nullopt
                           : parse_arguments(*row, text.substr(open + 1, close - open - 1));
    if (!found) {
      return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(text.substr(begin)), row->form),
                       into.key);
    }
    into.texts.emplace_back(text.substr(0, begin));
    into.parts.push_back(*found);
    text.remove_prefix(close + 1);
    return true;
  }
  return false;
}

/// Returns the text with a value in the place of each distribution.
template <class ValueOf>
std::string filled(const Varied& varied, const ValueOf& value_of) {
  std::string text = varied.texts.front();
  for (std::size_t i = 0; i < varied.parts.size(); ++i) {
    text += value_of(varied.parts[i]);
    text += varied.texts[i + 1];
  }
  return text;
}

std::string draw_one(const Distribution& from, Rng& rng) {
  switch (from.kind) {
    case Distribution::Kind::uniform: return fmt::format("{}", rng.uniform(from.first, from.second));
    case Distribution::Kind::log_uniform:
      return fmt::format("{}", std::exp(rng.uniform(std::log(from.first), std::log(from.second))));
    case Distribution::Kind::integer: {
      const auto count = static_cast<std::uint64_t>(from.second - from.first) + 1;
      return fmt::format("{}",
                         static_cast<std::int64_t>(from.first) + static_cast<std::int64_t>(rng.below(count)));
    }
    case Distribution::Kind::normal: return fmt::format("{}", from.first + from.second * rng.normal());
    case Distribution::Kind::choice: return from.words[rng.below(from.words.size())];
  }
  return {};
}

}  // namespace

bool Varied::is_random_number() const {
  return parts.size() == 1 && texts.front().empty() && texts.back().empty() &&
         parts.front().kind != Distribution::Kind::choice;
}

Outcome<Varied> parse_varied(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0 || equals + 1 == text.size()) {
    return bad_input(fmt::format("'{}' is not valid; expected KEY=VALUES, such as seed=1,2,3 or "
                                 "robot.radius=uniform(0.1,0.3)",
                                 excerpt(text)),
                     "--vary");
  }
  Varied varied{.key = std::string(trimmed(text.substr(0, equals))), .grid = {}, .texts = {}, .parts = {}};
  std::string_view rest = trimmed(text.substr(equals + 1));
  for (;;) {
    const auto more = take_distribution(rest, varied);
    if (!more) return pass_on(more);
    if (!*more) break;
  }
  if (!varied.parts.empty()) {
    varied.texts.emplace_back(rest);
    return varied;
  }
  varied.grid = split_list(rest);
  if (has_empty(varied.grid)) {
    return bad_input(fmt::format("'{}' has an empty value; remove a comma or semicolon", excerpt(rest)),
                     varied.key);
  }
  return varied;
}

std::string draw(const Varied& varied, Rng rng) {
  return filled(varied, [&](const Distribution& from) { return draw_one(from, rng); });
}

std::vector<std::string> extreme_values(const Varied& varied) {
  if (!varied.is_random()) return varied.grid;
  std::vector<std::string> values;
  const auto add = [&](bool last) {
    values.push_back(filled(varied, [&](const Distribution& from) {
      if (from.kind == Distribution::Kind::choice) return last ? from.words.back() : from.words.front();
      const bool mean = from.kind == Distribution::Kind::normal;
      return fmt::format("{}", last && !mean ? from.second : from.first);
    }));
  };
  add(false);
  add(true);
  const Distribution& only = varied.parts.front();
  if (varied.parts.size() == 1 && only.kind == Distribution::Kind::choice) {
    values.clear();
    for (const std::string& word : only.words) values.push_back(varied.texts[0] + word + varied.texts[1]);
  }
  return values;
}

}  // namespace outrider
