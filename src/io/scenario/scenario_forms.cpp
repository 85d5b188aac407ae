// Generates the schema, the commented YAML and the tables of scenarios.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "outrider/io/scenario/scenario.hpp"

namespace outrider {
namespace {

using Json = nlohmann::ordered_json;

bool is_number(const Option& option) {
  return std::holds_alternative<double*>(option.value) || std::holds_alternative<std::int64_t*>(option.value);
}

Json value_json(const Option& option) {
  std::string text = value_text(option);
  if (std::holds_alternative<std::string*>(option.value)) return text;
  return Json::parse(text, nullptr, false);
}

/// Returns a double-quoted YAML scalar. Every JSON string is one.
std::string quoted(const std::string& text) {
  return Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string unit_and_range(const Option& option) {
  std::string text = option.unit;
  if (is_number(option))
    text += fmt::format("{}{:g} to {:g}", text.empty() ? "" : ", ", option.low, option.high);
  return text;
}

/// Converts a bound of an integer option, which may exceed the range of integers.
std::int64_t whole(double bound) {
  constexpr double limit = 9.2e18;
  return static_cast<std::int64_t>(std::clamp(bound, -limit, limit));
}

Json option_schema(const Option& option) {
  Json schema;
  schema["type"] = type_name(option);
  schema["description"] =
      option.unit.empty() ? option.sentence : fmt::format("{} ({})", option.sentence, option.unit);
  if (std::holds_alternative<double*>(option.value)) {
    schema["minimum"] = option.low;
    schema["maximum"] = option.high;
  } else if (std::holds_alternative<std::int64_t*>(option.value)) {
    schema["minimum"] = whole(option.low);
    schema["maximum"] = whole(option.high);
  }
  if (!option.choices.empty()) {
    std::vector<std::string> names = option.choices;
    if (std::ranges::count(names, value_text(option)) == 0) names.insert(names.begin(), value_text(option));
    schema["enum"] = std::move(names);  // an empty name, where nothing need be chosen, is one too
  }
  schema["default"] = value_json(option);
  return schema;
}

std::string yaml_value(const Option& option) {
  const std::string text = value_text(option);
  return std::holds_alternative<std::string*>(option.value) ? quoted(text) : text;
}

std::string option_line(const Option& option, std::string_view indent) {
  const std::string range = unit_and_range(option);
  return fmt::format("{0}# {1}{2}\n{0}{3}: {4}\n", indent, option.sentence,
                     range.empty() ? range : fmt::format(" [{}]", range), option.name, yaml_value(option));
}

std::string table_cell(std::string_view text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c;
  }
  return cell;
}

}  // namespace

std::string scenario_schema(const std::vector<OptionGroup>& groups, const std::string& title) {
  Json schema;
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = title;
  schema["type"] = "object";
  Json& top = schema["properties"] = Json::object();
  for (const OptionGroup& group : groups) {
    Json options = Json::object();
    for (const Option& option : group.options) options[option.name] = option_schema(option);
    if (group.name.empty()) {
      top.update(options);
    } else {
      top[group.name] = {{"type", "object"},
                         {"description", group.sentence},
                         {"properties", std::move(options)},
                         {"additionalProperties", false}};
    }
  }
  schema["additionalProperties"] = false;
  return schema.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string scenario_text(const std::vector<OptionGroup>& groups) {
  std::string top;
  std::string sections;
  for (const OptionGroup& group : groups) {
    std::string& text = group.name.empty() ? top : sections;
    if (!group.name.empty()) text += fmt::format("\n# {}\n{}:\n", group.sentence, group.name);
    for (const Option& option : group.options) text += option_line(option, group.name.empty() ? "" : "  ");
  }
  return top + sections;
}

std::string scenario_changes(const std::vector<OptionGroup>& groups,
                             const std::vector<OptionGroup>& defaults) {
  std::string top;
  std::string sections;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const bool is_top = groups[i].name.empty();
    std::string lines;
    for (std::size_t k = 0; k < groups[i].options.size(); ++k) {
      const Option& option = groups[i].options[k];
      if (value_text(option) == value_text(defaults[i].options[k])) continue;
      lines += fmt::format("{}{}: {}\n", is_top ? "" : "  ", option.name, yaml_value(option));
    }
    if (is_top) top += lines;
    if (!is_top && !lines.empty()) sections += fmt::format("\n{}:\n{}", groups[i].name, lines);
  }
  return top + sections;
}

std::string options_markdown(const std::vector<OptionGroup>& groups) {
  std::string text;
  for (const OptionGroup& group : groups) {
    if (group.options.empty()) continue;
    text += fmt::format("{}{}\n\n", group.name.empty() ? group.name : fmt::format("### `{}`\n\n", group.name),
                        group.sentence);
    text += "| key | default | unit | range | meaning |\n|---|---|---|---|---|\n";
    for (const Option& option : group.options) {
      const std::string value = value_text(option);
      text += fmt::format("| `{}` | {} | {} | {} | {} |\n", option.name,
                          value.empty() ? value : fmt::format("`{}`", table_cell(value)), option.unit,
                          is_number(option) ? fmt::format("{:g} to {:g}", option.low, option.high) : "",
                          table_cell(option.sentence));
    }
    text += "\n";
  }
  return text;
}

}  // namespace outrider
