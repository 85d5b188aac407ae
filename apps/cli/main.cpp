// outrider: a ground robot finds its way, and does a job. See commands.hpp.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "commands.hpp"
#include "output.hpp"
#include "outrider/core/options.hpp"

namespace outrider::cli {
namespace {

/// The command that the words ask for, or the whole tool.
const CLI::App& asked_for(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : *chosen.front();
}

/// One sentence about words that fit no command, with the nearest that would.
std::string misunderstanding(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = asked_for(app);
  const auto unknown = app.remaining(true);
  if (unknown.empty()) return error.what();
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) known.push_back(option->get_name());
  for (const CLI::App* sub : command.get_subcommands({})) known.push_back(sub->get_name());
  const std::string nearest = nearest_name(unknown.front(), known);
  return fmt::format("'{}' is not known here{}; 'outrider {}--help' lists what is", unknown.front(),
                     nearest.empty() ? "" : fmt::format(", perhaps {}", nearest),
                     &command == &app ? "" : command.get_name() + " ");
}

int run(int argc, char** argv) {
  CLI::App app{"A ground robot finds its way, and does a job, in a yard or a building."};
  app.set_version_flag("--version", OUTRIDER_VERSION);
  app.require_subcommand(1);
  int status = job_done;
  add_run(app, status);
  add_guard(app, status);
  add_plan(app, status);
  add_replay(app, status);
  add_list(app, status);
  add_schema(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "outrider: {}\n", misunderstanding(app, error));
    return refused;
  }
  return status;
}

}  // namespace
}  // namespace outrider::cli

int main(int argc, char** argv) {
  try {
    return outrider::cli::run(argc, argv);
  } catch (const std::exception& broken) {
    fmt::print(stderr, "outrider: this is a bug: {}\n", broken.what());
    return outrider::cli::refused;
  }
}
