#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "flags.hpp"
#include "output/output.hpp"
#include "output/run_output.hpp"
#include "output/terminal.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/log/mcap/mcap_file.hpp"
#include "outrider/log/messages/scene_messages.hpp"
#include "outrider/log/read_log.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/picture/plan_view.hpp"
#include "page.hpp"

namespace outrider::cli {
namespace {

struct ReplayCommand {
  std::string path;
  bool json = false;
  std::string html;
  std::string svg;
};

OptionGroup describe(ReplayCommand& command) {
  return {"",
          "output",
          {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
           {"html", "", 0, 0, "file to write, a page that plays the run", &command.html},
           {"svg", "", 0, 0, "file to write, a picture of the run from above", &command.svg}}};
}

/// A run as it is read from its folder, its log or its run.json.
struct StoredRun {
  std::string path;  ///< of the log; empty if the run left none
  Report report;
  Log log;
};

/// Returns the report of a log without its end, because the run ended before its report was written.
Outcome<Report> report_of_cut(const std::string& path, const StoredLog& stored) {
  const auto* info = stored.log.latest<outrider_msgs::RunInfo>(topic::run);
  if (info == nullptr) {
    return bad_input("the log is cut short before its first messages; run the job again", path);
  }
  Report report;
  report.status = "not_done";
  report.reason = fmt::format("the log is cut short: it ends at {:.1f} s", stored.log.end_s());
  report.job = info->job;
  report.world_name = info->world;
  return report;
}

/// Returns the report of a log: that of the attachment run.json.
Outcome<Report> report_of(const std::string& path, const StoredLog& stored) {
  auto attachments = read_attachments(path);
  if (!attachments) return pass_on(attachments);
  const auto result = std::ranges::find(*attachments, "run.json", &LogAttachment::name);
  if (result != attachments->end()) return read_run_json(result->content, path + ": run.json");
  if (!stored.cut_short.empty()) return report_of_cut(path, stored);
  return bad_input(
      "it is a log, but not that of a run: it has no run.json; watch it in the page of \"outrider serve\"",
      path);
}

Outcome<StoredRun> load_log(const std::string& path) {
  auto stored = read_log(path);
  if (!stored) return pass_on(stored);
  auto report = report_of(path, *stored);
  if (!report) return pass_on(report);
  if (!stored->cut_short.empty()) report->warnings.push_back(stored->cut_short);
  return StoredRun{path, std::move(*report), std::move(stored->log)};
}

Outcome<StoredRun> load_result(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  auto report = read_run_json(*text, path);
  if (!report) return pass_on(report);
  return StoredRun{{}, std::move(*report), {}};
}

/// Reads RUN/, RUN/run.mcap or RUN/run.json. A folder in which a first run was killed has RUN/running.mcap
/// alone.
Outcome<StoredRun> load_run(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(path, error)) {
    const std::string log = path + "/run.mcap", result = path + "/run.json", killed = path + "/running.mcap";
    if (fs::exists(log, error)) return load_log(log);
    if (fs::exists(result, error)) return load_result(result);
    if (fs::exists(killed, error)) return load_log(killed);
    return bad_input("it is a folder without run.mcap and run.json; give the --out folder of a run", path);
  }
  return path.ends_with(".json") || path.ends_with(".json.gz") ? load_result(path) : load_log(path);
}

/// Returns the run as text. Fault: bad_input if run.json has other tables than the job makes.
Outcome<std::string> summary_of(const Job& job, const Report& report, const std::string& path) {
  try {
    return text_of(job, report);
  } catch (const std::exception&) {
    return bad_input("its run.json does not have the tables of its job; run the job again", path);
  }
}

/// Writes the page and the picture that are asked for.
Status write_views(const ReplayCommand& command, const Command& flags, const StoredRun& run) {
  const bool html = flags.given("--html"), svg = flags.given("--svg");
  if (!html && !svg) return {};
  if (run.path.empty())
    return bad_input("a page or a picture needs the log of a run; give RUN/run.mcap", command.path);
  if (html) {
    const auto page = page_text(run.report, run.path);
    if (!page) return pass_on(page);
    if (auto ok = write_file(command.html, *page); !ok) return ok;
  }
  return svg ? write_file(command.svg, plan_view(run.log)) : Status{};
}

int execute(ReplayCommand& command, const std::vector<Job>& jobs, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, {describe(command)}); !ok) return print_fault(ok.error(), json);
  if (flags.given("--html")) {
    if (auto ok = check_page("--html"); !ok) return print_fault(ok.error(), command.json);
  }
  const auto run = load_run(command.path);
  if (!run) return print_fault(run.error(), command.json);
  const auto job = find_job(jobs, run->report.job, command.path);
  if (!job) return print_fault(job.error(), command.json);
  const auto summary = summary_of(*job, run->report, command.path);
  if (!summary) return print_fault(summary.error(), command.json);
  if (auto ok = write_views(command, flags, *run); !ok) return print_fault(ok.error(), command.json);
  warn(run->report.warnings);
  if (command.json) {
    const auto files = run->path.empty() ? WrittenFiles{} : WrittenFiles{{"log", run->path}};
    print(run_json<nlohmann::ordered_json>(run->report, files));
    return job_done;
  }
  show("{}", *summary);
  if (!command.html.empty()) show("\n  watch    {}\n", command.html);
  if (!command.svg.empty()) show("{}  picture  {}\n", command.html.empty() ? "\n" : "", command.svg);
  return job_done;
}

}  // namespace

void add_replay(Command& tool, const std::vector<Job>& jobs) {
  Command& replay = tool.add("replay", "summarise a run, or make a page or a picture of it");
  auto command = std::make_shared<ReplayCommand>();
  replay.positional("run", &command->path, "log of a run, or its --out folder").required().type("RUN");
  add_flags(replay, {describe(*command)});
  replay.does([command, jobs](const Command& flags) { return execute(*command, jobs, flags); });
  replay.footer("\nExample: outrider replay out/run.mcap --html out/guard.html");
}

}  // namespace outrider::cli
