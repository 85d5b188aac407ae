#include "explore_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "clocks.hpp"
#include "commands.hpp"
#include "explore_summary.hpp"
#include "flags.hpp"
#include "live_map.hpp"
#include "live_report.hpp"
#include "output.hpp"
#include "outrider/io/map_server.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "outrider/jobs/explore/scenario.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "progress.hpp"
#include "scenario_words.hpp"
#include "terminal.hpp"
#include "track_csv.hpp"

namespace outrider::cli {
namespace {

struct ExploreCommand {
  std::string scenario_path;
  std::string world;
  std::string planner;
  bool perfect_pose = false;
  bool json = false;
  bool html = false;
  bool live = false;
  std::string out;
  ExploreScenario scenario;
};

OptionGroup describe_output(ExploreCommand& command) {
  return {
      "",
      "output",
      {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
       {"out", "", 0, 0, "folder for the map, the report, the track and a picture", &command.out},
       {"html", "", 0, 0, "write explore.html as well, a page that plays the exploration", &command.html}}};
}

/// The wheels count right, and are believed.
void make_pose_perfect(ExploreScenario& scenario) {
  scenario.task.slam.trust_odometry = true;
  scenario.truth.wheels.scale_error = 0.0;
  scenario.truth.wheels.noise_m = 0.0;
}

Outcome<ExploreRun> carry_out(ExploreCommand& command) {
  Progress progress(2);
  progress.next("reading the world");
  auto setup = load_explore(command.scenario);
  if (!setup) return pass_on(setup);
  progress.next("exploring");
  ExploreWatch watch;
  watch.processor_s = processor_s;
  watch.progress = [&](double done) { progress.part(done); };
  LiveReport live;
  watch.onlooker = live.onlooker();
  std::optional<LiveMap> map;
  if (command.live) {
    progress.end();
    map.emplace();
    watch.scanned = [&](const ExploreMission& mission, const SimulatedExplorer&) {
      map->show(mission, setup->task.start);
    };
  }
  auto run = run_explore(setup->world, setup->task, setup->truth,
                         static_cast<std::uint64_t>(command.scenario.seed), watch);
  if (!run) return pass_on(run);
  run->report.settings = settings_of(describe(command.scenario));
  run->report.warnings = std::move(setup->warnings);
  return run;
}

/// The pictures are made from the text of the report, as a replay makes them.
Outcome<std::string> write_files(const ExploreCommand& command, const ExploreRun& run) {
  if (command.out.empty()) return std::string{};
  const std::string text = to_json(run.report);
  auto stored = report_from_json(text);
  if (!stored) return pass_on(stored);
  std::vector<NamedText> files = {{"explore.json", text},
                                  {"track.csv", track_csv(run.track)},
                                  {"explore.svg", to_animated_svg(*stored, 20.0)}};
  if (command.html) files.emplace_back("explore.html", to_html(*stored, page::viewer()));
  if (auto ok = cli::write_files(command.out, files); !ok) return pass_on(ok);
  if (auto ok = save_map_server(command.out + "/map.yaml", {run.map, 0.0}); !ok) return pass_on(ok);
  return command.out + "/explore.json";
}

int finish(ExploreCommand& command) {
  if (command.html) {
    if (auto ok = check_page("--html"); !ok) return say(ok.error(), command.json);
  }
  const auto run = carry_out(command);
  if (!run) return say(run.error(), command.json);
  const auto path = write_files(command, *run);
  if (!path) return say(path.error(), command.json);
  warn(run->report.warnings);
  if (command.json) {
    print(explore_json(run->report, run->stop_reason, *path));
  } else {
    show("{}", explore_summary(run->report));
    if (!path->empty()) show("\n  report     {}\n  map        {}/map.yaml\n", *path, command.out);
  }
  return run->report.status == "done" ? job_done : job_not_done;
}

int execute(ExploreCommand& command, const Command& flags) {
  tell_scenario_from_file(command.world, command.scenario_path, "explore");
  if (auto ok = read_job_words(flags, command); !ok) return say(ok.error(), flags.given("--json"));
  if (!command.world.empty()) command.scenario.world.world = command.world;
  if (!command.planner.empty()) command.scenario.task.explore.strategy = command.planner;
  if (command.perfect_pose) make_pose_perfect(command.scenario);
  return finish(command);
}

}  // namespace

int run_explore_scenario(const std::string& path, const Command& flags) {
  ExploreCommand command;
  if (auto ok = read_run_words(flags, path, "explore", command, &command.scenario.seed); !ok)
    return say(ok.error(), flags.given("--json"));
  return finish(command);
}

void add_explore(Command& tool) {
  Command& explore = tool.add("explore", "map an unknown world to the last reachable cell, then come home");
  auto command = std::make_shared<ExploreCommand>();
  explore
      .positional("file", &command->world,
                  "world to explore: SDF, map_server YAML, PGM or PNG image, slices CSV; or a scenario")
      .type("FILE");
  explore.option("--scenario", &command->scenario_path, "scenario file to start from; flags win over it")
      .type("FILE");
  explore.option("--planner", &command->planner, "as --explore-strategy").type("NAME");
  explore.flag("--live", &command->live, "draw the map on the terminal as it grows");
  explore.flag("--perfect-pose", &command->perfect_pose, "wheels that count right and are believed: no SLAM");
  std::vector<OptionGroup> groups = describe(command->scenario);
  groups.insert(groups.begin(), describe_output(*command));
  add_flags(explore, groups);
  explore.does([command](const Command& flags) { return execute(*command, flags); });
  explore.footer("\nExample: outrider explore scenarios/explore/office.yaml --out out");
}

}  // namespace outrider::cli
