#include "flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "outrider/job/run_job.hpp"

namespace outrider::cli {
namespace {

std::string sentence_case(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// Returns the placeholder that follows the flag in the help.
std::string placeholder(const Option& option) {
  if (option.names_file) return "FILE";
  if (!option.unit.empty()) return option.unit;
  if (std::holds_alternative<std::string*>(option.value)) return "TEXT";
  return std::holds_alternative<double*>(option.value) ? "NUMBER" : "COUNT";
}

/// Returns the current value, rounded for reading: pi/6 does not need 16 digits here.
std::string shown_value(const Option& option) {
  const std::string text = value_text(option);
  if (!std::holds_alternative<double*>(option.value)) return text;
  return fmt::format("{:.6g}", std::strtod(text.c_str(), nullptr));
}

}  // namespace

std::string flag_of(const std::string& group, const std::string& option) {
  std::string flag = group.empty() ? option : group + "-" + option;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return "--" + flag;
}

void add_flags(Command& command, const std::vector<OptionGroup>& groups) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string flag = flag_of(group.name, option.name);
      const bool is_switch = std::holds_alternative<bool*>(option.value);
      const std::string value = shown_value(option);
      const std::string help =
          is_switch || value.empty() ? option.sentence : fmt::format("{} [{}]", option.sentence, value);
      Parameter added = is_switch ? command.flag(flag, help) : command.option(flag, help);
      if (!is_switch) added.type(placeholder(option)).one_of(option.choices);
      added.group(sentence_case(group.sentence));
    }
  }
}

Status apply_flags(const Command& command, const std::vector<OptionGroup>& groups,
                   std::set<std::string>* given) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string flag = flag_of(group.name, option.name);
      if (!command.given(flag)) continue;
      if (auto ok = assign(option, command.values(flag).back()); !ok) {
        ok.error().where = flag;
        return ok;
      }
      if (given != nullptr) given->insert(key_of(group, option));
    }
  }
  return {};
}

}  // namespace outrider::cli
