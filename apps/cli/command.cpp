#include "command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "output/output.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/overload.hpp"
#include "outrider/core/text.hpp"

namespace outrider::cli {
namespace {

constexpr std::size_t help_column = 36;  ///< column where the descriptions start

/// Returns, for example, "'outrider guard --help'".
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
          fmt::format("'{}' is not known here{}; {} lists what is", excerpt(word),
                      nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest), help_of(command)),
          {}};
}

/// Explains why the parser refused the arguments.
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

CLI::Option& add_option(CLI::App& app, const std::string& name, Place place, const std::string& sentence) {
  return *std::visit(Overload{[&](std::monostate) { return app.add_option(name, sentence); },
                              [&](auto* value) { return app.add_option(name, *value, sentence); }},
                     place);
}

ArgumentText text_of(const CLI::Option& option) {
  ArgumentText text;
  text.is_positional = option.get_positional();
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (text.is_positional) text.names = {option.get_name()};
  if (option.get_expected_min() > 0 && option.get_type_size() > 0) text.value = option.get_type_name();
  text.sentence = option.get_description();
  text.heading = option.get_group();
  text.is_required = option.get_required();
  return text;
}

}  // namespace

Parameter& Parameter::type(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Parameter& Parameter::group(const std::string& heading) {
  option_->group(heading);
  return *this;
}

Parameter& Parameter::required() {
  option_->required();
  return *this;
}

Parameter& Parameter::between(int low, int high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

Parameter& Parameter::between(double low, double high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

Parameter& Parameter::one_of(const std::vector<std::string>& choices) {
  command_->choices_[option_->get_name()] = choices;
  return *this;
}

Parameter& Parameter::separated_by(char delimiter) {
  option_->delimiter(delimiter);
  return *this;
}

Parameter& Parameter::repeatable() {
  option_->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

Parameter& Parameter::repeatable(int most) {
  option_->expected(1, most);
  return repeatable();
}

Command::Command(const std::string& name, const std::string& sentence, const std::string& version)
    : tool_(std::make_unique<CLI::App>(sentence, name)), app_(tool_.get()) {
  app_->set_help_flag("-h,--help", "show this text");
  app_->set_version_flag("--version", version, "show the version");
  app_->get_formatter()->column_width(help_column);
  require_command();
}

Command::Command(CLI::App& app, const Command& parent) : app_(&app), parent_(&parent) {}

Command::~Command() = default;

Command& Command::add(const std::string& name, const std::string& sentence) {
  commands_.push_back(std::unique_ptr<Command>(new Command(*app_->add_subcommand(name, sentence), *this)));
  return *commands_.back();
}

Command& Command::hidden() {
  app_->group("");
  return *this;
}

void Command::require_command() { app_->require_subcommand(1); }

Parameter Command::flag(const std::string& name, bool* place, const std::string& sentence) {
  return Parameter(*this, *app_->add_flag(name, *place, sentence));
}

Parameter Command::flag(const std::string& name, const std::string& sentence) {
  return Parameter(*this, *app_->add_flag(name, sentence));
}

Parameter Command::option(const std::string& name, Place place, const std::string& sentence) {
  return Parameter(*this, add_option(*app_, name, place, sentence));
}

Parameter Command::option(const std::string& name, const std::string& sentence) {
  return option(name, std::monostate(), sentence);
}

Parameter Command::positional(const std::string& name, Place place, const std::string& sentence) {
  return option(name, place, sentence);
}

Parameter Command::parameter(const std::string& name) { return Parameter(*this, *app_->get_option(name)); }

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::does(Job job) { job_ = std::move(job); }

bool Command::given(const std::string& name) const {
  const CLI::Option* option = app_->get_option_no_throw(name);
  return option != nullptr && option->count() > 0;
}

std::vector<std::string> Command::values(const std::string& name) const {
  return app_->get_option(name)->results();
}

std::vector<std::string> Command::all_given() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app_->get_options()) {
    if (option->count() > 0) names.push_back(option->get_name());
  }
  return names;
}

CommandText Command::text() const {
  CommandText text{app_->get_name(), app_->get_description(), app_->get_footer(), {}, {}};
  for (const CLI::Option* option : app_->get_options()) {
    text.arguments.push_back(text_of(*option));
    if (const auto known = choices_.find(option->get_name()); known != choices_.end())
      text.arguments.back().choices = known->second;
  }
  for (const auto& command : commands_) {
    if (!command->app_->get_group().empty()) text.commands.push_back(command->text());
  }
  return text;
}

CommandText Command::text_of_tool() const { return parent_ == nullptr ? text() : parent_->text_of_tool(); }

const Command& Command::chosen() const {
  const auto parsed = [](const auto& command) { return command->app_->parsed(); };
  const auto found = std::find_if(commands_.begin(), commands_.end(), parsed);
  return found == commands_.end() ? *this : (*found)->chosen();
}

Outcome<int> Command::run(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // the parser takes them in reverse order
  try {
    app_->parse(words);
  } catch (const CLI::Success& success) {  // --help, --version
    return app_->exit(success);
  } catch (const CLI::ParseError& error) {
    return tl::unexpected<Fault>(misunderstanding(*app_, error));
  }
  const Command& command = chosen();
  return command.job_(command);
}

}  // namespace outrider::cli
