#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "clocks.hpp"
#include "commands.hpp"
#include "cover_command.hpp"
#include "drive_command.hpp"
#include "explore_command.hpp"
#include "flags.hpp"
#include "guard_summary.hpp"
#include "live_report.hpp"
#include "output.hpp"
#include "outrider/io/confinement.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/guard_run.hpp"
#include "outrider/jobs/guard/hunt_run.hpp"
#include "outrider/jobs/guard/passing_plan.hpp"
#include "outrider/jobs/guard/physics_run.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/jobs/guard/scout_run.hpp"
#include "outrider/jobs/guard/supply_plan.hpp"
#include "outrider/jobs/guard/watch_run.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "pddl.hpp"
#include "plan_command.hpp"
#include "progress.hpp"
#include "pursue_command.hpp"
#include "regions_picture.hpp"
#include "scenario_words.hpp"
#include "slam_command.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

struct GuardCommand {
  std::string scenario_path;
  bool json = false;
  std::string out;
  bool html = false;
  bool svg = false;
  bool regions = false;
  std::string planner;
  std::int64_t threads = 0;
  bool prove = false;
  bool unknown = false;
  PddlRequest pddl;
  GuardScenario scenario;
};

OptionGroup describe_output(GuardCommand& command) {
  OptionGroup group{
      "",
      "output",
      {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
       {"out", "", 0, 0, "folder for the report and the pictures", &command.out},
       {"html", "", 0, 0, "write a page that plays the mission, in the folder", &command.html},
       {"svg", "", 0, 0, "write a moving picture of the mission, in the folder", &command.svg},
       {"regions", "", 0, 0, "write firing_regions.svg, heat maps of the firing regions, in the folder",
        &command.regions},
       {"planner", "", 0, 0, "a planner of 'outrider list'; the same as --plan-planner", &command.planner},
       {"threads", "", 0, 1024, "threads to plan with; 0: all; the answer is the same", &command.threads},
       {"prove", "", 0, 0, "as --plan-prove: a better lower bound, so a smaller gap", &command.prove},
       {"unknown", "", 0, 0, "as --scout-unknown: explore the yard first", &command.unknown}}};
  for (Option& option : describe(command.pddl)) group.options.push_back(std::move(option));
  return group;
}

struct GuardResult {
  Report report;
  double planning_s = 0.0;
  double physics_s = 0.0;  ///< on the clock on the wall; 0 without rigid bodies
  std::string regions;     ///< the picture, where it was asked for
};

/// Scenario file, then flags, then the files that they name; returns what was repaired.
Outcome<std::vector<std::string>> read_input(GuardCommand& command, const Command& flags) {
  GuardScenario& scenario = command.scenario;
  const auto groups = describe(scenario);
  if (!command.scenario_path.empty()) {
    if (auto ok = load_scenario(command.scenario_path, groups); !ok) return pass_on(ok);
    resolve_paths(scenario, command.scenario_path);
  }
  if (auto ok = apply_flags(flags, groups); !ok) return pass_on(ok);
  scenario.options.prove = scenario.options.prove || command.prove;
  scenario.scout.unknown = scenario.scout.unknown || command.unknown;
  if (!command.planner.empty()) scenario.options.planner = command.planner;
  return load_problem(scenario);
}

/// Whether the simulator that the scenario names is one that can carry it out.
Status check_sim(const GuardScenario& scenario) {
  if (scenario.sim == "kinematic") return {};
  if (scenario.sim != "physics") {
    return bad_input(fmt::format("'{}' is no good; it takes kinematic or physics", scenario.sim), "sim");
  }
  if (scenario.arrivals.any() || scenario.arrivals.leave < 1.0 || scenario.wander.any()) {
    return bad_input("physics guards a still yard; take kinematic where intruders come, walk or survive",
                     "sim");
  }
  return check_physics(scenario.problem);
}

/// The yard is still, or intruders come, or walk about, or those who are hit may survive.
Outcome<Report> carried_out(const GuardScenario& scenario, const Site& site, const GuardPlan& plan,
                            std::uint64_t seed, Progress& progress, Onlooker* onlooker) {
  if (scenario.sim == "physics") {
    return run_guard_in_physics(
        scenario.problem, site, plan, scenario.options, seed,
        [&progress](double part) { progress.part(part); }, onlooker);
  }
  if (scenario.wander.any()) {
    return hunt(scenario.problem, site, scenario.preferences, scenario.history, scenario.wander,
                scenario.options, seed, onlooker);
  }
  const ArrivalOptions& arrivals = scenario.arrivals;
  if (arrivals.any()) {
    return keep_watch(scenario.problem, site, plan, scenario.intruders, arrivals, scenario.options, seed,
                      onlooker);
  }
  if (arrivals.leave < 1.0) {
    return wear_down(scenario.problem, site, plan, arrivals, scenario.options, seed, onlooker);
  }
  return run_guard(scenario.problem, site, plan, scenario.options, seed, onlooker);
}

/// Exploring comes first, and all plans are made on what it found.
Outcome<GuardResult> carry_out_unknown(const GuardCommand& command, const GuardPlanner& planner,
                                       Progress& progress) {
  const GuardScenario& scenario = command.scenario;
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  progress.next("exploring the yard");
  ExploreWatch watch;
  watch.progress = [&](double part) { progress.part(part); };
  LiveReport live;
  watch.onlooker = live.onlooker();
  auto yard = scout(scenario.problem, {{}, scenario.sensors, scenario.scout}, seed, watch);
  if (!yard) return pass_on(yard);
  const auto begin = Clock::now();
  progress.next("planning on the map found");
  const GuardProblem& found = yard->found.problem;
  const auto site = survey(found, scenario.options);
  if (!site) return tl::unexpected<Fault>(site.error());
  const auto plan = planner.plan(found, *site, scenario.options, {});
  if (!plan) return tl::unexpected<Fault>(plan.error());
  const double planning_s = seconds_since(begin);
  std::string regions;
  if (command.regions) regions = regions_svg(found, *site);
  progress.next("driving and shooting");
  auto report = run_guard_on_map(scenario.problem, std::move(*yard), *site, *plan, scenario.options, seed,
                                 live.onlooker());
  if (!report) return pass_on(report);
  return GuardResult{std::move(*report), planning_s, 0.0, std::move(regions)};
}

Outcome<GuardResult> carry_out_known(const GuardCommand& command, const GuardPlanner& planner,
                                     Progress& progress) {
  const GuardScenario& scenario = command.scenario;
  const auto begin = Clock::now();
  progress.next("surveying from where each target can be hit");
  auto site = survey(scenario.problem, scenario.options);
  if (!site) return pass_on(site);
  progress.next("planning the tour");
  auto plan = scenario.wander.any() ? Outcome<GuardPlan>(GuardPlan{})
                                    : planner.plan(scenario.problem, *site, scenario.options, {});
  if (plan) plan = supply_plan(scenario.problem, *site, std::move(*plan), {});
  if (!plan) return pass_on(plan);
  if (scenario.options.shoot_on_the_move) plan = shoot_in_passing(scenario.problem, *site, *plan);
  const double planning_s = seconds_since(begin);

  progress.next("driving and shooting");
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  const auto launched = Clock::now();
  LiveReport live;
  auto report = carried_out(scenario, *site, *plan, seed, progress, live.onlooker());
  if (!report) return pass_on(report);
  GuardResult result{std::move(*report), planning_s, 0.0, {}};
  if (result.report.sim) result.physics_s = seconds_since(launched);
  if (command.regions) result.regions = regions_svg(scenario.problem, *site);
  return result;
}

Outcome<GuardResult> carry_out(GuardCommand& command, const Command& flags) {
  Progress progress(4);
  progress.next("reading the yard");
  auto warnings = read_input(command, flags);
  if (!warnings) return pass_on(warnings);
  const auto planner = find_guard_planner(command.scenario.options.planner);
  if (!planner) return tl::unexpected<Fault>(planner.error());
  if (auto ok = check_sim(command.scenario); !ok) return pass_on(ok);
  auto result = command.scenario.scout.unknown ? carry_out_unknown(command, *planner, progress)
                                               : carry_out_known(command, *planner, progress);
  if (!result) return pass_on(result);
  result->report.warnings = std::move(*warnings);
  result->report.settings = settings_of(describe(command.scenario));
  return result;
}

/// The exploring alone, which has pictures of its own.
Report exploring_of(Report report) {
  report.job = "explore";
  report.shots.clear();
  report.targets.clear();
  const double end_s = metric(report, "explore_s");
  std::erase_if(report.track, [&](const TrackSample& sample) { return sample.time_s > end_s; });
  std::erase_if(report.events, [&](const ReportEvent& event) { return event.time_s > end_s; });
  return report;
}

/// Writes what was asked for into the folder; returns the path of the report, or nothing without a folder.
/// The pictures are made from the text of the report, so that a replay makes the same.
Outcome<std::string> write_files(const GuardCommand& command, const GuardResult& result) {
  if (command.out.empty()) return std::string{};
  const Report& report = result.report;
  std::vector<NamedText> files{{report.job + ".json", to_json(report)}};
  if (command.html || command.svg) {
    auto stored = report_from_json(files.front().second);
    if (!stored) return pass_on(stored);
    if (command.html) files.emplace_back(report.job + ".html", to_html(*stored, page::viewer()));
    if (command.svg) files.emplace_back(report.job + ".svg", to_animated_svg(*stored, 24.0));
    if (stored->explore) {
      const Report exploring = exploring_of(*stored);
      if (command.html) files.emplace_back("explore.html", to_html(exploring, page::viewer()));
      if (command.svg) files.emplace_back("explore.svg", to_animated_svg(exploring, 24.0));
    }
  }
  if (command.regions) files.emplace_back("firing_regions.svg", result.regions);
  if (auto ok = cli::write_files(command.out, files); !ok) return pass_on(ok);
  return command.out + "/" + files.front().first;
}

Status check_output(const GuardCommand& command, const Command& flags) {
  if (auto ok = check(command.pddl, flags); !ok) return ok;
  if (!flags.given("--out") && (command.html || command.svg || command.regions)) {
    return bad_input("a page or a picture needs a folder; give --out DIR", command.html  ? "--html"
                                                                           : command.svg ? "--svg"
                                                                                         : "--regions");
  }
  if (command.html) {
    if (auto ok = check_page("--html"); !ok) return ok;
  }
  return flags.given("--out") ? check_folder(command.out) : Status{};
}

void print_real_time(const GuardResult& result) {
  const double mission_s = result.report.track.back().time_s;
  complain(fmt::format("physics: {:.1f} s of the mission in {:.1f} s, {:.1f} times real time", mission_s,
                       result.physics_s, mission_s / result.physics_s));
}

void print_text(const GuardCommand& command, const GuardResult& result, const std::string& path) {
  show("{}  planning took {}\n", summary(result.report), duration_text(result.planning_s));
  if (path.empty()) return;
  const std::string stem = command.out + "/" + result.report.job;
  show("\n  report   {}\n", path);
  if (command.html) show("  watch    {}.html\n", stem);
  if (command.svg) show("  picture  {}.svg\n", stem);
  if (command.regions) show("  regions  {}/firing_regions.svg\n", command.out);
}

int carry_out_pddl(GuardCommand& command, const Command& flags) {
  const auto warnings = read_input(command, flags);
  if (!warnings) return say(warnings.error(), command.json);
  warn(*warnings);
  return carry_out(command.pddl, command.scenario, *warnings, command.json);
}

int execute(GuardCommand& command, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, {describe_output(command)}); !ok) return say(ok.error(), json);
  if (auto ok = check_output(command, flags); !ok) return say(ok.error(), command.json);
  std::unique_ptr<tbb::global_control> limit;
  if (command.threads > 0) {
    limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(command.threads));
  }
  if (command.pddl.any()) return carry_out_pddl(command, flags);
  const auto result = carry_out(command, flags);
  if (!result) return say(result.error(), command.json);
  warn(result->report.warnings);
  if (result->report.sim) print_real_time(*result);
  const auto path = write_files(command, *result);
  if (!path) return say(path.error(), command.json);

  if (command.json) {
    auto object = summary_json(result->report, *path);
    insert_planning(object, result->planning_s);
    print(object);
  } else {
    print_text(command, *result, *path);
  }
  return result->report.status == "done" ? job_done : job_not_done;
}

/// What `run` and `guard` have in common.
void add_common(Command& verb, const std::shared_ptr<GuardCommand>& command) {
  std::vector<OptionGroup> groups = describe(command->scenario);
  groups.insert(groups.begin(), describe_output(*command));
  add_flags(verb, groups);
}

/// The text on standard input becomes the content of the file. There may be a file of that name, or none.
Status supply_from_stdin(const std::string& path) {
  constexpr std::size_t most_bytes = std::size_t{1} << 20U;
  std::string text(most_bytes + 1, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), stdin));
  if (text.size() > most_bytes) return bad_input("a scenario has at most 1 MiB", "--stdin");
  supply_file(path, std::move(text));
  return {};
}

}  // namespace

void add_run(Command& tool) {
  Command& run = tool.add("run", "do the job in a scenario file; flags win over the file");
  auto command = std::make_shared<GuardCommand>();
  run.positional("scenario", &command->scenario_path,
                 "scenario file; 'outrider schema --as scenario' prints one")
      .required()
      .type("FILE");
  run.flag("--stdin", "the text of the scenario comes from standard input; paths in it start beside FILE");
  add_common(run, command);
  run.does([command](const Command& flags) {
    if (flags.given("--stdin")) {
      if (auto ok = supply_from_stdin(command->scenario_path); !ok)
        return say(ok.error(), flags.given("--json"));
    }
    const auto job = scenario_job(command->scenario_path);
    if (job && *job == "pursue") return run_pursuit_scenario(command->scenario_path, flags);
    if (job && *job == "plan") return run_plan_scenario(command->scenario_path, flags);
    if (job && *job == "cover") return run_cover_scenario(command->scenario_path, flags);
    if (job && *job == "drive") return run_drive_scenario(command->scenario_path, flags);
    if (job && *job == "explore") return run_explore_scenario(command->scenario_path, flags);
    if (job && *job == "slam") return run_slam_scenario(command->scenario_path, flags);
    return execute(*command, flags);
  });
  run.footer("\nExample: outrider run scenarios/yard/yard.yaml --out out --html");
}

void add_guard(Command& tool) {
  Command& guard = tool.add("guard", "drive, aim and shoot a water gun at every target in a yard");
  auto command = std::make_shared<GuardCommand>();
  guard.option("--scenario", &command->scenario_path, "scenario file to start from; flags win over it")
      .type("FILE");
  add_common(guard, command);
  guard.does([command](const Command& flags) { return execute(*command, flags); });
  guard.footer(
      "\nExample: outrider guard --world yard.sdf --targets cats.txt --start 0,-9.5,90 --out out --html");
}

}  // namespace outrider::cli
