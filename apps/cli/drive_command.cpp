#include "drive_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "drive_summary.hpp"
#include "flags.hpp"
#include "live_report.hpp"
#include "output.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "outrider/jobs/drive/scenario.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "progress.hpp"
#include "scenario_words.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

struct DriveRequest {
  std::string scenario_path;
  bool json = false;
  std::string out;
  DriveScenario scenario;
};

OptionGroup describe_output(DriveRequest& command) {
  return {"",
          "output",
          {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
           {"out", "", 0, 0, "folder for the report and a picture", &command.out}}};
}

Outcome<Report> carry_out(DriveRequest& command) {
  Progress progress(2);
  progress.next("planning the way");
  auto setup = load_drive(command.scenario);
  if (!setup) return pass_on(setup);
  progress.next("driving");
  LiveReport live;
  Report report = run_drive(
      setup->task, setup->truth, setup->rendered, static_cast<std::uint64_t>(command.scenario.seed),
      [&](double done) { progress.part(done); }, live.onlooker());
  if (setup->plan) {
    report.metrics.emplace_back("path_m", length_of(*setup->plan));
    report.metrics.emplace_back("path_clearance_m", setup->path_clearance_m);
  }
  report.settings = settings_of(describe(command.scenario));
  report.warnings = std::move(setup->warnings);
  return report;
}

/// Report and picture; the latter is made from the text of the report, as a replay makes it.
Outcome<std::string> write_files(const DriveRequest& command, const Report& report) {
  if (command.out.empty()) return std::string{};
  const std::string text = to_json(report);
  auto stored = report_from_json(text);
  if (!stored) return pass_on(stored);
  const std::vector<NamedText> files = {{report.job + ".json", text},
                                        {report.job + ".svg", to_animated_svg(*stored, 12.0)}};
  if (auto ok = cli::write_files(command.out, files); !ok) return pass_on(ok);
  return command.out + "/" + files.front().first;
}

int finish(DriveRequest& command) {
  const auto report = carry_out(command);
  if (!report) return say(report.error(), command.json);
  const auto path = write_files(command, *report);
  if (!path) return say(path.error(), command.json);
  warn(report->warnings);
  if (command.json) {
    print(drive_json(*report, *path));
  } else {
    show("{}", drive_summary(*report));
    if (!path->empty()) show("\n  report    {}\n  picture   {}/drive.svg\n", *path, command.out);
  }
  return report->status == "done" ? job_done : job_not_done;
}

int execute(DriveRequest& command, const Command& flags) {
  if (auto ok = read_job_words(flags, command); !ok) return say(ok.error(), flags.given("--json"));
  return finish(command);
}

}  // namespace

int run_drive_scenario(const std::string& path, const Command& flags) {
  DriveRequest command;
  if (auto ok = read_run_words(flags, path, "drive", command, &command.scenario.seed); !ok)
    return say(ok.error(), flags.given("--json"));
  return finish(command);
}

void add_drive(Command& tool) {
  Command& drive = tool.add("drive", "drive to waypoints, or along a planner's path, by the tags in sight");
  auto command = std::make_shared<DriveRequest>();
  drive.option("--scenario", &command->scenario_path, "scenario file to start from; flags win over it")
      .type("FILE");
  std::vector<OptionGroup> groups = describe(command->scenario);
  groups.insert(groups.begin(), describe_output(*command));
  add_flags(drive, groups);
  drive.does([command](const Command& flags) { return execute(*command, flags); });
  drive.footer("\nExample: outrider drive --scenario scenarios/waypoints/closed_loop.yaml --loop open");
}

}  // namespace outrider::cli
