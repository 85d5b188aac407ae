#include "outrider/io/scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>

#include "files/yaml.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

/// Returns a function that gives all options their present values back, for when a file is refused.
std::function<void()> way_back(const std::vector<OptionGroup>& groups) {
  std::vector<std::function<void()>> steps;
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options)
      std::visit([&](auto* value) { steps.push_back([value, old = *value] { *value = old; }); },
                 option.value);
  }
  return [steps = std::move(steps)] {
    for (const auto& step : steps) step();
  };
}

std::string did_you_mean(const std::string& unknown, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(unknown.substr(0, 64), known);
  if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
  if (known.empty()) return "there are none here";
  constexpr std::size_t most = 200;  // characters of names
  std::size_t told = 0, length = 0;
  while (told < known.size() && length + known[told].size() <= most) length += known[told++].size() + 2;
  const std::string names = fmt::format("known are {}", fmt::join(std::span(known).first(told), ", "));
  return told == known.size() ? names : fmt::format("{} and {} more", names, known.size() - told);
}

/// Returns the reason why a node cannot be a value of the option, or an empty text. assign() checks the rest.
std::string_view type_fault(const Option& option, const YAML::Node& value) {
  if (value.IsMap()) return "it is no section; expected one value";
  if (value.IsSequence())
    return "expected one value, not a list; write text such as \"1,2,3\" where it takes several";
  if (!value.IsScalar()) return "its value is missing";
  const bool quoted = value.Tag() == "!";
  if (quoted && !std::holds_alternative<std::string*>(option.value))
    return "expected no quoted text; take the quotes away";
  if (!is_printable(value.Scalar())) return "its text holds control characters or is not UTF-8";
  return {};
}

Status set_option(const OptionGroup& group, const YAML::Node& key, const YAML::Node& value,
                  const std::string& name) {
  const std::string full = group.name.empty() ? key.Scalar() : fmt::format("{}.{}", group.name, key.Scalar());
  const auto option = std::ranges::find(group.options, key.Scalar(), &Option::name);
  if (option == group.options.end()) {
    std::vector<std::string> known;
    known.reserve(group.options.size());
    for (const Option& candidate : group.options) known.push_back(candidate.name);
    return bad_input(
        fmt::format("'{}' is no known key; {}", excerpt(full), did_you_mean(key.Scalar(), known)),
        yaml_where(name, key));
  }
  if (const auto fault = type_fault(*option, value); !fault.empty()) {
    return bad_input(fmt::format("{}: {}", full, fault), yaml_where(name, key));
  }
  if (auto assigned = assign(*option, value.Scalar()); !assigned) {
    return bad_input(fmt::format("{}: {}", full, assigned.error().sentence), yaml_where(name, key));
  }
  return {};
}

Status set_section(const OptionGroup& group, const YAML::Node& key, const YAML::Node& section,
                   const std::string& name) {
  if (section.IsNull()) return {};
  if (!section.IsMap()) {
    return bad_input(fmt::format("'{}' is a section; its keys stand indented below it", group.name),
                     yaml_where(name, key));
  }
  for (const auto& entry : section) {
    if (auto set = set_option(group, entry.first, entry.second, name); !set) return set;
  }
  return {};
}

Status set_all(const YAML::Node& root, const std::string& name, const std::vector<OptionGroup>& groups) {
  std::vector<std::string> known;
  OptionGroup top;
  for (const OptionGroup& group : groups) {
    if (!group.name.empty()) known.push_back(group.name);
    if (group.name.empty()) top.options.insert(top.options.end(), group.options.begin(), group.options.end());
  }
  for (const Option& option : top.options) known.push_back(option.name);
  for (const auto& entry : root) {
    const std::string& key = entry.first.Scalar();
    const auto group = std::ranges::find(groups, key, &OptionGroup::name);
    Status set;
    if (group != groups.end() && !key.empty()) {
      set = set_section(*group, entry.first, entry.second, name);
    } else if (std::ranges::find(known, key) != known.end()) {
      set = set_option(top, entry.first, entry.second, name);
    } else {
      set = bad_input(fmt::format("'{}' is no known key; {}", excerpt(key), did_you_mean(key, known)),
                      yaml_where(name, entry.first));
    }
    if (!set) return set;
  }
  return {};
}

}  // namespace

Status scenario_from_text(std::string_view text, const std::string& name,
                          const std::vector<OptionGroup>& groups) {
  auto root = yaml_map(text, name);
  if (!root) return pass_on(root);
  const auto restore = way_back(groups);
  Status set = set_all(*root, name, groups);
  if (!set) restore();
  return set;
}

Outcome<std::string> scenario_job(const std::string& path) {
  auto text = read_file(path);
  return text ? scenario_job_from_text(*text, path) : pass_on(text);
}

Outcome<std::string> scenario_job_from_text(const std::string& text, const std::string& name) {
  const auto root = yaml_map(text, name);
  if (!root) return pass_on(root);
  return yaml_text((*root)["job"]).value_or("");
}

Outcome<std::vector<std::string>> scenario_keys(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  auto root = yaml_map(*text, path);
  if (!root) return pass_on(root);
  std::vector<std::string> keys;
  for (const auto& entry : *root) {
    const std::string key = entry.first.Scalar();
    if (!entry.second.IsMap()) {
      keys.push_back(key);
      continue;
    }
    for (const auto& inner : entry.second) keys.push_back(fmt::format("{}.{}", key, inner.first.Scalar()));
  }
  return keys;
}

Status load_scenario(const std::string& path, const std::vector<OptionGroup>& groups) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return scenario_from_text(*text, path, groups);
}

}  // namespace outrider
