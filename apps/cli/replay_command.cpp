#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "guard_summary.hpp"
#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"

namespace outrider::cli {
namespace {

struct ReplayCommand {
  std::string path;
  std::string html;
  std::string svg;
  double seconds = 24.0;
  Output output;
};

int execute(const ReplayCommand& command) {
  const auto text = read_file(command.path);
  if (!text) return say(text.error(), command.output);
  auto report = report_from_json(*text);
  if (!report) {
    Fault fault = report.error();
    fault.where = command.path + (fault.where.empty() ? "" : ": " + fault.where);
    return say(fault, command.output);
  }
  if (!command.html.empty()) {
    if (auto ok = write_file(command.html, to_html(*report)); !ok) return say(ok.error(), command.output);
  }
  if (!command.svg.empty()) {
    if (auto ok = write_file(command.svg, to_animated_svg(*report, command.seconds)); !ok) {
      return say(ok.error(), command.output);
    }
  }
  if (command.output.json) {
    auto object = summary_json(*report, 0.0, command.path);
    object["metrics"].erase("planning_s");
    print(object);
  } else {
    fmt::print("{}", summary(*report));
  }
  return job_done;
}

}  // namespace

void add_replay(CLI::App& app, int& status) {
  CLI::App* replay = app.add_subcommand("replay", "summarise a report, or make a page or a picture of it");
  auto command = std::make_shared<ReplayCommand>();
  replay->add_option("report", command->path, "report of a run (JSON)")->required();
  replay->add_option("--html", command->html, "write a page that plays it");
  replay->add_option("--svg", command->svg, "write a moving picture of it");
  replay->add_option("--seconds", command->seconds, "length of the moving picture")
      ->check(CLI::Range(1.0, 600.0));
  replay->add_flag("--json", command->output.json, "print one JSON object on standard output");
  replay->callback([command, &status] { status = execute(*command); });
}

}  // namespace outrider::cli
