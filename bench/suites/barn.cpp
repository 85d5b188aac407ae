// Drives through the worlds of the BARN Challenge, which nobody has mapped, with each rule of motion.
//
// Source: Perille, Truong, Xiao and Stone, Benchmarking metric ground navigation (SSRR 2020); the score: Xiao
// et al., Autonomous ground navigation in highly constrained spaces (IEEE Robotics and Automation Magazine,
// 2022).
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "goal_drive.hpp"
#include "outrider/core/parallel.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/io/files/files.hpp"
#include "rows.hpp"

namespace outrider::bench {
namespace {

constexpr double limit_s = 100.0;  // of a run
constexpr double reached_m = 1.0;  // of the goal, by its true place
constexpr double aimed_m = 0.6;    // of the goal, by its belief
constexpr double ideal_mps = 2.0;  // of the score
constexpr double post_m = 1.0;     // height of a cylinder

/// A world of upright cylinders.
struct BarnWorld {
  std::int64_t number = 0;
  double path_m = 0.0;  ///< length of the published shortest path
  Pose2 start;
  Vec2 goal;
  World world;
};

/// How a run ended.
struct BarnRun {
  bool done = false;
  bool touched = false;
  double time_s = 0.0;  ///< since it had driven 0.1 m
  double score = 0.0;
};

/// The runs of one rule.
struct BarnRow {
  std::string rule;
  std::int64_t runs = 0, done = 0, contacts = 0, not_reached = 0;
  double score = 0.0;   ///< mean
  double time_s = 0.0;  ///< mean of those that are done
};

nlohmann::ordered_json row_json(const BarnRow& row) {
  const auto runs = static_cast<double>(std::max<std::int64_t>(row.runs, 1));
  return {{"rule", row.rule},
          {"runs", row.runs},
          {"success", static_cast<double>(row.done) / runs},
          {"contacts", row.contacts},
          {"not_reached", row.not_reached},
          {"score", row.score},
          {"time_s", row.time_s}};
}

std::string table_text(const std::vector<BarnRow>& rows) {
  std::string text = "rule        runs  success  contacts  not there  time    score (at most 0.5)\n";
  for (const BarnRow& row : rows) {
    text += fmt::format(
        "{:10} {:5}  {:6.1f} %  {:8}  {:8}  {:5.1f} s {:6.4f}\n", row.rule, row.runs,
        100.0 * static_cast<double>(row.done) / static_cast<double>(std::max<std::int64_t>(row.runs, 1)),
        row.contacts, row.not_reached, row.time_s, row.score);
  }
  return text;
}

Solid post(Vec2 place, double radius_m) {
  return {"post", {{place.x, place.y, 0.5 * post_m}, {}}, CylinderShape{radius_m, 0.5 * post_m}};
}

/// Reads the worlds of static_even.json.
Outcome<std::vector<BarnWorld>> read_worlds(const std::string& path, const std::vector<std::string>& wanted) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  std::vector<BarnWorld> worlds;
  try {
    const auto file = nlohmann::json::parse(*text);
    const auto& start = file.at("start");
    const auto& goal = file.at("goal");
    const double radius_m = file.at("radius_m").get<double>();
    for (const auto& [name, entry] : file.at("worlds").items()) {
      if (!wanted.empty() && std::ranges::find(wanted, name) == wanted.end()) continue;
      BarnWorld& one = worlds.emplace_back();
      one.number = std::stoll(name);
      one.path_m = entry.at("path_m").get<double>();
      one.start = {{start.at(0).get<double>(), start.at(1).get<double>()}, start.at(2).get<double>()};
      one.goal = {goal.at(0).get<double>(), goal.at(1).get<double>()};
      for (const auto& centre : entry.at("cylinders"))
        one.world.solids.push_back(post({centre.at(0).get<double>(), centre.at(1).get<double>()}, radius_m));
    }
  } catch (const std::exception& error) {
    return bad_input(fmt::format("is no file of BARN worlds: {}", error.what()), path);
  }
  if (worlds.empty())
    return bad_input("holds none of the worlds that were asked for; --worlds names them by number", path);
  std::ranges::sort(worlds, {}, &BarnWorld::number);
  return worlds;
}

BarnRun drive(const BarnWorld& world, const std::string& rule, std::uint64_t seed) {
  const NavigatorSetup setup = jackal(rule);
  const ExplorerSimParams devices = jackal_devices(setup);
  GoalDrive drive{world.world, world.start, world.goal, setup, devices};
  drive.aimed_m = aimed_m;
  drive.reached_m = reached_m;
  drive.limit_s = limit_s;
  drive.ends_when_near = true;
  const GoalRun driven = run(drive, Rng(seed).child(static_cast<std::uint64_t>(world.number)).bits());
  BarnRun run{driven.done, driven.touched, driven.time_s};
  const double ideal_s = world.path_m / ideal_mps;
  if (run.done) run.score = ideal_s / std::clamp(run.time_s, 2.0 * ideal_s, 8.0 * ideal_s);
  return run;
}

BarnRow row_of(const std::string& rule, const std::vector<BarnRun>& runs) {
  BarnRow row{rule, static_cast<std::int64_t>(runs.size())};
  for (const BarnRun& run : runs) {
    row.done += run.done;
    row.contacts += run.touched;
    row.not_reached += !run.done && !run.touched;
    row.score += run.score / static_cast<double>(runs.size());
    if (run.done) row.time_s += run.time_s;
  }
  if (row.done > 0) row.time_s /= static_cast<double>(row.done);
  return row;
}

}  // namespace

Outcome<BenchResult> measure_barn(const BarnRequest& request, const BenchObserver& observer) {
  auto worlds = read_worlds(request.data + "/static_even.json.gz", request.worlds);
  if (!worlds) return pass_on(worlds);
  if (auto ok = check_rules(request.rules); !ok) return pass_on(ok);
  begin_steps(observer, request.rules.size());
  std::vector<BarnRow> rows;
  const auto seeds = static_cast<std::size_t>(request.seeds);
  for (const std::string& rule : request.rules) {
    next_step(observer, rule);
    std::vector<BarnRun> runs(worlds->size() * seeds);
    parallel_for(runs.size(),
                 [&](std::size_t i) { runs[i] = drive((*worlds)[i / seeds], rule, i % seeds + 1); });
    rows.push_back(row_of(rule, runs));
  }
  return result_of(rows);
}

}  // namespace outrider::bench
