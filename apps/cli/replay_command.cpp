#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "flags.hpp"
#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "run_output.hpp"
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

int execute(ReplayCommand& command, const std::vector<Job>& jobs, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, {describe(command)}); !ok) return print_fault(ok.error(), json);
  if (flags.given("--html")) {
    if (auto ok = check_page("--html"); !ok) return print_fault(ok.error(), command.json);
  }
  const auto report = load_report(command.path);
  if (!report) return print_fault(report.error(), command.json);
  if (flags.given("--html")) {
    if (auto ok = write_file(command.html, to_html(*report, page::viewer())); !ok)
      return print_fault(ok.error(), command.json);
  }
  if (flags.given("--svg")) {
    if (auto ok = write_file(command.svg, to_animated_svg(*report, command.seconds)); !ok) {
      return print_fault(ok.error(), command.json);
    }
  }
  const auto job = find_job(jobs, report->job, command.path);
  if (!job) return print_fault(job.error(), command.json);
  if (command.json) {
    print(run_json<nlohmann::ordered_json>(*report, tables_of(*job, *report), {{"report", command.path}}));
    return job_done;
  }
  show("{}", text_of(*job, *report));
  if (!command.html.empty()) show("\n  watch    {}\n", command.html);
  if (!command.svg.empty()) show("{}  picture  {}\n", command.html.empty() ? "\n" : "", command.svg);
  return job_done;
}

}  // namespace

void add_replay(Command& tool, const std::vector<Job>& jobs) {
  Command& replay = tool.add("replay", "summarise a report, or make a page or a picture of it");
  auto command = std::make_shared<ReplayCommand>();
  replay.positional("report", &command->path, "report of a run, as --out of the job left it")
      .required()
      .type("FILE");
  add_flags(replay, {describe(*command)});
  replay.does([command, jobs](const Command& flags) { return execute(*command, jobs, flags); });
  replay.footer("\nExample: outrider replay out/guard.json --html out/guard.html");
}

}  // namespace outrider::cli
