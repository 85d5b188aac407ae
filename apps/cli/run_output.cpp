#include "run_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "outrider/core/overload.hpp"
#include "outrider/core/text.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Counts without a decimal point; null for what is not known.
Json number_json(double value) {
  constexpr double exact = 9e15;
  if (!std::isfinite(value)) return nullptr;
  if (std::abs(value) < exact && value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

Json point_json(Vec2 p) { return {number_json(p.x), number_json(p.y)}; }

Json piece_json(const TableArc& piece) {
  Json object = {{"from", point_json(piece.from)}, {"to", point_json(piece.to)}};
  if (piece.turn_rad != 0.0) object["centre"] = point_json(piece.centre);
  if (piece.turn_rad != 0.0) object["turn_rad"] = piece.turn_rad;
  return object;
}

Json value_json(const TableValue& value) {
  return std::visit(Overload{[](double number) { return number_json(number); },
                             [](const std::string& text) { return Json(text); },
                             [](Vec2 point) { return point_json(point); },
                             [](const std::vector<Vec2>& points) {
                               Json list = Json::array();
                               for (const Vec2 p : points) list.push_back(point_json(p));
                               return list;
                             },
                             [](const std::vector<TableArc>& pieces) {
                               Json list = Json::array();
                               for (const TableArc& piece : pieces) list.push_back(piece_json(piece));
                               return list;
                             }},
                    value);
}

Json table_json(const Table& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json object = Json::object();
    for (std::size_t i = 0; i < table.columns.size(); ++i) object[table.columns[i]] = value_json(row[i]);
    rows.push_back(std::move(object));
  }
  return rows;
}

/// Something to play: a robot that moves, or a pursuit.
bool plays(const Report& report) { return !report.track.empty() || report.chase; }

/// A run without anything to play, as a file keeps it: what is printed as JSON, but for how long the machine
/// took, which differs from run to run.
std::string answer_text(const Run& run, const std::vector<Table>& tables) {
  Report report = run.report;
  report.machine_times.clear();
  Json object = run_json(report, tables, {});
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

/// A run that was cancelled at once has none.
bool has_parts(const Report& report) { return !report.metrics.empty(); }

/// Those that its report tells of, then those of the run itself.
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
  std::vector<NamedText> texts = {
      {name + ".json", moves ? to_json(run.report) : answer_text(run, all_tables(job, run))}};
  WrittenFiles written = {{"report", output.folder + "/" + texts.front().first}};
  const auto add = [&](const std::string& what, const std::string& file, std::string text) {
    written.emplace_back(what, output.folder + "/" + file);
    texts.emplace_back(file, std::move(text));
  };
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

nlohmann::ordered_json run_json(const Report& report, const std::vector<Table>& tables,
                                const WrittenFiles& files) {
  Json metrics = Json::object(), paths = Json::object();
  for (const auto& [name, value] : report.metrics) metrics[name] = number_json(value);
  for (const auto& [name, value] : report.machine_times) metrics[name] = number_json(value);
  for (const auto& [name, path] : files) paths[name] = path;
  Json object = {
      {"status", report.status}, {"job", report.job}, {"reason", report.reason}, {"metrics", metrics}};
  for (const Table& table : tables) object[table.name] = table_json(table);
  object["files"] = std::move(paths);
  object["warnings"] = report.warnings;
  return object;
}

void print_run(const Job& job, const Run& run, const WrittenFiles& files, bool json) {
  const Report& report = run.report;
  warn(report.warnings);
  if (json) {
    print(run_json(report, all_tables(job, run), files));
    return;
  }
  show("{}", job.run_summary ? job.run_summary(run) : text_of(job, report));
  if (!files.empty()) show("\n");
  for (const auto& [name, path] : files) show("  {:<10} {}\n", name, path);
}

}  // namespace outrider::cli
