#include "outrider/jobs/cover/job.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "outrider/job/run_job.hpp"
#include "outrider/jobs/cover/mission.hpp"
#include "outrider/jobs/cover/report.hpp"
#include "summary.hpp"

namespace outrider {
namespace {

using Json = nlohmann::ordered_json;

Status cancelled() {
  return fault(FaultCode::cancelled, "it was cancelled while it measured what the drive covers");
}

/// Breaks off where the drive does what was proven that it cannot do.
void check_promises(const CoverRun& run) {
  const bool kept = run.drive.time_s >= run.bound.least_s - 1e-6 &&
                    run.drive.time_s <= run.bound.most_s + 1e-6 &&
                    run.driven.fraction >= run.proof.sure_fraction - 1e-3;
  if (!kept) throw std::logic_error("the simulated drive breaks the bounds of its track");
}

Json ring_json(const std::vector<Vec2>& ring) {
  auto points = Json::array();
  for (const Vec2 p : ring) points.push_back({p.x, p.y});
  if (!ring.empty()) points.push_back({ring.front().x, ring.front().y});
  return points;
}

/// A GeoJSON feature in metres of the area's frame.
Json feature(const char* name, const Region& region) {
  auto polygons = Json::array();
  for (const RingedPolygon& polygon : region) {
    auto rings = Json::array({ring_json(polygon.outer)});
    for (const auto& hole : polygon.holes) rings.push_back(ring_json(hole));
    polygons.push_back(std::move(rings));
  }
  return {{"type", "Feature"},
          {"properties", {{"name", name}, {"area_m2", area_of(region)}}},
          {"geometry", {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons)}}}};
}

Json areas_json(const CoverRun& run) {
  const Coverage& planned = run.proof.planned;
  return {{"type", "FeatureCollection"},
          {"features",
           {feature("area", run.plan.ground.area), feature("reachable", run.plan.ground.reach),
            feature("covered", planned.covered), feature("missed", planned.missed),
            feature("overlap", planned.overlap), feature("covered by the drive", run.driven.covered),
            feature("missed by the drive", run.driven.missed),
            feature("overlap of the drive", run.driven.overlap)}}};
}

Json track_json(const CoverRun& run) {
  const CoverPlan& plan = run.plan;
  const Pose2& start = plan.track.start;
  auto pieces = Json::array();
  for (std::size_t i = 0; i < plan.track.pieces.size(); ++i) {
    const PathPiece& piece = plan.track.pieces[i];
    const char* role = plan.roles[i] == PieceRole::lap    ? "lap"
                       : plan.roles[i] == PieceRole::lane ? "lane"
                                                          : "move";
    Json one = {{"role", role}, {"from", {piece.from.x, piece.from.y}}, {"to", {piece.to.x, piece.to.y}}};
    if (piece.turn_rad != 0.0) one["centre"] = {piece.centre.x, piece.centre.y};
    if (piece.turn_rad != 0.0) one["turn_rad"] = piece.turn_rad;
    pieces.push_back(std::move(one));
  }
  auto driven = Json::array();
  for (const Vec2 p : run.drive.way) driven.push_back({p.x, p.y});
  return {{"start", {start.position.x, start.position.y, start.heading_rad}},
          {"pieces", std::move(pieces)},
          {"driven", std::move(driven)}};
}

std::string text_of(const Json& object) { return object.dump() + "\n"; }

/// The options with the method that was chosen.
std::vector<std::pair<std::string, std::string>> settled_settings(const CoverScenario& scenario,
                                                                  const std::string& method) {
  CoverJob settled;
  settled.scenario = scenario;
  settled.scenario.method = method;
  return settings_of(settled.options());
}

}  // namespace

Outcome<Warnings> CoverJob::load() {
  auto loaded = load_task(scenario);
  if (!loaded) return pass_on(loaded);
  task = std::move(*loaded);
  return task->note.empty() ? Warnings{} : Warnings{task->note};
}

Status CoverJob::run(Run& run, const RunWatch& watch) {
  const CoverProblem& problem = task->problem;
  RunSteps steps(watch, 3);
  if (auto ok = steps.next("planning the track"); !ok) return ok;
  auto plan = task->method.plan(problem, scenario.options, watch.budget());
  if (!plan) return tl::unexpected<Fault>(placed(plan.error(), *task));
  if (auto ok = steps.next("proving what it covers"); !ok) return ok;
  auto proof = prove(*plan, problem, watch.budget());
  if (!proof && proof.error().code == FaultCode::cancelled) return tl::unexpected<Fault>(proof.error());
  if (!proof) throw std::logic_error(to_string(proof.error()));
  CoverRun driven{std::move(*plan), std::move(*proof), {}, {}, {}};
  const CoverPlan& planned = driven.plan;
  driven.bound = time_bound(planned.track, problem.pace, problem.tracking_error_m, scenario.error_factor);
  if (auto ok = steps.next("driving it"); !ok) return ok;
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  const std::string name = std::filesystem::path(scenario.area).filename().string();
  CoverLog log(run.log, problem, planned, seed, name);
  driven.drive = drive_track(planned.track, *planned.ground.ground, problem.pace, problem.tracking_error_m,
                             seed, steps.inner(), [&](const PieceDrive& so_far) { log.note(so_far); });
  // What a stopped drive has covered is still measured; the measuring of a whole one can be stopped.
  const std::stop_token stop = driven.finished() ? watch.stop : std::stop_token{};
  driven.driven = coverage_of(driven.drive.way, problem.radius_m(), planned.ground.reach, stop);
  if (stop.stop_requested()) return cancelled();
  if (driven.finished()) check_promises(driven);
  log.finish(driven.drive, driven.driven);
  run.report = cover_report(problem, driven, name);
  run.report.settings = settled_settings(scenario, planned.method);
  if (!driven.finished()) mark_cancelled(run.report, run.log, driven.drive.time_s);
  run.files = {{"track.json", text_of(track_json(driven))}, {"areas.geojson", text_of(areas_json(driven))}};
  return {};
}

Job cover_job() {
  return {.name = "cover",
          .sentence = "Pass over every spot of an area, in a guaranteed time.",
          .example = "cover scenarios/cover/room.txt --width 0.2 --out out",
          .blank = [] { return std::make_unique<CoverJob>(); },
          .file_option = "area",
          .file_sentence = "polygon with holes: GeoJSON, GML, YAML or text; may be gzip-compressed",
          .summary = cover_summary};
}

}  // namespace outrider
