// What a shell and `man` know of the tool: both are written from the descriptions of its commands.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "completion.hpp"
#include "manual_page.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

int refuse(const std::string& sentence, const std::string& where) {
  return print_fault({FaultCode::bad_input, sentence, where}, false);
}

int complete(const Command& command, const std::string& shell) {
  const CommandText tool = command.text_of_tool();
  if (shell == "bash") {
    show("{}", bash_completion(tool));
  } else if (shell == "zsh") {
    show("{}", zsh_completion(tool));
  } else if (shell == "fish") {
    show("{}", fish_completion(tool));
  } else {
    return refuse(fmt::format("'{}' is not valid; expected bash, zsh or fish", shell), "shell");
  }
  return job_done;
}

int print_manual_page(const Command& command, const std::string& name) {
  const CommandText tool = command.text_of_tool();
  if (name.empty()) {
    show("{}", manual_page(tool, OUTRIDER_VERSION));
    return job_done;
  }
  const auto found = std::ranges::find(tool.commands, name, &CommandText::name);
  if (found == tool.commands.end()) {
    return refuse(fmt::format("there is no command '{}'; 'outrider --help' lists them", name), "command");
  }
  show("{}", manual_page_of(*found, OUTRIDER_VERSION));
  return job_done;
}

}  // namespace

void add_completion(Command& tool) {
  Command& completion = tool.add("completion", "a script with which your shell completes commands and flags");
  auto shell = std::make_shared<std::string>();
  completion.positional("shell", shell.get(), "bash, zsh or fish").required().type("SHELL");
  completion.does([shell](const Command& command) { return complete(command, *shell); });
  completion.footer("\nExample: source <(outrider completion bash)");

  Command& manual = tool.add("manual", "a page for man, of the tool or of one command").hidden();
  auto name = std::make_shared<std::string>();
  manual.positional("command", name.get(), "whose page; of the tool unless given");
  manual.does([name](const Command& command) { return print_manual_page(command, *name); });
}

}  // namespace outrider::cli
