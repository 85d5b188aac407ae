#include "manual_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace outrider::cli {
namespace {

constexpr std::string_view statuses_section =
    ".SH EXIT STATUS\n.TP\n0\nthe job was done\n.TP\n1\nit was not\n"
    ".TP\n2\nthe request or an input was wrong\n"
    ".TP\n3\nan answer could not be written, as on a full disk\n";

std::string upper_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// Returns a text that troff prints as it is: minus signs stay minus signs, and no line is a request.
std::string plain(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (letter == '.' || letter == '\'')) result += "\\&";
    if (letter == '\\') {
      result += "\\e";
    } else if (letter == '-') {
      result += "\\-";
    } else {
      result += letter;
    }
  }
  return result;
}

std::string header(const std::string& name, std::string_view version, const std::string& sentence) {
  return fmt::format(".TH {} 1 \"\" \"Outrider {}\" \"Outrider\"\n.SH NAME\n{} \\- {}\n",
                     upper_case(plain(name)), version, plain(name), plain(sentence));
}

std::string names_of(const ArgumentText& argument) {
  std::vector<std::string> names;
  for (const std::string& name : argument.names) names.push_back(fmt::format("\\fB{}\\fR", plain(name)));
  const std::string value = argument.value.empty() || argument.is_positional
                                ? ""
                                : fmt::format(" \\fI{}\\fR", plain(argument.value));
  return fmt::format("{}{}", fmt::join(names, ", "), value);
}

/// Lists arguments under their headings, each heading once, in the order of their first arguments.
std::string arguments_of(const CommandText& command) {
  std::vector<std::string> headings;
  for (const ArgumentText& argument : command.arguments) {
    if (std::ranges::count(headings, argument.heading) == 0) headings.push_back(argument.heading);
  }
  std::string text;
  for (const std::string& heading : headings) {
    text += fmt::format(".SH {}\n", upper_case(plain(heading)));
    for (const ArgumentText& argument : command.arguments) {
      if (argument.heading == heading)
        text += fmt::format(".TP\n{}\n{}\n", names_of(argument), plain(argument.sentence));
    }
  }
  return text;
}

std::string usage_of(const CommandText& command, const std::string& words) {
  std::string text = fmt::format(".SH SYNOPSIS\n.B {}\n", plain(words));
  if (!command.commands.empty()) text += ".I COMMAND\n";
  text += "[\\fIOPTIONS\\fR]\n";
  for (const ArgumentText& argument : command.arguments) {
    if (!argument.is_positional) continue;
    const std::string name = fmt::format("\\fI{}\\fR", plain(argument.names.front()));
    text += argument.is_required ? name + "\n" : "[" + name + "]\n";
  }
  return text;
}

/// Returns the lines of a footer, broken as they are.
std::string footer_of(const CommandText& command) {
  const std::size_t begin = command.footer.find_first_not_of('\n');
  if (begin == std::string::npos) return "";
  return fmt::format(".SH NOTES\n.nf\n{}\n.fi\n", plain(command.footer.substr(begin)));
}

}  // namespace

std::string manual_page(const CommandText& tool, std::string_view version) {
  std::string text = header("outrider", version, tool.sentence) + usage_of(tool, "outrider");
  text += ".SH COMMANDS\n";
  for (const CommandText& command : tool.commands)
    text += fmt::format(".TP\n\\fB{}\\fR\n{}; see \\fBoutrider\\-{}\\fR(1)\n", plain(command.name),
                        plain(command.sentence), plain(command.name));
  text += arguments_of(tool);
  return text + std::string(statuses_section);
}

std::string manual_page_of(const CommandText& command, std::string_view version) {
  const std::string words = "outrider " + command.name;
  std::string text = header("outrider-" + command.name, version, command.sentence) + usage_of(command, words);
  for (const CommandText& sub : command.commands) {
    text += fmt::format(".SH {}\n{}\n", upper_case(plain(words + " " + sub.name)), plain(sub.sentence));
    for (const ArgumentText& argument : sub.arguments)
      text += fmt::format(".TP\n{}\n{}\n", names_of(argument), plain(argument.sentence));
  }
  text += arguments_of(command) + footer_of(command) + std::string(statuses_section);
  return text + ".SH SEE ALSO\n.BR outrider (1)\n";
}

}  // namespace outrider::cli
