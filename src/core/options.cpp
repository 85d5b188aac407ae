#include "outrider/core/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "outrider/core/overload.hpp"
#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

std::string expectation(const Option& option, std::string_view kind) {
  return fmt::format("{} from {:g} to {:g}{}{}", kind, option.low, option.high,
                     option.unit.empty() ? "" : " ", option.unit);
}

template <class Number>
Outcome<Number> parse(const Option& option, std::string_view text, std::string_view kind) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const auto as_double = static_cast<double>(number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(as_double) ||
      as_double < option.low || as_double > option.high) {
    return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(text), expectation(option, kind)),
                     option.name);
  }
  return number;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({substitute, row[j] + 1, row[j - 1] + 1}));
    }
  }
  return row.back();
}

}  // namespace

Option file_option(std::string name, std::string sentence, std::string* path) {
  return {std::move(name), "", 0.0, 0.0, std::move(sentence), path, true};
}

Option choice_option(std::string name, std::string sentence, std::string* value,
                     std::vector<std::string> choices) {
  return {std::move(name), "", 0.0, 0.0, std::move(sentence), value, false, std::move(choices)};
}

Status assign(const Option& option, std::string_view text) {
  const auto number = [&](double* value) -> Status {
    auto parsed = parse<double>(option, text, "a number");
    if (!parsed) return pass_on(parsed);
    *value = option.unit == "deg" ? radians(*parsed) : *parsed;
    return {};
  };
  const auto integer = [&](std::int64_t* value) -> Status {
    auto parsed = parse<std::int64_t>(option, text, "a whole number");
    if (!parsed) return pass_on(parsed);
    *value = *parsed;
    return {};
  };
  const auto boolean = [&](bool* value) -> Status {
    if (text != "true" && text != "false") {
      return bad_input(fmt::format("'{}' is not valid; expected true or false", excerpt(text)), option.name);
    }
    *value = text == "true";
    return {};
  };
  const auto string = [&](std::string* value) -> Status {
    *value = std::string(text);
    return {};
  };
  return std::visit(Overload{number, integer, boolean, string}, option.value);
}

Status check_ranges(const std::vector<Option>& options, const std::string& section) {
  for (const Option& option : options) {
    const auto ok = assign(option, value_text(option));
    if (ok) continue;
    const std::string& name = ok.error().where;
    return bad_input(ok.error().sentence, section.empty() ? name : fmt::format("{}.{}", section, name));
  }
  return {};
}

std::string value_text(const Option& option) {
  const auto number = [&](const double* value) {
    if (option.unit != "deg") return fmt::format("{}", *value);
    const double rounded = std::round(degrees(*value) * 1e9) / 1e9;  // 45 reads as 45
    return fmt::format("{}", rounded);
  };
  return std::visit(Overload{number, [](const std::int64_t* value) { return fmt::format("{}", *value); },
                             [](const bool* value) { return fmt::format("{}", *value); },
                             [](const std::string* value) { return *value; }},
                    option.value);
}

std::string_view type_name(const Option& option) {
  constexpr std::string_view names[] = {"number", "integer", "boolean", "string"};
  return names[option.value.index()];
}

std::string nearest_name(std::string_view unknown, const std::vector<std::string>& known) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, unknown.size() / 2) + 1;
  for (const std::string& name : known) {
    const std::size_t distance = edit_distance(unknown, name);
    if (distance < least) {
      least = distance;
      best = name;
    }
  }
  return best;
}

tl::unexpected<Fault> no_such_row(std::string_view kind, std::string_view unknown,
                                  const std::vector<std::string>& known, std::string where) {
  const std::string shown = excerpt(unknown);
  const std::string nearest = nearest_name(shown, known);
  constexpr std::size_t most_names = 180;  // bytes
  const std::string names = excerpt(fmt::format("{}", fmt::join(known, ", ")), most_names);
  const std::string remedy =
      nearest.empty() ? fmt::format("take one of {}", names) : fmt::format("did you mean '{}'?", nearest);
  return bad_input(fmt::format("there is no {} '{}'; {}", kind, shown, remedy), std::move(where));
}

}  // namespace outrider
