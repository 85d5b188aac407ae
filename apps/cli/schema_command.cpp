#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "outrider/io/guard_scenario.hpp"
#include "outrider/io/scenario.hpp"

namespace outrider::cli {

void add_schema(CLI::App& app, int& status) {
  CLI::App* schema = app.add_subcommand("schema", "print the JSON schema of scenario files");
  auto form = std::make_shared<std::string>("schema");
  schema->add_option("--as", *form, "schema, scenario (a commented YAML file) or markdown (tables)")
      ->check(CLI::IsMember({"schema", "scenario", "markdown"}));
  schema->callback([form, &status] {
    GuardScenario defaults;
    const auto groups = describe(defaults);
    fmt::print("{}", *form == "schema"     ? scenario_schema(groups, "Outrider scenario")
                     : *form == "scenario" ? scenario_text(groups)
                                           : options_markdown(groups));
    status = 0;
  });
}

}  // namespace outrider::cli
