#include "completion.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace outrider::cli {
namespace {

/// A command with the words that lead to it: {"bench", "path"}.
struct Named {
  std::vector<std::string> words;
  const CommandText* command = nullptr;
};

/// Lists the tool and all its commands, each before those below it.
void list_commands(const CommandText& command, const std::vector<std::string>& words,
                   std::vector<Named>& all) {
  all.push_back({words, &command});
  for (const CommandText& sub : command.commands) {
    std::vector<std::string> longer = words;
    longer.push_back(sub.name);
    list_commands(sub, longer, all);
  }
}

std::vector<Named> all_commands(const CommandText& tool) {
  std::vector<Named> all;
  list_commands(tool, {}, all);
  return all;
}

bool takes_file(const ArgumentText& argument) {
  if (!argument.choices.empty()) return false;
  return argument.value == "FILE" || argument.value == "DIR" || argument.value == "TEXT";
}

bool takes_files(const CommandText& command) {
  return std::ranges::any_of(command.arguments, [](const ArgumentText& argument) {
    return argument.is_positional && takes_file(argument);
  });
}

/// Puts a text between single quotes, for any of the shells.
std::string quoted(std::string_view text, std::string_view quote) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\'') {
      result += quote;
    } else {
      result += letter;
    }
  }
  return result + "'";
}
std::string posix_quoted(std::string_view text) { return quoted(text, "'\\''"); }

std::string fish_quoted(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '\\') escaped += letter;
    escaped += letter;
  }
  return quoted(escaped, "\\'");
}

/// Escapes what _arguments and _describe of zsh give a meaning.
std::string zsh_escaped(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') escaped += '\\';
    escaped += letter;
  }
  return escaped;
}

/// Returns the names of the flags of a command that satisfy a predicate.
template <class Predicate>
std::string flags_of(const CommandText& command, Predicate is_wanted) {
  std::vector<std::string> names;
  for (const ArgumentText& argument : command.arguments) {
    if (!argument.is_positional && is_wanted(argument))
      names.insert(names.end(), argument.names.begin(), argument.names.end());
  }
  return fmt::format("{}", fmt::join(names, " "));
}

/// Returns the case of a command: its words, which of them take the name of a file or another value, and
/// whether it takes files itself.
std::string bash_case(const Named& named) {
  std::string words;
  for (const CommandText& sub : named.command->commands) words += sub.name + " ";
  words += flags_of(*named.command, [](const ArgumentText&) { return true; });
  std::string choices;
  for (const ArgumentText& argument : named.command->arguments) {
    const std::string values = fmt::format("{}", fmt::join(argument.choices, " "));
    if (argument.is_positional && !values.empty()) words += " " + values;
    if (!argument.is_positional && !values.empty())
      choices += fmt::format("[{}]=\"{}\" ", argument.names.back(), values);
  }
  const std::string paths = flags_of(*named.command, takes_file);
  const std::string values =
      flags_of(*named.command, [](const ArgumentText& a) { return !a.value.empty() && !takes_file(a); });
  return fmt::format(
      "    \"{}\")\n      words=\"{}\"\n      paths=\"{}\"\n      values=\"{}\"\n      choices=({})\n      "
      "files={} ;;\n",
      fmt::join(named.words, " "), words, paths, values, choices, takes_files(*named.command) ? 1 : 0);
}

std::string zsh_argument(const ArgumentText& argument) {
  const std::string action = !argument.choices.empty() ? fmt::format("({})", fmt::join(argument.choices, " "))
                             : takes_file(argument)    ? "_files"
                                                       : " ";
  const std::string sentence = zsh_escaped(argument.sentence);
  if (argument.is_positional) return posix_quoted(fmt::format("*:{}:{}", sentence, action));
  const std::string value =
      argument.value.empty() ? "" : fmt::format(":{}:{}", zsh_escaped(argument.value), action);
  const std::string about = fmt::format("[{}]{}", sentence, value);
  if (argument.names.size() == 1) return posix_quoted(argument.names.front() + about);
  return fmt::format("'({})'{{{}}}{}", fmt::join(argument.names, " "), fmt::join(argument.names, ","),
                     posix_quoted(about));
}

std::string zsh_function(const Named& named) {
  std::string text =
      fmt::format("_outrider{}{}() {{\n", named.words.empty() ? "" : "_", fmt::join(named.words, "_"));
  if (!named.command->commands.empty()) text += "  local line state\n";
  text += "  _arguments -s";
  if (!named.command->commands.empty()) text += " -C";
  for (const ArgumentText& argument : named.command->arguments)
    text += fmt::format(" \\\n    {}", zsh_argument(argument));
  if (named.command->commands.empty()) return text + "\n}\n\n";
  text +=
      " \\\n    '1:command:->command' '*::argument:->argument'\n  case $state in\n    command)\n"
      "      local -a commands=(";
  for (const CommandText& sub : named.command->commands)
    text += fmt::format("\n        {}", posix_quoted(sub.name + ":" + zsh_escaped(sub.sentence)));
  text += "\n      )\n      _describe command commands ;;\n    argument)\n      case $line[1] in\n";
  const std::string prefix = named.words.empty() ? "" : fmt::format("{}_", fmt::join(named.words, "_"));
  for (const CommandText& sub : named.command->commands)
    text += fmt::format("        {0}) _outrider_{1}{0} ;;\n", sub.name, prefix);
  return text + "      esac ;;\n  esac\n}\n\n";
}

/// Returns the condition under which a line of fish is for this command: its words stand on the line, and
/// none with which they would mean another one, such as `bench` for `guard`.
std::string fish_condition(const CommandText& tool, const Named& named) {
  if (named.words.empty()) return "__fish_use_subcommand";
  std::vector<std::string> parts;
  for (const std::string& word : named.words) parts.push_back("__fish_seen_subcommand_from " + word);
  for (const CommandText& other : tool.commands) {
    if (named.words.size() == 1 && std::ranges::count(other.commands, named.words[0], &CommandText::name) > 0)
      parts.push_back("not __fish_seen_subcommand_from " + other.name);
  }
  if (!named.command->commands.empty()) {
    std::vector<std::string> below;
    for (const CommandText& sub : named.command->commands) below.push_back(sub.name);
    parts.push_back(fmt::format("not __fish_seen_subcommand_from {}", fmt::join(below, " ")));
  }
  return fmt::format("{}", fmt::join(parts, "; and "));
}

std::string fish_argument(const ArgumentText& argument) {
  std::string flags;
  for (const std::string& name : argument.names)
    flags += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  const std::string value = argument.value.empty() ? ""
                            : takes_file(argument) ? " -r -F"
                            : argument.choices.empty()
                                ? " -x"
                                : fmt::format(" -x -a '{}'", fmt::join(argument.choices, " "));
  return fmt::format("{}{} -d {}", flags, value, fish_quoted(argument.sentence));
}

}  // namespace

std::string bash_completion(const CommandText& tool) {
  std::string cases;
  for (const Named& named : all_commands(tool)) cases += bash_case(named);
  std::vector<std::string> parents;
  for (const CommandText& command : tool.commands) {
    if (!command.commands.empty()) parents.push_back(command.name);
  }
  return fmt::format(R"(# bash completion for outrider, written by 'outrider completion bash'
_outrider() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} command= words= paths= values= files=0
  local -A choices=()
  if [[ $COMP_CWORD -gt 1 && ${{COMP_WORDS[1]}} != -* ]]; then
    command=${{COMP_WORDS[1]}}
    case $command in
      {}) [[ $COMP_CWORD -gt 2 && ${{COMP_WORDS[2]}} != -* ]] && command="$command ${{COMP_WORDS[2]}}" ;;
    esac
  fi
  case $command in
{}  esac
  COMPREPLY=()
  if [[ -n $previous && -n ${{choices[$previous]:-}} ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${{choices[$previous]}}" -- "$current")
  elif [[ " $values " == *" $previous "* ]]; then
    return
  elif [[ " $paths " == *" $previous "* || ( $files -eq 1 && $current != -* ) ]]; then
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  fi
}}
complete -F _outrider outrider
)",
                     parents.empty() ? "''" : fmt::format("{}", fmt::join(parents, "|")), cases);
}

std::string zsh_completion(const CommandText& tool) {
  std::string text =
      "#compdef outrider\n# zsh completion for outrider, written by 'outrider completion zsh'\n\n";
  for (const Named& named : all_commands(tool)) text += zsh_function(named);
  return text + "_outrider \"$@\"\n";
}

std::string fish_completion(const CommandText& tool) {
  std::string text = "# fish completion for outrider, written by 'outrider completion fish'\n";
  for (const Named& named : all_commands(tool)) {
    const std::string when =
        fmt::format("complete -c outrider -n {}", fish_quoted(fish_condition(tool, named)));
    if (!takes_files(*named.command)) text += when + " -f\n";
    for (const CommandText& sub : named.command->commands)
      text += fmt::format("{} -a {} -d {}\n", when, sub.name, fish_quoted(sub.sentence));
    for (const ArgumentText& argument : named.command->arguments) {
      if (!argument.is_positional) text += when + fish_argument(argument) + "\n";
      if (argument.is_positional && !argument.choices.empty())
        text += fmt::format("{} -a '{}'\n", when, fmt::join(argument.choices, " "));
    }
  }
  return text;
}

}  // namespace outrider::cli
