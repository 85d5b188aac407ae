#include "run_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/text.hpp"
#include "outrider/log/mcap_sink.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/picture/plan_view.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns true if the run can be played: it has a robot that moves.
bool plays(const Run& run) {
  const auto moves = [](const Channel& channel) {
    return channel.topic == topic::pose || channel.topic == topic::belief;
  };
  return std::ranges::any_of(run.log.channels(), moves);
}

/// Returns the text of run.json: the printed JSON with the settings, and without the machine times, which differ
/// from run to run.
std::string result_text(const Run& run) {
  Report report = run.report;
  report.machine_times.clear();
  Json object = run_json<Json>(report);
  for (const Table& table : report.tables) {
    for (Json& row : object[table.name]) {
      row.erase("time_s");
      row.erase("build_s");
    }
  }
  object.erase("files");
  object["settings"] = Json::object();
  for (const auto& [key, value] : run.report.settings) object["settings"][key] = value;
  return json_text(object, 1) + "\n";
}

/// Returns true if the report has content; a run that was cancelled at once has none.
bool has_parts(const Report& report) { return !report.metrics.empty(); }

/// Returns the run as an MCAP file with run.json in it.
Outcome<std::string> log_text(Run& run, const std::string& result) {
  std::string bytes;
  auto writer = McapWriter::begin(make_string_sink(bytes));
  if (!writer) return pass_on(writer);
  McapSink sink(std::move(*writer));
  run.log.add_sink(sink);
  run.log.remove_sink(sink);
  if (auto ok = sink.writer().attach("run.json", "application/json", result); !ok) return pass_on(ok);
  if (auto ok = sink.finish(); !ok) return pass_on(ok);
  return bytes;
}

}  // namespace

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

Outcome<WrittenFiles> write_run(const Job& job, Run& run, const RunOutput& output) {
  const bool begun = run.report.status != "cancelled" || has_parts(run.report);
  if (output.folder.empty() || !begun) return WrittenFiles{};
  const std::string name(job.name);
  std::vector<NamedText> texts;
  WrittenFiles written;
  const auto add = [&](const std::string& what, const std::string& file, std::string text) {
    written.emplace_back(what, output.folder + "/" + file);
    texts.emplace_back(file, std::move(text));
  };
  const std::string result = result_text(run);
  add("result", "run.json", result);
  if (!run.log.channels().empty()) {
    auto log = log_text(run, result);
    if (!log) return pass_on(log);
    add("log", "run.mcap", std::move(*log));
    add("picture", "run.svg", plan_view(run.log));
  }
  if (plays(run)) {
    const std::string report = to_json(page_report(run.report, run.log));
    add("report", name + ".json", report);
    if (output.html) {
      auto stored = report_from_json(report);
      if (!stored) return pass_on(stored);
      add("page", name + ".html", to_html(*stored, page::viewer()));
    }
  }
  for (const NamedContent& file : run.files) add(file.path, file.path, file.content);
  if (auto ok = write_files(output.folder, texts); !ok) return pass_on(ok);
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
