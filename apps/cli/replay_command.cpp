#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "cover_summary.hpp"
#include "drive_summary.hpp"
#include "explore_summary.hpp"
#include "flags.hpp"
#include "guard_summary.hpp"
#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "pursue_summary.hpp"
#include "slam_summary.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

struct ReplayCommand {
  std::string path;
  bool json = false;
  std::string html;
  std::string svg;
  double seconds = 24.0;
};

OptionGroup describe(ReplayCommand& command) {
  return {"",
          "output",
          {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
           {"html", "", 0, 0, "file to write, a page that plays the run", &command.html},
           {"svg", "", 0, 0, "file to write, a moving picture of the run", &command.svg},
           {"seconds", "s", 1, 600, "length of the moving picture", &command.seconds}}};
}

Outcome<Report> load_report(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  auto report = report_from_json(*text);
  if (!report) {
    std::string& where = report.error().where;
    where = path + (where.empty() ? "" : ": " + where);
  }
  return report;
}

nlohmann::ordered_json json_of(const Report& report, const std::string& path) {
  if (report.chase) return pursuit_json(report, path);
  if (report.cover) return cover_json(report, path);
  if (report.job == "explore" && report.explore)
    return explore_json(report, report.status == "done" ? "complete" : "", path);
  if (report.slam) return slam_json(report, path);
  return report.drive ? drive_json(report, path) : summary_json(report, path);
}

std::string text_of(const Report& report) {
  if (report.chase) return pursuit_summary(report);
  if (report.cover) return cover_summary(report);
  if (report.job == "explore" && report.explore) return explore_summary(report);
  if (report.slam) return slam_summary(report);
  return report.drive ? drive_summary(report) : summary(report);
}

int execute(ReplayCommand& command, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, {describe(command)}); !ok) return say(ok.error(), json);
  if (flags.given("--html")) {
    if (auto ok = check_page("--html"); !ok) return say(ok.error(), command.json);
  }
  const auto report = load_report(command.path);
  if (!report) return say(report.error(), command.json);
  if (flags.given("--html")) {
    if (auto ok = write_file(command.html, to_html(*report, page::viewer())); !ok)
      return say(ok.error(), command.json);
  }
  if (flags.given("--svg")) {
    if (auto ok = write_file(command.svg, to_animated_svg(*report, command.seconds)); !ok) {
      return say(ok.error(), command.json);
    }
  }
  if (command.json) {
    print(json_of(*report, command.path));
    return job_done;
  }
  show("{}", text_of(*report));
  if (!command.html.empty()) show("\n  watch    {}\n", command.html);
  if (!command.svg.empty()) show("{}  picture  {}\n", command.html.empty() ? "\n" : "", command.svg);
  return job_done;
}

}  // namespace

void add_replay(Command& tool) {
  Command& replay = tool.add("replay", "summarise a report, or make a page or a picture of it");
  auto command = std::make_shared<ReplayCommand>();
  replay.positional("report", &command->path, "report of a run, as --out of the job left it")
      .required()
      .type("FILE");
  add_flags(replay, {describe(*command)});
  replay.does([command](const Command& flags) { return execute(*command, flags); });
  replay.footer("\nExample: outrider replay out/guard.json --html out/guard.html");
}

}  // namespace outrider::cli
