#include "run_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/text.hpp"
#include "outrider/log/mcap_sink.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "outrider/report/report_log.hpp"
#include "page.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns true if the report can be played: it has a moving robot, or a pursuit.
bool plays(const Report& report) { return !report.track.empty() || report.pursuit; }

/// Returns the text of run.json: the printed JSON with the settings, and without the machine times, which
/// differ from run to run.
std::string result_text(const Run& run, const std::vector<Table>& tables) {
  Report report = run.report;
  report.machine_times.clear();
  Json object = run_json<Json>(report, tables, {});
  for (const Table& table : tables) {
    for (Json& row : object[table.name]) {
      row.erase("time_s");
      row.erase("build_s");
    }
  }
  object.erase("files");
  for (const auto& [key, value] : run.report.settings) object["settings"][key] = value;
  return json_text(object, 1) + "\n";
}

/// Returns true if the report has content; a run that was cancelled at once has none.
bool has_parts(const Report& report) { return !report.metrics.empty(); }

/// Returns the run as an MCAP file with run.json in it.
Outcome<std::string> log_text(const Report& report, const std::string& result) {
  std::string bytes;
  auto writer = McapWriter::begin(make_string_sink(bytes));
  if (!writer) return pass_on(writer);
  McapSink sink(std::move(*writer));
  to_log(report).add_sink(sink);
  if (auto ok = sink.writer().attach("run.json", "application/json", result); !ok) return pass_on(ok);
  if (auto ok = sink.finish(); !ok) return pass_on(ok);
  return bytes;
}

/// Returns the tables of the report, then those of the run itself.
std::vector<Table> all_tables(const Job& job, const Run& run) {
  auto tables = tables_of(job, run.report);
  tables.insert(tables.end(), run.tables.begin(), run.tables.end());
  return tables;
}

}  // namespace

std::vector<Table> tables_of(const Job& job, const Report& report) {
  return job.tables && has_parts(report) ? job.tables(report) : std::vector<Table>{};
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

Outcome<WrittenFiles> write_run(const Job& job, const Run& run, const RunOutput& output) {
  const bool begun = run.report.status != "cancelled" || has_parts(run.report);
  if (output.folder.empty() || !begun) return WrittenFiles{};
  const std::string name(job.name);
  const bool moves = plays(run.report);
  const std::string result = result_text(run, all_tables(job, run));
  std::vector<NamedText> texts = {{name + ".json", moves ? to_json(run.report) : result}};
  WrittenFiles written = {{"report", output.folder + "/" + texts.front().first}};
  const auto add = [&](const std::string& what, const std::string& file, std::string text) {
    written.emplace_back(what, output.folder + "/" + file);
    texts.emplace_back(file, std::move(text));
  };
  if (moves) {
    add("result", "run.json", result);
    auto log = log_text(run.report, result);
    if (!log) return pass_on(log);
    add("log", "run.mcap", std::move(*log));
  }
  const bool drawn = std::ranges::count(run.files, name + ".svg", &NamedContent::path) > 0;
  if (moves && (output.html || !drawn)) {
    auto stored = report_from_json(texts.front().second);
    if (!stored) return pass_on(stored);
    if (!drawn) add("picture", name + ".svg", to_animated_svg(*stored, job.picture_s));
    if (output.html) add("page", name + ".html", to_html(*stored, page::viewer()));
  }
  for (const Report& part : run.parts) {
    auto stored = report_from_json(to_json(part));
    if (!stored) return pass_on(stored);
    add(part.job + "_picture", part.job + ".svg", to_animated_svg(*stored, job.picture_s));
    if (output.html) add(part.job + "_page", part.job + ".html", to_html(*stored, page::viewer()));
  }
  for (const NamedContent& file : run.files) add(file.path, file.path, file.content);
  if (auto ok = write_files(output.folder, texts); !ok) return pass_on(ok);
  return written;
}

void print_run(const Job& job, const Run& run, const WrittenFiles& files, bool json) {
  const Report& report = run.report;
  warn(report.warnings);
  if (json) {
    print(run_json<Json>(report, all_tables(job, run), files));
    return;
  }
  show("{}", job.run_summary ? job.run_summary(run) : text_of(job, report));
  if (!files.empty()) show("\n");
  for (const auto& [name, path] : files) show("  {:<10} {}\n", name, path);
}

}  // namespace outrider::cli
