#include "flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace outrider::cli {
namespace {

std::string sentence_case(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// What stands behind the flag in the help.
std::string placeholder(const Option& option) {
  if (!option.unit.empty()) return option.unit;
  if (std::holds_alternative<std::string*>(option.value)) return "TEXT";
  return std::holds_alternative<double*>(option.value) ? "NUMBER" : "COUNT";
}

/// The present value, short enough to read: pi/6 needs no 16 digits here.
std::string shown_value(const Option& option) {
  const std::string text = value_text(option);
  if (!std::holds_alternative<double*>(option.value)) return text;
  return fmt::format("{:.6g}", std::strtod(text.c_str(), nullptr));
}

/// "outrider guard --help".
std::string help_of(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return fmt::format("'{}{} --help'", parent == nullptr ? "" : parent->get_name() + " ", command.get_name());
}

Fault unknown_word(const CLI::App& command, std::string word) {
  word.resize(std::min(word.find('='), word.size()));
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) known.push_back(option->get_name());
  for (const CLI::App* sub : command.get_subcommands({})) known.push_back(sub->get_name());
  const std::string nearest = nearest_name(word.substr(0, 64), known);
  return {FaultCode::bad_input,
          fmt::format("'{}' is not known here{}; {} lists what is", word,
                      nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest), help_of(command)),
          {}};
}

}  // namespace

std::string flag_of(const std::string& group, const std::string& option) {
  std::string flag = group.empty() ? option : group + "-" + option;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return "--" + flag;
}

void add_flags(CLI::App& app, const std::vector<OptionGroup>& groups) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string flag = flag_of(group.name, option.name);
      const bool is_switch = std::holds_alternative<bool*>(option.value);
      const std::string value = shown_value(option);
      const std::string help =
          is_switch || value.empty() ? option.sentence : fmt::format("{} [{}]", option.sentence, value);
      CLI::Option* added = is_switch ? app.add_flag(flag, help) : app.add_option(flag, help);
      if (!is_switch) added->type_name(placeholder(option));
      added->group(sentence_case(group.sentence));
    }
  }
}

Status apply_flags(const CLI::App& app, const std::vector<OptionGroup>& groups) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string flag = flag_of(group.name, option.name);
      const CLI::Option* given = app.get_option(flag);
      if (given->count() == 0) continue;
      if (auto ok = assign(option, given->results().back()); !ok) {
        ok.error().where = flag;
        return ok;
      }
    }
  }
  return {};
}

Fault misunderstanding(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const auto unknown = app.remaining(true);
  if (!unknown.empty()) return unknown_word(command, unknown.front());
  const std::string what = error.what();
  const std::string where = what.substr(0, what.find_first_of(": "));
  const auto refuse = [&](const std::string& sentence, const std::string& at) {
    return Fault{FaultCode::bad_input, fmt::format("{}; {} shows how", sentence, help_of(command)), at};
  };
  if (error.get_name() == "RequiredError") {
    return chosen.empty() ? refuse("no command is given", "") : refuse("it is missing", where);
  }
  if (error.get_name() == "ArgumentMismatch") {
    const CLI::Option* option = command.get_option_no_throw(where);
    const std::size_t times = option == nullptr ? 0 : option->count();
    return refuse(
        times > 1 ? fmt::format("it is given {} times, and takes one value", times) : "its value is missing",
        where);
  }
  return refuse(what, "");
}

}  // namespace outrider::cli
