// A command of the tool and the arguments it takes. Only this header gives access to the command line parser.
//
//   Command& replay = tool.add("replay", "summarise a run, or make a page or a picture of it");
//   replay.positional("run", &request->path, "log of a run, or its folder").required().type("FILE");
//   bench.option("--repeat", &request->repeat, "runs of each case [3]").between(1.0, 100.0);
//   replay.flag("--json", &request->json, "print one JSON object on standard output");
//   replay.footer("\nExample: outrider replay out");
//   replay.does([request](const Command& words) { return execute(*request, words); });
//
// add_flags() (flags.hpp) adds flags for described options.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
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

/// Points to the variable that receives the value of an argument; it must outlive the command. With
/// monostate, the value is read later through Command::values().
using Place = std::variant<std::monostate, int*, std::int64_t*, std::uint64_t*, double*, std::string*,
                           std::vector<std::string>*>;

class Command;

/// Describes an argument of a command. Each function returns the argument itself.
class Parameter {
 public:
  /// Sets the placeholder of the value in the help: "FILE", "m", "NAME,...".
  Parameter& type(const std::string& name);
  /// Sets the heading under which the help lists the argument.
  Parameter& group(const std::string& heading);
  Parameter& required();
  /// Refuses numbers outside the bounds; the help names the bounds.
  Parameter& between(int low, int high);
  Parameter& between(double low, double high);
  /// Names the values for completion, if it takes one of few. Does not refuse others.
  Parameter& one_of(const std::vector<std::string>& choices);
  /// Splits the value into several at this delimiter.
  Parameter& separated_by(char delimiter);
  /// Allows the argument to be repeated, each time with one value; Command::values() returns all of them.
  Parameter& repeatable();
  /// Does the same, and the help states the maximum number of repetitions.
  Parameter& repeatable(int most);

 private:
  friend class Command;
  Parameter(Command& command, CLI::Option& option) : command_(&command), option_(&option) {}
  Command* command_;
  CLI::Option* option_;
};

/// An argument, as help, completion and the manual show it.
struct ArgumentText {
  std::vector<std::string> names;  ///< with their dashes: "-h", "--help"; of a positional argument its name
  std::string value;               ///< the placeholder of its value; empty: it takes none
  std::string sentence;
  std::string heading;               ///< under which it is listed
  std::vector<std::string> choices;  ///< its values, if it takes one of few
  bool is_positional = false;
  bool is_required = false;
};

/// A command, as help, completion and the manual show it. Hidden commands are left out.
struct CommandText {
  std::string name;
  std::string sentence;
  std::string footer;
  std::vector<ArgumentText> arguments;
  std::vector<CommandText> commands;
};

/// Represents the tool, one of its commands, or a subcommand.
class Command {
 public:
  /// Runs the command with the arguments it was given; returns the exit status of the tool.
  using Job = std::function<int(const Command&)>;

  /// Constructs the tool itself, which takes a command, --help and --version.
  Command(const std::string& name, const std::string& sentence, const std::string& version);
  ~Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// Adds a subcommand. The reference stays valid as long as this command exists.
  Command& add(const std::string& name, const std::string& sentence);
  /// Omits the command from the help, because only programs call it.
  Command& hidden();
  /// Makes a subcommand mandatory.
  void require_command();

  /// Adds --name, a flag without a value. Without `place`, query it with given().
  Parameter flag(const std::string& name, bool* place, const std::string& sentence);
  Parameter flag(const std::string& name, const std::string& sentence);
  /// Adds --name VALUE; `name` starts with dashes.
  Parameter option(const std::string& name, Place place, const std::string& sentence);
  Parameter option(const std::string& name, const std::string& sentence);
  /// Adds a positional argument; `name` has no dashes.
  Parameter positional(const std::string& name, Place place, const std::string& sentence);
  /// Returns an argument that was added before, to describe it further.
  Parameter parameter(const std::string& name);

  /// Sets the text at the end of the help.
  void footer(const std::string& text);
  void does(Job job);

  /// Returns true if the argument is on the command line.
  [[nodiscard]] bool given(const std::string& name) const;
  /// Returns all values given for the argument, in order; a flag without a value yields "true".
  [[nodiscard]] std::vector<std::string> values(const std::string& name) const;
  /// Returns the names of all arguments on the command line.
  [[nodiscard]] std::vector<std::string> all_given() const;
  /// Describes the tool with all its commands, whichever of them it is called on.
  [[nodiscard]] CommandText text_of_tool() const;

  /// Parses the arguments, then runs the command they name. Returns the exit status. A fault states in one
  /// sentence what was misunderstood and suggests the nearest valid argument. Call it on the tool itself
  /// only.
  Outcome<int> run(std::vector<std::string> words);

 private:
  friend class Parameter;
  Command(CLI::App& app, const Command& parent);
  [[nodiscard]] const Command& chosen() const;
  [[nodiscard]] CommandText text() const;

  std::unique_ptr<CLI::App> tool_;  ///< set for the tool only, null for its commands
  CLI::App* app_;
  const Command* parent_ = nullptr;
  std::vector<std::unique_ptr<Command>> commands_;
  std::map<std::string, std::vector<std::string>> choices_;  ///< by the name of the argument
  Job job_;
};

}  // namespace outrider::cli
