#include "cover_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "commands.hpp"
#include "cover_picture.hpp"
#include "cover_summary.hpp"
#include "flags.hpp"
#include "live_report.hpp"
#include "output.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/jobs/cover/report.hpp"
#include "outrider/jobs/cover/scenario.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "progress.hpp"
#include "scenario_words.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

struct CoverCommand {
  std::string scenario_path;
  std::string area;
  bool json = false;
  bool html = false;
  std::string out;
  CoverScenario scenario;
};

OptionGroup describe_output(CoverCommand& command) {
  return {"",
          "output",
          {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
           {"out", "", 0, 0, "folder for the report, the track, the areas and pictures", &command.out},
           {"html", "", 0, 0, "write cover.html as well, a page that plays the drive", &command.html}}};
}

struct CoverResult {
  CoverProblem problem;
  CoverRun run;
  Report report;
};

/// Breaks off where the drive does what was proven that it cannot do.
void check_promises(const CoverRun& run) {
  const bool kept = run.drive.time_s >= run.bound.least_s - 1e-6 &&
                    run.drive.time_s <= run.bound.most_s + 1e-6 &&
                    run.driven.fraction >= run.proof.sure_fraction - 1e-3;
  if (!kept) throw std::logic_error("the simulated drive breaks the bounds of its track");
}

Report report_of(const CoverScenario& scenario, const CoverTask& task, const CoverRun& run) {
  const std::string name = std::filesystem::path(scenario.area).filename().string();
  Report report = cover_report(task.problem, run, static_cast<std::uint64_t>(scenario.seed), name);
  CoverScenario settled = scenario;
  settled.method = run.plan.method;
  report.settings = settings_of(describe(settled));
  if (!task.note.empty()) report.warnings.push_back(task.note);
  return report;
}

Outcome<CoverResult> carry_out(const CoverScenario& scenario) {
  Progress progress(4);
  progress.next("reading the area");
  auto task = load_task(scenario);
  if (!task) return pass_on(task);
  const CoverProblem& problem = task->problem;
  progress.next("planning the track");
  auto plan = task->method.plan(problem, scenario.options, {});
  if (!plan) return tl::unexpected<Fault>(placed(plan.error(), *task));
  progress.next("proving what it covers");
  auto proof = prove(*plan, problem);
  if (!proof) throw std::logic_error(to_string(proof.error()));
  CoverRun run{std::move(*plan), std::move(*proof), {}, {}, {}};
  const CoverPlan& planned = run.plan;
  run.bound = time_bound(planned.track, problem.pace, problem.stray_m, scenario.error_factor);
  progress.next("driving it");
  run.drive = drive_track(planned.track, *planned.ground.ground, problem.pace, problem.stray_m,
                          static_cast<std::uint64_t>(scenario.seed));
  run.driven = coverage_of(run.drive.way, problem.radius_m(), planned.ground.reach);
  check_promises(run);
  Report report = report_of(scenario, *task, run);
  LiveReport live;
  if (live.onlooker() != nullptr) live.see(report);
  return CoverResult{problem, std::move(run), std::move(report)};
}

nlohmann::ordered_json summary_json(const CoverScenario& scenario, const CoverResult& result,
                                    const std::string& report_path) {
  const auto& [plan, proof, bound, drive, driven] = result.run;
  const double area = area_of(plan.ground.area), reach = area_of(plan.ground.reach);
  return {{"status", "done"},
          {"job", "cover"},
          {"area", scenario.area},
          {"method", plan.method},
          {"width_m", result.problem.width_m},
          {"overlap", result.problem.overlap},
          {"area_m2", area},
          {"reachable_m2", reach},
          {"out_of_reach_m2", area - reach},
          {"covered_fraction", proof.planned.fraction},
          {"covered_m2", proof.planned.covered_m2},
          {"missed_m2", proof.planned.missed_m2},
          {"double_m2", proof.planned.twice_m2},
          {"length_m", plan.sums.length_m},
          {"turned_rad", plan.sums.turned_rad},
          {"stops", plan.sums.stops},
          {"laps", plan.laps},
          {"cells", plan.cells},
          {"lanes", plan.lanes},
          {"clearance_m", proof.clearance_m},
          {"t_min_s", bound.least_s},
          {"planned_s", plan.sums.time_s},
          {"t_max_s", bound.most_s},
          {"time_s", drive.time_s},
          {"order_lower_bound_s", plan.order_bound_s},
          {"guarantee",
           {{"stray_m", result.problem.stray_m},
            {"error_factor", scenario.error_factor},
            {"covered_fraction", proof.sure_fraction},
            {"covered_fraction_off_the_rim", proof.inner_fraction}}},
          {"driven",
           {{"seed", scenario.seed},
            {"time_s", drive.time_s},
            {"length_m", drive.length_m},
            {"turned_rad", drive.turned_rad},
            {"strayed_m", drive.strayed_m},
            {"covered_fraction", driven.fraction},
            {"missed_m2", driven.missed_m2},
            {"double_m2", driven.twice_m2}}},
          {"report", report_path.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(report_path)}};
}

nlohmann::ordered_json ring_json(const std::vector<Vec2>& ring) {
  auto points = nlohmann::ordered_json::array();
  for (const Vec2 p : ring) points.push_back({p.x, p.y});
  if (!ring.empty()) points.push_back({ring.front().x, ring.front().y});
  return points;
}

/// A GeoJSON feature in metres of the area's frame.
nlohmann::ordered_json feature(const char* name, const Region& region) {
  auto polygons = nlohmann::ordered_json::array();
  for (const RingedPolygon& polygon : region) {
    auto rings = nlohmann::ordered_json::array({ring_json(polygon.outer)});
    for (const auto& hole : polygon.holes) rings.push_back(ring_json(hole));
    polygons.push_back(std::move(rings));
  }
  return {{"type", "Feature"},
          {"properties", {{"name", name}, {"area_m2", area_of(region)}}},
          {"geometry", {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons)}}}};
}

nlohmann::ordered_json areas_json(const CoverRun& run) {
  const Coverage& planned = run.proof.planned;
  return {{"type", "FeatureCollection"},
          {"features",
           {feature("area", run.plan.ground.area), feature("reachable", run.plan.ground.reach),
            feature("covered", planned.covered), feature("missed", planned.missed),
            feature("double", planned.twice), feature("covered by the drive", run.driven.covered),
            feature("missed by the drive", run.driven.missed),
            feature("double by the drive", run.driven.twice)}}};
}

nlohmann::ordered_json track_json(const CoverRun& run) {
  const CoverPlan& plan = run.plan;
  const Pose2& start = plan.track.start;
  auto pieces = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < plan.track.pieces.size(); ++i) {
    const PathPiece& piece = plan.track.pieces[i];
    const char* role = plan.roles[i] == PieceRole::lap    ? "lap"
                       : plan.roles[i] == PieceRole::lane ? "lane"
                                                          : "move";
    nlohmann::ordered_json one = {
        {"role", role}, {"from", {piece.from.x, piece.from.y}}, {"to", {piece.to.x, piece.to.y}}};
    if (piece.turn_rad != 0.0) one["centre"] = {piece.centre.x, piece.centre.y};
    if (piece.turn_rad != 0.0) one["turn_rad"] = piece.turn_rad;
    pieces.push_back(std::move(one));
  }
  auto driven = nlohmann::ordered_json::array();
  for (const Vec2 p : run.drive.way) driven.push_back({p.x, p.y});
  return {{"start", {start.position.x, start.position.y, start.heading_rad}},
          {"pieces", std::move(pieces)},
          {"driven", std::move(driven)}};
}

/// The page is made from the text of the report, as a replay makes it.
Outcome<std::string> write_files(const CoverCommand& command, const CoverResult& result) {
  if (command.out.empty()) return std::string{};
  const CoverRun& run = result.run;
  const std::string text = to_json(result.report);
  std::vector<NamedText> files = {{"cover.json", text},
                                  {"track.json", json_text(track_json(run)) + "\n"},
                                  {"areas.geojson", json_text(areas_json(run)) + "\n"},
                                  {"cover.svg", cover_picture(run.plan, run.proof.planned, {})},
                                  {"driven.svg", cover_picture(run.plan, run.driven, run.drive.way)}};
  if (command.html) {
    auto stored = report_from_json(text);
    if (!stored) return pass_on(stored);
    files.emplace_back("cover.html", to_html(*stored, page::viewer()));
  }
  if (auto ok = cli::write_files(command.out, files); !ok) return pass_on(ok);
  return command.out + "/cover.json";
}

Status check_html(const CoverCommand& command) {
  if (!command.html) return {};
  if (command.out.empty()) return bad_input("a page needs a folder; give --out DIR", "--html");
  return check_page("--html");
}

int finish(CoverCommand& command) {
  if (auto ok = check_html(command); !ok) return say(ok.error(), command.json);
  const auto result = carry_out(command.scenario);
  if (!result) return say(result.error(), command.json);
  const auto path = write_files(command, *result);
  if (!path) return say(path.error(), command.json);
  warn(result->report.warnings);
  if (command.json) {
    print(summary_json(command.scenario, *result, *path));
    return job_done;
  }
  show("{}", cover_summary(result->report));
  if (!path->empty())
    show("\n  report    {0}\n  pictures  {1}/cover.svg, {1}/driven.svg\n", *path, command.out);
  if (command.html) show("  watch     {}/cover.html\n", command.out);
  return job_done;
}

int execute(CoverCommand& command, const Command& flags) {
  if (auto ok = read_job_words(flags, command); !ok) return say(ok.error(), flags.given("--json"));
  if (flags.given("file")) command.scenario.area = command.area;
  return finish(command);
}

}  // namespace

int run_cover_scenario(const std::string& path, const Command& flags) {
  CoverCommand command;
  if (auto ok = read_run_words(flags, path, "cover", command, &command.scenario.seed); !ok)
    return say(ok.error(), flags.given("--json"));
  return finish(command);
}

void add_cover(Command& tool) {
  Command& cover = tool.add("cover", "pass over every spot of an area, in a guaranteed time");
  auto command = std::make_shared<CoverCommand>();
  cover
      .positional("file", &command->area,
                  "polygon with holes: GeoJSON, GML, YAML or text; may be gzip-compressed")
      .type("FILE");
  cover.option("--scenario", &command->scenario_path, "scenario file to start from; flags win over it")
      .type("FILE");
  std::vector<OptionGroup> groups = describe(command->scenario);
  groups.insert(groups.begin(), describe_output(*command));
  add_flags(cover, groups);
  cover.does([command](const Command& flags) { return execute(*command, flags); });
  cover.footer("\nExample: outrider cover scenarios/cover/room.txt --width 0.2 --out out");
}

}  // namespace outrider::cli
