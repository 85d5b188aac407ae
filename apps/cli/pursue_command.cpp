#include "pursue_command.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "flags.hpp"
#include "live_report.hpp"
#include "output.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/jobs/pursue/report.hpp"
#include "outrider/jobs/pursue/scenario.hpp"
#include "outrider/pursuit/optimal.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "progress.hpp"
#include "pursue_summary.hpp"
#include "scenario_words.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

struct PursueCommand {
  std::string map;
  std::string scenario_path;
  bool json = false;
  std::string out;
  PursuitScenario scenario;
};

OptionGroup describe_output(PursueCommand& command) {
  return {
      "",
      "output",
      {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
       {"out", "", 0, 0, "folder for the report, a moving picture and a page that plays it", &command.out}}};
}

class WallWatch : public StopWatch {
 public:
  double lap_s() override {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> lap = now - last_;
    last_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

double peak_mib() {
  struct rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

struct PursuitResult {
  Report report;
  PursuitTimes times;
};

/// The bound that somebody who knew the whole future could prove, where the run proved none itself.
void look_back(PursuitRun& run, const PursuitTask& task) {
  const bool certain = task.rules.known_s >= task.problem.last_s();
  if (certain && !task.rules.ask) return;
  run.lower_bound = 0;
  for (const Cell robot : task.robots) {
    PursuitProblem problem = task.problem;
    problem.start = robot;
    Workspace workspace;
    const auto plan = optimal_pursuit(problem, {}, {}, workspace);
    if (!plan) continue;
    run.lower_bound = run.lower_bound == 0 ? plan->lower_bound : std::min(run.lower_bound, plan->lower_bound);
    const int earliest = plan->earliest_catch_s;
    run.earliest_catch_s = run.earliest_catch_s < 0 ? earliest : std::min(run.earliest_catch_s, earliest);
  }
}

Outcome<PursuitResult> carry_out(PursueCommand& command) {
  Progress progress(3);
  progress.next("reading the map");
  auto task = load_task(command.scenario);
  if (!task) return pass_on(task);
  const std::string name = std::filesystem::path(command.scenario.map).filename().string();
  progress.next("planning and going");
  WallWatch watch;
  LiveReport live;
  Onlooker* const onlooker = live.onlooker();
  const auto look = [&](const PursuitRun& so_far) {
    if (onlooker != nullptr && onlooker->wants()) onlooker->see(pursuit_report(task->problem, so_far, name));
  };
  auto run = pursue(task->problem, task->robots, task->rules, watch, look);
  PursuitResult result;
  if (!run && !is_answer(run.error())) return pass_on(run);
  if (run) {
    result.times = {run->first_feasible_s, run->planning_s, peak_mib()};
    progress.next("looking back with the whole future known");
    look_back(*run, *task);
    result.report = pursuit_report(task->problem, *run, name);
  } else {
    result.times = {-1.0, watch.lap_s(), peak_mib()};
    result.report = pursuit_report(task->problem, run.error(), name);
  }
  if (onlooker != nullptr) onlooker->see(result.report);
  result.report.seed = static_cast<std::uint64_t>(command.scenario.seed);
  result.report.settings = settings_of(describe(command.scenario));
  return result;
}

/// Report, picture and, where the tool has one, page; these are made from the text of the report, as a replay
/// makes them.
Outcome<std::string> write_files(const PursueCommand& command, const Report& report) {
  if (command.out.empty()) return std::string{};
  const std::string text = to_json(report);
  auto stored = report_from_json(text);
  if (!stored) return pass_on(stored);
  std::vector<NamedText> files = {{report.job + ".json", text},
                                  {report.job + ".svg", to_animated_svg(*stored, 12.0)}};
  if (!page::viewer().empty()) files.emplace_back(report.job + ".html", to_html(*stored, page::viewer()));
  if (auto ok = cli::write_files(command.out, files); !ok) return pass_on(ok);
  return command.out + "/" + files.front().first;
}

int finish(PursueCommand& command) {
  const auto result = carry_out(command);
  if (!result) return say(result.error(), command.json);
  const auto path = write_files(command, result->report);
  if (!path) return say(path.error(), command.json);
  if (command.json) {
    auto object = pursuit_json(result->report, *path);
    insert_times(object, result->times);
    print(object);
  } else {
    show("{}{}", pursuit_summary(result->report), times_text(result->times));
    if (!path->empty()) {
      const std::string stem = command.out + "/" + result->report.job;
      show("\n  report    {}\n", *path);
      if (!page::viewer().empty()) show("  watch     {}.html\n", stem);
      show("  picture   {}.svg\n", stem);
    }
  }
  return result->report.status == "done" ? job_done : job_not_done;
}

int execute(PursueCommand& command, const Command& flags) {
  if (auto ok = read_job_words(flags, command); !ok) return say(ok.error(), flags.given("--json"));
  if (flags.given("file")) command.scenario.map = command.map;
  return finish(command);
}

}  // namespace

int run_pursuit_scenario(const std::string& path, const Command& flags) {
  PursueCommand command;
  if (auto ok = read_run_words(flags, path, "pursue", command); !ok)
    return say(ok.error(), flags.given("--json"));
  return finish(command);
}

void add_pursue(Command& tool) {
  Command& pursue = tool.add("pursue", "catch a moving target at the least cost, proven");
  auto command = std::make_shared<PursueCommand>();
  pursue
      .positional("file", &command->map, "map of costs with the robot and the target; may be gzip-compressed")
      .type("FILE");
  pursue.option("--scenario", &command->scenario_path, "scenario file to start from; flags win over it")
      .type("FILE");
  std::vector<OptionGroup> groups = describe(command->scenario);
  groups.insert(groups.begin(), describe_output(*command));
  add_flags(pursue, groups);
  pursue.does([command](const Command& flags) { return execute(*command, flags); });
  pursue.footer("\nExample: outrider pursue scenarios/pursuit/park.txt --out out");
}

}  // namespace outrider::cli
