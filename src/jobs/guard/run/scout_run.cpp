#include "outrider/jobs/guard/run/scout_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/rng.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "run/guard_log.hpp"

namespace outrider {
namespace {

constexpr double coarse_m = 1.0;  // of the true map, which serves the simulation alone

/// Sees targets while the robot explores.
class TargetDetector {
 public:
  TargetDetector(const std::vector<Target>& targets, const ScoutOptions& options, std::uint64_t seed)
      : seen(targets.size()), targets_(targets), options_(options), rng_(Rng(seed).child("lookout")) {}

  void look(const ExploreMission& mission, const SimulatedRobot& robot) {
    const Pose2 truth = robot.pose();
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const Vec2 place = xy(targets_[i].base);
      if (distance(truth.position, place) > options_.sight_m) continue;
      if (!robot.devices().laser->finder().sees(truth.position, place)) continue;
      const Vec2 ahead = truth.to_local(place);
      const Vec2 error = options_.sight_error_m * Vec2{rng_.normal(), rng_.normal()};
      const Vec2 believed = mission.where().pose() * ahead + error;
      if (!seen[i]) seen[i].emplace();
      seen[i]->add(believed, mission.where().time_s());
    }
  }

  std::vector<std::optional<SeenTarget>> seen;

 private:
  const std::vector<Target>& targets_;
  const ScoutOptions& options_;
  Rng rng_;
};

/// The true yard, with the targets that were found first, in their order there.
GuardProblem true_yard(const GuardProblem& truth, const FoundYard& found, const Pose2& start) {
  GuardProblem yard = truth;
  yard.start = start;
  yard.supplies.stations = found.problem.supplies.stations;
  yard.targets.clear();
  for (const std::size_t i : found.targets) yard.targets.push_back(truth.targets[i]);
  return yard;
}

/// How often a straight of the path of the robot since `from_s` touches what stands there.
double contacts(const Log& log, double from_s, const CollisionMap& ground, double radius_m) {
  double count = 0.0;
  bool touching = false;
  std::optional<Vec2> before;
  for (const auto& pose : log.messages<geometry_msgs::PoseStamped>(topic::pose)) {
    if (pose.time_s() < from_s) continue;
    const Vec2 here = pose_of(pose.message.pose).position;
    const bool touches = before && !ground.segment_free({*before, here}, radius_m);
    if (touches && !touching) ++count;
    touching = touches;
    before = here;
  }
  return count;
}

std::string why_unshot(bool seen) {
  return seen ? "seen where the map has something" : "not seen while exploring";
}

/// Logs the targets that the robot did not find a place for.
void log_other_targets(Log& log, const GuardProblem& truth, const ScoutedYard& yard) {
  for (std::size_t i = 0; i < truth.targets.size(); ++i) {
    if (std::ranges::count(yard.found.targets, i) > 0) continue;
    const Target& target = truth.targets[i];
    log.append(topic::targets, 0.0,
               outrider_msgs::Target{target.name, "failed", why_unshot(yard.seen[i].has_value()),
                                     vector_of(target.size), target.yaw_rad, 0, ""});
    log.append(
        topic::target_positions, 0.0,
        outrider_msgs::TargetPosition{target.name, point_of(target.centre()), point_of(xy(target.base))});
  }
}

/// Returns the rows of all targets in the order of the yard. `found` has those of the targets that were
/// found, with times that count from the end of the exploration; it is null if the yard was not guarded.
Table all_targets(const Table* found, const GuardProblem& truth, const ScoutedYard& yard) {
  const double explore_s = metric(yard.run.report, "time_s");
  Table all = target_table();
  for (std::size_t i = 0; i < truth.targets.size(); ++i) {
    const auto at = std::ranges::find(yard.found.targets, i);
    if (found == nullptr || at == yard.found.targets.end()) {
      const std::string why =
          found == nullptr && yard.seen[i] ? "seen, but not shot at" : why_unshot(yard.seen[i].has_value());
      all.rows.push_back(unshot_row(truth.targets[i].name, "failed", why, explore_s));
      continue;
    }
    all.rows.push_back(found->rows[static_cast<std::size_t>(at - yard.found.targets.begin())]);
    const auto done = std::ranges::find(all.columns, "done_s") - all.columns.begin();
    TableValue& done_s = all.rows.back()[static_cast<std::size_t>(done)];
    done_s = std::get<double>(done_s) + explore_s;
  }
  return all;
}

void log_sightings(Log& log, const GuardProblem& truth, const ScoutedYard& yard) {
  for (std::size_t i = 0; i < yard.seen.size(); ++i) {
    if (!yard.seen[i]) continue;
    const SeenTarget& seen = *yard.seen[i];
    log_event(
        log, 0.0, "seen",
        fmt::format("{} came into sight at {:.1f} s; {} looks put it at ({:.2f}, {:.2f}), {:.0f} mm off",
                    truth.targets[i].name, seen.first_s, seen.looks, seen.mean.x, seen.mean.y,
                    1e3 * distance(seen.mean, xy(truth.targets[i].base))));
  }
}

void set(Report& report, std::string_view name, double value) {
  for (auto& [key, held] : report.metrics) {
    if (key == name) held = value;
  }
}

double count(const Table& targets, std::string_view status) {
  return static_cast<double>(std::ranges::count_if(
      targets.rows, [&](const auto& values) { return TableRow{targets, values}.text("status") == status; }));
}

double count_seen(const ScoutedYard& yard) {
  return static_cast<double>(
      std::ranges::count_if(yard.seen, [](const auto& target) { return target.has_value(); }));
}

void add_explored(Report& report, const ScoutedYard& yard, double touches) {
  const Report& explored = yard.run.report;
  report.metrics.insert(report.metrics.end(), {{"seen", count_seen(yard)},
                                               {"explored_fraction", metric(explored, "explored_fraction")},
                                               {"map_error_m", metric(explored, "map_error_m")},
                                               {"explore_s", metric(explored, "time_s")},
                                               {"left_over_m2", metric(explored, "left_over_m2")},
                                               {"contacts", touches}});
}

/// Status and totals of the whole mission.
void conclude(Report& report, const ScoutedYard& yard, const Log& log, double touches) {
  const Report& explored = yard.run.report;
  const Table& table = table_named(report, "targets");
  const double failed = count(table, "failed"), reached = count(table, "reached");
  const auto targets = static_cast<double>(table.rows.size());
  set(report, "targets", targets);
  set(report, "failed", failed);
  set(report, "mission_s", metric(report, "mission_s") + metric(explored, "time_s"));
  set(report, "driven_m", metric(report, "driven_m") + metric(explored, "distance_m"));
  set(report, "turned_rad", metric(report, "turned_rad") + metric(explored, "turned_rad"));
  add_explored(report, yard, touches);
  if (report.status == "cancelled") return;
  report.reason = ran_dry(log);
  report.status = failed == 0.0 && touches == 0.0 && report.reason.empty() ? "done" : "not_done";
  if (!report.reason.empty()) return;
  if (reached < targets) {
    report.reason = fmt::format("{} of {} targets seen, {} reached, {} failed", count_seen(yard), targets,
                                reached, failed) +
                    why_stranded(log);
    if (explored.status != "done") report.reason += "; exploring: " + explored.reason;
  } else if (touches > 0.0) {
    report.reason = "something was touched";
  }
}

/// Returns the levels of the stores after the exploring: no shot was fired, but time and way took charge.
StoreLevels levels_after(const Report& explored, const Supplies& supplies) {
  const double used_j = supplies.charge_of(metric(explored, "time_s"), metric(explored, "distance_m"));
  return {supplies.full(Store::water), supplies.full(Store::charge) - used_j};
}

}  // namespace

Outcome<ScoutedYard> scout(const GuardProblem& truth, const ScoutTask& task, std::uint64_t seed, Log& log,
                           const RunWatch& watch) {
  ExploreTask explore = task.explore;
  explore.start = truth.start;
  explore.robot = truth.robot;
  TargetDetector detector(truth.targets, task.options, seed);
  std::vector<Vec2> stood;
  auto run = run_explore(truth.world, explore, task.sensors, seed, log, watch,
                         [&](const Observation&, const ExploreMission& mission, const SimulatedRobot& robot) {
                           detector.look(mission, robot);
                           stood.push_back(mission.where().pose().position);
                         });
  if (!run) return pass_on(run);
  if (run->report.status == "cancelled") return ScoutedYard{std::move(*run), std::move(detector.seen), {}};
  ScoutedYard yard{std::move(*run), std::move(detector.seen), {}, {}};
  if (yard.run.stop_reason == "lost" || yard.run.stop_reason == "blind") {
    yard.failure = "the yard could not be explored: " + yard.run.report.reason;
    return yard;
  }
  auto found =
      found_yard(truth, task.options, yard.run.map, stood, yard.seen, yard.run.true_pose, yard.run.touched);
  if (found)
    yard.found = std::move(*found);
  else
    yard.failure = found.error().sentence;
  return yard;
}

Report unguarded(const GuardProblem& truth, const ScoutedYard& yard, const std::string& why) {
  const Report& explored = yard.run.report;
  const auto targets = static_cast<double>(truth.targets.size());
  Report report;
  report.world_name = explored.world_name;
  report.status = "not_done";
  report.reason = "the yard was explored, but it is not guarded: " + why;
  report.tables = {all_targets(nullptr, truth, yard)};
  report.metrics = {{"targets", targets},
                    {"reached", 0.0},
                    {"failed", targets},
                    {"unreachable", 0.0},
                    {"mission_s", metric(explored, "time_s")},
                    {"driven_m", metric(explored, "distance_m")},
                    {"turned_rad", metric(explored, "turned_rad")},
                    {"shots", 0.0}};
  add_explored(report, yard, metric(explored, "contacts"));
  return report;
}

Outcome<TrueYard> begin_on_map(const GuardProblem& truth, const ScoutedYard& yard, GuardOptions options,
                               const Budget& budget, Log& log) {
  GuardProblem really = true_yard(truth, yard.found, yard.found.problem.start);
  options.resolution_m = coarse_m;
  auto map = build_firing_map(really, options, budget, RegionSearch::none);
  if (!map) return pass_on(map);
  log.begin_at(metric(yard.run.report, "time_s"));
  log_sightings(log, truth, yard);
  log_other_targets(log, truth, yard);
  return TrueYard{std::move(really), std::move(*map), levels_after(yard.run.report, truth.supplies)};
}

void add_exploring(Report& report, const GuardProblem& truth, const ScoutedYard& yard, const TrueYard& really,
                   const Log& log) {
  const Report& explored = yard.run.report;
  report.tables = {all_targets(&table_named(report, "targets"), truth, yard)};
  const double touches =
      metric(explored, "contacts") +
      contacts(log, metric(explored, "time_s"), really.firing_map.ground, truth.robot.radius_m);
  conclude(report, yard, log, touches);
}

}  // namespace outrider
