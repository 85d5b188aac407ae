#include <fmt/format.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "flags.hpp"
#include "guard_summary.hpp"
#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/guard_scenario.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "outrider/sim/guard_run.hpp"

namespace outrider::cli {
namespace {

struct GuardCommand {
  std::string scenario_path;
  GivenFlags given;
  Output output;
  bool html = false;
  bool svg = false;
  std::size_t threads = 0;  // 0: as many as the machine has
};

struct GuardResult {
  Report report;
  double planning_s = 0.0;
};

Outcome<GuardResult> carry_out(const GuardCommand& command) {
  GuardScenario scenario;
  const auto groups = describe(scenario);
  if (!command.scenario_path.empty()) {
    if (auto ok = load_scenario(command.scenario_path, groups); !ok) return pass_on(ok);
    resolve_paths(scenario, command.scenario_path);
  }
  if (auto ok = apply_flags(command.given, groups); !ok) return pass_on(ok);
  auto warnings = load_problem(scenario);
  if (!warnings) return pass_on(warnings);
  for (const std::string& warning : *warnings) fmt::print(stderr, "outrider: warning: {}\n", warning);

  const auto begin = std::chrono::steady_clock::now();
  const auto site = survey(scenario.problem, scenario.options);
  if (!site) return tl::unexpected(site.error());
  const auto plan = plan_guard(scenario.problem, *site, scenario.options, {});
  if (!plan) return tl::unexpected(plan.error());
  const std::chrono::duration<double> planning = std::chrono::steady_clock::now() - begin;

  GuardResult result{
      run_guard(scenario.problem, *site, *plan, scenario.options, static_cast<std::uint64_t>(scenario.seed)),
      planning.count()};
  result.report.warnings = std::move(*warnings);
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      const std::string key = group.name.empty() ? option.name : group.name + "." + option.name;
      result.report.settings.emplace_back(
          key, value_text(option) + (option.unit.empty() ? "" : " " + option.unit));
    }
  }
  return result;
}

/// Writes what was asked for into the folder; returns the path of the report, or nothing without a folder.
Outcome<std::string> write_files(const GuardCommand& command, const Report& report) {
  if (command.output.folder.empty()) return std::string{};
  if (auto ok = make_folder(command.output.folder); !ok) return pass_on(ok);
  const std::string stem = command.output.folder + "/" + report.job;
  if (auto ok = write_file(stem + ".json", to_json(report)); !ok) return pass_on(ok);
  if (command.html) {
    if (auto ok = write_file(stem + ".html", to_html(report)); !ok) return pass_on(ok);
  }
  if (command.svg) {
    if (auto ok = write_file(stem + ".svg", to_animated_svg(report, 24.0)); !ok) return pass_on(ok);
  }
  return stem + ".json";
}

int execute(const GuardCommand& command) {
  std::unique_ptr<tbb::global_control> limit;
  if (command.threads > 0) {
    limit =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, command.threads);
  }
  if (command.output.folder.empty() && (command.html || command.svg)) {
    return say({FaultCode::bad_input, "a page or a picture needs a folder; give --out DIR", "--html"},
               command.output);
  }
  const auto result = carry_out(command);
  if (!result) return say(result.error(), command.output);
  const auto path = write_files(command, result->report);
  if (!path) return say(path.error(), command.output);

  if (command.output.json) {
    print(summary_json(result->report, result->planning_s, *path));
  } else {
    fmt::print("{}", summary(result->report));
    fmt::print("  planning took {}\n", duration_text(result->planning_s));
    if (!path->empty()) fmt::print("\n  report  {}\n", *path);
    if (command.html) fmt::print("  watch   {}/{}.html\n", command.output.folder, result->report.job);
    if (command.svg) fmt::print("  picture {}/{}.svg\n", command.output.folder, result->report.job);
  }
  return result->report.status == "done" ? job_done : job_not_done;
}

/// The flags that `run` and `guard` have in common.
void add_common(CLI::App& app, GuardCommand& command) {
  app.add_flag("--json", command.output.json, "print one JSON object on standard output");
  app.add_option("--out", command.output.folder, "folder for the report and the pictures");
  app.add_flag("--html", command.html, "write a page that plays the mission");
  app.add_flag("--svg", command.svg, "write a moving picture of the mission");
  app.add_option("--threads", command.threads, "threads to plan with; 0: all")->check(CLI::Range(0, 1024));
  GuardScenario defaults;
  add_flags(app, describe(defaults), command.given);
}

}  // namespace

void add_run(CLI::App& app, int& status) {
  CLI::App* run = app.add_subcommand("run", "do the job in a scenario file; flags win over the file");
  auto command = std::make_shared<GuardCommand>();
  run->add_option("scenario", command->scenario_path, "scenario file (YAML)")->required();
  add_common(*run, *command);
  run->callback([command, &status] { status = execute(*command); });
}

void add_guard(CLI::App& app, int& status) {
  CLI::App* guard = app.add_subcommand("guard", "drive, aim and shoot a water gun at every target in a yard");
  auto command = std::make_shared<GuardCommand>();
  guard->add_option("--scenario", command->scenario_path, "scenario file to start from");
  add_common(*guard, *command);
  guard->callback([command, &status] { status = execute(*command); });
}

}  // namespace outrider::cli
