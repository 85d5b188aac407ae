#include "cover_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "commands.hpp"
#include "cover_picture.hpp"
#include "flags.hpp"
#include "output.hpp"
#include "outrider/cover/time_bound.hpp"
#include "outrider/io/cover_scenario.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/sim/cover_drive.hpp"
#include "progress.hpp"
#include "scenario_words.hpp"

namespace outrider::cli {
namespace {

struct CoverCommand {
  std::string scenario_path;
  std::string area;
  bool json = false;
  std::string out;
  CoverScenario scenario;
};

OptionGroup describe_output(CoverCommand& command) {
  return {"",
          "output",
          {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
           {"out", "", 0, 0, "folder for the track, the areas and a picture", &command.out}}};
}

struct CoverResult {
  CoverProblem problem;
  std::string note;
  CoverPlan plan;
  CoverProof proof;
  TimeBound bound;
  CoverDrive drive;
  Coverage driven;
};

Outcome<CoverResult> carry_out(const CoverScenario& scenario) {
  Progress progress(4);
  progress.next("reading the area");
  auto task = load_task(scenario);
  if (!task) return pass_on(task);
  progress.next("planning the track");
  auto plan = task->method.plan(task->problem, scenario.options, {});
  if (!plan) return tl::unexpected<Fault>(placed(plan.error(), *task));
  progress.next("proving what it covers");
  auto proof = prove(*plan, task->problem);
  if (!proof) throw std::logic_error(to_string(proof.error()));
  const CoverProblem& problem = task->problem;
  CoverResult result{problem, task->note, std::move(*plan), std::move(*proof), {}, {}, {}};
  const CoverTrack& track = result.plan.track;
  result.bound = time_bound(track, problem.pace, problem.stray_m, scenario.error_factor);
  progress.next("driving it");
  result.drive = drive_track(track, *result.plan.ground.ground, problem.pace, problem.stray_m,
                             static_cast<std::uint64_t>(scenario.seed));
  result.driven = coverage_of(result.drive.way, problem.radius_m(), result.plan.ground.reach);
  const bool kept = result.drive.time_s >= result.bound.least_s - 1e-6 &&
                    result.drive.time_s <= result.bound.most_s + 1e-6 &&
                    result.driven.fraction >= result.proof.sure_fraction - 1e-3;
  if (!kept) throw std::logic_error("the simulated drive breaks the bounds of its track");
  return result;
}

nlohmann::ordered_json summary_json(const CoverScenario& scenario, const CoverResult& result) {
  const CoverPlan& plan = result.plan;
  const CoverProof& proof = result.proof;
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
          {"t_min_s", result.bound.least_s},
          {"planned_s", plan.sums.time_s},
          {"t_max_s", result.bound.most_s},
          {"time_s", result.drive.time_s},
          {"order_lower_bound_s", plan.order_bound_s},
          {"guarantee",
           {{"stray_m", result.problem.stray_m},
            {"error_factor", scenario.error_factor},
            {"covered_fraction", proof.sure_fraction},
            {"covered_fraction_off_the_rim", proof.inner_fraction}}},
          {"driven",
           {{"seed", scenario.seed},
            {"time_s", result.drive.time_s},
            {"length_m", result.drive.length_m},
            {"turned_rad", result.drive.turned_rad},
            {"strayed_m", result.drive.strayed_m},
            {"covered_fraction", result.driven.fraction},
            {"missed_m2", result.driven.missed_m2},
            {"double_m2", result.driven.twice_m2}}}};
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

nlohmann::ordered_json areas_json(const CoverResult& result) {
  const Coverage& planned = result.proof.planned;
  return {{"type", "FeatureCollection"},
          {"features",
           {feature("area", result.plan.ground.area), feature("reachable", result.plan.ground.reach),
            feature("covered", planned.covered), feature("missed", planned.missed),
            feature("double", planned.twice), feature("covered by the drive", result.driven.covered),
            feature("missed by the drive", result.driven.missed),
            feature("double by the drive", result.driven.twice)}}};
}

nlohmann::ordered_json track_json(const CoverResult& result) {
  const CoverPlan& plan = result.plan;
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
  for (const Vec2 p : result.drive.way) driven.push_back({p.x, p.y});
  return {{"start", {start.position.x, start.position.y, start.heading_rad}},
          {"pieces", std::move(pieces)},
          {"driven", std::move(driven)}};
}

Status write_files(const CoverCommand& command, const CoverResult& result) {
  if (command.out.empty()) return {};
  return cli::write_files(command.out,
                          {{"cover.json", summary_json(command.scenario, result).dump(1) + "\n"},
                           {"track.json", track_json(result).dump() + "\n"},
                           {"areas.geojson", areas_json(result).dump() + "\n"},
                           {"cover.svg", cover_picture(result.plan, result.proof.planned, {})},
                           {"driven.svg", cover_picture(result.plan, result.driven, result.drive.way)}});
}

void print_summary(const CoverCommand& command, const CoverResult& result) {
  const CoverPlan& plan = result.plan;
  const CoverProof& proof = result.proof;
  const double area = area_of(plan.ground.area), reach = area_of(plan.ground.reach);
  fmt::print("  area      {:.6g} m2, of which a disk of {:g} m reaches {:.6g} m2\n", area,
             result.problem.width_m, reach);
  fmt::print("  track     {}: {:.2f} m, {} stops; {} laps, {} cells, {} lanes\n", plan.method,
             plan.sums.length_m, plan.sums.stops, plan.laps, plan.cells, plan.lanes);
  fmt::print("  covered   {:.3f} % of the reach, {:.3g} m2 missed, {:.3g} m2 twice\n",
             100.0 * proof.planned.fraction, proof.planned.missed_m2, proof.planned.twice_m2);
  fmt::print("  time      {} to {}, at full speed {}\n", duration_text(result.bound.least_s),
             duration_text(result.bound.most_s), duration_text(plan.sums.time_s));
  fmt::print(
      "  surely    {:.3f} % of the reach and {:.3f} % of it off the rim, if the robot strays by {:g} m\n",
      100.0 * proof.sure_fraction, 100.0 * proof.inner_fraction, result.problem.stray_m);
  fmt::print("  driven    {} with seed {}, {:.3f} % covered\n", duration_text(result.drive.time_s),
             command.scenario.seed, 100.0 * result.driven.fraction);
  if (!command.out.empty()) fmt::print("\n  pictures  {0}/cover.svg, {0}/driven.svg\n", command.out);
}

int finish(CoverCommand& command) {
  const auto result = carry_out(command.scenario);
  if (!result) return say(result.error(), command.json);
  if (!result->note.empty()) fmt::print(stderr, "outrider: warning: {}\n", result->note);
  if (auto ok = write_files(command, *result); !ok) return say(ok.error(), command.json);
  command.json ? print(summary_json(command.scenario, *result)) : print_summary(command, *result);
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
