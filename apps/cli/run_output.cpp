#include "run_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/files.hpp"
#include "outrider/picture/plan_view.hpp"
#include "page.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns true if the report has content; a run that was cancelled at once has none.
bool has_parts(const Report& report) { return !report.metrics.empty(); }

}  // namespace

std::string result_text(const Run& run) {
  Json object = run_json<Json>(without_machine_times(run.report));
  object.erase("files");
  object["settings"] = Json::object();
  for (const auto& [key, value] : run.report.settings) object["settings"][key] = value;
  return json_text(object, 1) + "\n";
}

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
  return folder_given ? check_folder(output.folder) : Status{};
}

Outcome<WrittenFiles> write_run(const Job& job, Run& run, RunLog& log, const RunOutput& output) {
  const bool begun = run.report.status != "cancelled" || has_parts(run.report);
  if (output.folder.empty() || !begun) return WrittenFiles{};
  const std::string name(job.name);
  std::vector<NamedContent> files;
  std::vector<FileToRename> complete;
  WrittenFiles written;
  const auto add = [&](const std::string& what, const std::string& file, std::string text) {
    written.emplace_back(what, output.folder + "/" + file);
    files.push_back({output.folder + "/" + file, std::move(text)});
  };
  const std::string result = result_text(run);
  add("result", "run.json", result);
  const auto log_path = log.finish(result);
  if (!log_path) return tl::unexpected<Fault>(log_path.error());
  if (!log_path->empty()) {
    complete.push_back({output.folder + "/run.mcap", *log_path});
    written.emplace_back("log", complete.back().path);
    add("picture", "run.svg", plan_view(run.log));
  }
  if (output.html && !log_path->empty()) {
    auto page = page_text(run.report, *log_path);
    if (!page) return pass_on(page);
    add("page", name + ".html", std::move(*page));
  }
  for (NamedContent& file : run.files) add(file.path, file.path, std::move(file.content));
  if (auto ok = make_folder(output.folder); !ok) return pass_on(ok);
  std::rotate(files.begin(), files.begin() + 1, files.end());  // run.json comes last: where it is, all are
  if (auto ok = outrider::write_files(files, complete); !ok) return pass_on(ok);
  log.release();
  return written;
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
