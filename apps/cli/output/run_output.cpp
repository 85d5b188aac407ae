#include "output/run_output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/files/files.hpp"
#include "page.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns true if the report has content; a run that was cancelled at once has none.
bool has_parts(const Report& report) { return !report.metrics.empty(); }

}  // namespace

Outcome<std::string> page_text(const Report& report, const std::string& log_path) {
  auto log = read_file(log_path);
  if (!log) return pass_on(log);
  const std::string world = report.world_name.empty() ? "" : ": " + report.world_name;
  return page::page_of_run(report.job + world, *log);
}

std::string text_of(const Job& job, const Report& report) {
  if (job.summary && has_parts(report)) return job.summary(report);
  return fmt::format("{}: {}\n", report.status,
                     report.reason.empty() ? "there is nothing more to tell" : printable(report.reason));
}

Status check(const RunOutput& output, bool folder_given) {
  if (!folder_given && output.html) return bad_input("a page needs a folder; give --out DIR", "--html");
  if (output.html) {
    if (auto ok = check_page("--html"); !ok) return ok;
  }
  return folder_given ? of_flag_out(check_folder(output.folder)) : Status{};
}

Outcome<WrittenFiles> write_run(const Job& job, Run& run, RunLog& log, const RunOutput& output) {
  if (!output.html) return outrider::write_run(run, log, output.folder);
  return outrider::write_run(run, log, output.folder,
                             [&](const std::string& log_path) -> Outcome<NamedContent> {
                               auto page = page_text(run.report, log_path);
                               if (!page) return pass_on(page);
                               return NamedContent{std::string(job.name) + ".html", std::move(*page)};
                             });
}

void print_run(const Job& job, const Run& run, const WrittenFiles& files, bool json) {
  const Report& report = run.report;
  warn(report.warnings);
  if (json) {
    print(run_json<Json>(report, files));
    return;
  }
  show("{}", text_of(job, report));
  if (!files.empty()) show("\n");
  for (const auto& [name, path] : files) show("  {:<10} {}\n", name, path);
}

}  // namespace outrider::cli
