// A command of the tool and the words it takes: the one door to the parser of the command line.
//
//   Command& replay = tool.add("replay", "summarise a report, or make a page or a picture of it");
//   replay.positional("report", &request->path, "report of a run").required().type("FILE");
//   replay.option("--seconds", &request->seconds, "length of the picture [24]").between(1.0, 600.0);
//   replay.flag("--json", &request->json, "print one JSON object on standard output");
//   replay.footer("\nExample: outrider replay out/guard.json");
//   replay.does([request](const Command& words) { return execute(*request, words); });
//
// Flags that stand for described options come from add_flags() (flags.hpp).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace outrider::cli {

/// Where the value of a word goes: it must outlive the command. monostate: it waits for Command::values().
using Place = std::variant<std::monostate, int*, std::int64_t*, std::uint64_t*, double*, std::string*,
                           std::vector<std::string>*>;

/// A word that a command takes, while it is being described. Each function returns the word itself.
class Parameter {
 public:
  /// What stands for the value in the help: "FILE", "m", "NAME,...".
  Parameter& type(const std::string& name);
  /// The heading of the help under which it stands.
  Parameter& group(const std::string& heading);
  Parameter& required();
  /// Refuses numbers outside; the help names the bounds.
  Parameter& between(int low, int high);
  Parameter& between(double low, double high);
  /// One value holds several, with this between them.
  Parameter& separated_by(char delimiter);
  /// It may be given again, each time with one value; Command::values() has them all.
  Parameter& repeatable();
  /// The same, and the help says how often.
  Parameter& repeatable(int most);

 private:
  friend class Command;
  explicit Parameter(CLI::Option& option) : option_(&option) {}
  CLI::Option* option_;
};

/// The tool, one of its commands, or a command of a command.
class Command {
 public:
  /// What a command does with the words it was given; returns the exit status of the tool.
  using Job = std::function<int(const Command&)>;

  /// The tool: it takes a command, --help and --version.
  Command(const std::string& name, const std::string& sentence, const std::string& version);
  ~Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// A command of this one; it lives as long.
  Command& add(const std::string& name, const std::string& sentence);
  /// Leaves it out of the help: it is for programs.
  Command& hidden();
  /// Refuses to go without a command of its own.
  void require_command();

  /// --name, which stands alone. Without a place, given() tells.
  Parameter flag(const std::string& name, bool* place, const std::string& sentence);
  Parameter flag(const std::string& name, const std::string& sentence);
  /// --name VALUE, where `name` starts with dashes.
  Parameter option(const std::string& name, Place place, const std::string& sentence);
  Parameter option(const std::string& name, const std::string& sentence);
  /// A value that goes by its place; `name` has no dashes.
  Parameter positional(const std::string& name, Place place, const std::string& sentence);
  /// A word that was added before, to say more of it.
  Parameter parameter(const std::string& name);

  /// What the help ends with.
  void footer(const std::string& text);
  void does(Job job);

  /// Whether the word stands on the command line.
  [[nodiscard]] bool given(const std::string& name) const;
  /// All values that stand there for it, in order; a flag that stands alone has "true".
  [[nodiscard]] std::vector<std::string> values(const std::string& name) const;
  /// The names of all words that stand there.
  [[nodiscard]] std::vector<std::string> all_given() const;

  /// Reads the words, then does the job of the command they name. Returns the exit status, or what was
  /// misunderstood, in one sentence with the nearest that would do. For the tool itself.
  Outcome<int> run(std::vector<std::string> words);

 private:
  explicit Command(CLI::App& app);
  [[nodiscard]] const Command& chosen() const;

  std::unique_ptr<CLI::App> tool_;  ///< of the tool, and of no other command
  CLI::App* app_;
  std::vector<std::unique_ptr<Command>> commands_;
  Job job_;
};

}  // namespace outrider::cli
