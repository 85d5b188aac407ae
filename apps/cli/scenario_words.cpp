#include "scenario_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace outrider::cli {

std::vector<std::pair<std::string, std::string>> settings_of(const std::vector<OptionGroup>& groups) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string key = group.name.empty() ? option.name : group.name + "." + option.name;
      settings.emplace_back(key, value_text(option) + (option.unit.empty() ? "" : " " + option.unit));
    }
  }
  return settings;
}

Status refuse_other_words(const Command& words, const std::vector<std::string>& taken, const std::string& job,
                          const std::string& scenario_path) {
  for (const std::string& name : words.all_given()) {
    if (!name.starts_with("--") || std::ranges::count(taken, name) > 0) continue;
    return bad_input(
        fmt::format("'run' does not take it for the job {0}; change the scenario, or use 'outrider {0} "
                    "--scenario {1}' with its flags",
                    job, scenario_path),
        name);
  }
  return {};
}

void tell_scenario_from_file(std::string& file, std::string& scenario_path, std::string_view job) {
  if (!scenario_path.empty() || !(file.ends_with(".yaml") || file.ends_with(".yml"))) return;
  const auto found = scenario_job(file);
  if (found && *found == job) scenario_path = std::exchange(file, {});
}

}  // namespace outrider::cli
