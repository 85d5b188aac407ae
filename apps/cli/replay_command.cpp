#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "flags.hpp"
#include "guard_summary.hpp"
#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "pursue_summary.hpp"

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

int execute(ReplayCommand& command, const CLI::App& flags) {
  const bool json = flags.get_option("--json")->count() > 0;
  if (auto ok = apply_flags(flags, {describe(command)}); !ok) return say(ok.error(), json);
  const auto report = load_report(command.path);
  if (!report) return say(report.error(), command.json);
  if (flags.get_option("--html")->count() > 0) {
    if (auto ok = write_file(command.html, to_html(*report)); !ok) return say(ok.error(), command.json);
  }
  if (flags.get_option("--svg")->count() > 0) {
    if (auto ok = write_file(command.svg, to_animated_svg(*report, command.seconds)); !ok) {
      return say(ok.error(), command.json);
    }
  }
  if (command.json) {
    print(report->chase ? pursuit_json(*report, command.path) : summary_json(*report, command.path));
    return job_done;
  }
  fmt::print("{}", report->chase ? pursuit_summary(*report) : summary(*report));
  if (!command.html.empty()) fmt::print("\n  watch    {}\n", command.html);
  if (!command.svg.empty()) fmt::print("{}  picture  {}\n", command.html.empty() ? "\n" : "", command.svg);
  return job_done;
}

}  // namespace

void add_replay(CLI::App& app, int& status) {
  CLI::App* replay = app.add_subcommand("replay", "summarise a report, or make a page or a picture of it");
  auto command = std::make_shared<ReplayCommand>();
  replay->add_option("report", command->path, "report of a run, as --out of the job left it")
      ->required()
      ->type_name("FILE");
  add_flags(*replay, {describe(*command)});
  replay->callback([command, replay, &status] { status = execute(*command, *replay); });
  replay->footer("\nExample: outrider replay out/guard.json --html out/guard.html");
}

}  // namespace outrider::cli
