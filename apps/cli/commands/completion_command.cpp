// The shell completion and the manual page of the tool. Both are written from the descriptions of its
// commands.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands/commands.hpp"
#include "completion.hpp"
#include "manual_page.hpp"
#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/core/text.hpp"

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
    return refuse(fmt::format("'{}' is not valid; expected bash, zsh or fish", excerpt(shell)), "shell");
  }
  return job_done;
}

/// Returns the files that a package installs: "outrider.1", "outrider-plan.1", ..., "outrider.bash", ...
std::vector<NamedText> files_of(const CommandText& tool) {
  std::vector<NamedText> files{{"outrider.1", manual_page(tool, OUTRIDER_VERSION)},
                               {"outrider.bash", bash_completion(tool)},
                               {"_outrider", zsh_completion(tool)},
                               {"outrider.fish", fish_completion(tool)}};
  for (const CommandText& command : tool.commands)
    files.emplace_back(fmt::format("outrider-{}.1", command.name), manual_page_of(command, OUTRIDER_VERSION));
  return files;
}

int print_manual_page(const Command& command, const std::string& name, const std::string& folder) {
  const CommandText tool = command.text_of_tool();
  if (!folder.empty()) {
    const auto written = of_flag_out(cli::write_files(folder, files_of(tool)));
    return written ? job_done : print_fault(written.error(), false);
  }
  if (name.empty()) {
    show("{}", manual_page(tool, OUTRIDER_VERSION));
    return job_done;
  }
  const auto found = std::ranges::find(tool.commands, name, &CommandText::name);
  if (found == tool.commands.end()) {
    return refuse(fmt::format("there is no command '{}'; 'outrider --help' lists them", excerpt(name)),
                  "command");
  }
  show("{}", manual_page_of(*found, OUTRIDER_VERSION));
  return job_done;
}

}  // namespace

void add_completion(Command& tool) {
  Command& completion = tool.add("completion", "a script with which your shell completes commands and flags");
  auto shell = std::make_shared<std::string>();
  completion.positional("shell", shell.get(), "bash, zsh or fish")
      .required()
      .type("SHELL")
      .one_of({"bash", "zsh", "fish"});
  completion.does([shell](const Command& command) { return complete(command, *shell); });
  completion.footer("\nExample: source <(outrider completion bash)");

  Command& manual = tool.add("manual", "a page for man, of the tool or of one command").hidden();
  auto name = std::make_shared<std::string>();
  manual.positional("command", name.get(), "whose page; of the tool unless given");
  auto folder = std::make_shared<std::string>();
  manual.option("--out", folder.get(),
                "folder for every page and the scripts for the shells, in place of one page");
  manual.does([name, folder](const Command& command) { return print_manual_page(command, *name, *folder); });
}

}  // namespace outrider::cli
