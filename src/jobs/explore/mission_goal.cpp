#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mission_parts.hpp"

namespace outrider {
namespace {

constexpr double here_m = 0.5;

/// Returns true if all poses were optimised lately; otherwise requests it with the next scan. Before the
/// robot goes home that may show that something is left to see, and when it believes that it is home, that it
/// is not.
bool settled(ExploreMission& mission, double lately_m = std::numeric_limits<double>::infinity()) {
  if (mission.settled_m && mission.driven_m - *mission.settled_m <= lately_m) return true;
  mission.wants_settling = true;
  mission.path.reset();
  return false;
}

/// Returns the way home along the driven trail: the robot has come on it, whatever the map says now. Where
/// the trail comes by the same place again, what lies between is left out.
std::vector<Vec2> trail_home(const ExploreMission& mission) {
  constexpr double same_m = 0.03;
  const std::vector<Pose2> came = mission.slam.trajectory();
  std::vector<Vec2> way{mission.pose.position};
  for (std::size_t at = came.size(); at-- > 0;) {
    std::size_t earliest = at;
    for (std::size_t i = 0; i < at; ++i) {
      if (distance(came[i].position, came[at].position) > same_m) continue;
      earliest = i;
      break;
    }
    at = earliest;
    if (distance(way.back(), came[at].position) > 0.01) way.push_back(came[at].position);
  }
  if (way.size() == 1) way.push_back(mission.task.start.position);
  return way;
}

/// Sends the robot home, or ends the mission if it is there or need not return.
void turn_home(ExploreMission& mission, const std::string& stop_reason, const std::string& reason) {
  if (mission.stop_reason != stop_reason) add_event(mission, "home", reason);
  mission.stop_reason = stop_reason;
  mission.reason = reason;
  mission.home =
      distance(mission.pose.position, mission.task.start.position) <= mission.task.rules.home_within_m;
  if (mission.task.rules.return_home && mission.home && !settled(mission, here_m)) {
    mission.arriving = true;
    return;
  }
  if (!mission.task.rules.return_home || mission.home) return end(mission, stop_reason, reason);
  auto way = way_to(state_of(mission), mission.task.start.position, mission.task.explore, mission.workspace);
  if (mission.stage != ExploreStage::go_home) moved_on(mission);
  mission.stage = ExploreStage::go_home;
  mission.on_trail = !way;
  follow(mission, way ? std::move(*way) : trail_home(mission));
}

/// Goes home with the judgement of what is left over.
void nothing_to_reach(ExploreMission& mission) {
  if (!settled(mission)) return;
  if (mission.left.places.empty()) return turn_home(mission, "complete", mission.decision.sentence);
  turn_home(mission, "left_over",
            mission.left.sentence(wanted_width_m(mission.task.robot, mission.task.explore)));
}

void take(ExploreMission& mission, Decision decision) {
  const bool elsewhere = decision.choice.frontier != mission.decision.choice.frontier ||
                         mission.stage != ExploreStage::seek || !mission.path;
  mission.decision = std::move(decision);
  if (mission.decision.kind == DecisionKind::complete) return nothing_to_reach(mission);
  if (mission.decision.kind == DecisionKind::leak)
    return turn_home(mission, "leak", mission.decision.sentence);
  if (elsewhere) {
    ++mission.goal_changes;
    mission.settled_m.reset();
    mission.home_left_m.fill(ExploreMission::no_way_m);
    moved_on(mission);
    add_event(mission, "goal", mission.decision.sentence);
  }
  mission.stage = ExploreStage::seek;
  mission.on_trail = false;
  mission.stop_reason.clear();
  mission.reason.clear();
  follow(mission, mission.decision.waypoints);
}

bool spent(const ExploreMission& mission, const ExploreRules& rules) {
  return mission.time_s - *mission.started_s > rules.most_time_s || mission.driven_m > rules.most_distance_m;
}

/// Decides. Where nothing can be reached, it judges what is left over, and tries the narrow ways and the
/// goals that failed once more.
Outcome<Decision> decide_with_tries(ExploreMission& mission) {
  constexpr int most_failures = 3;
  constexpr int most_rounds = 4;
  constexpr double valid_s = 2.0;  // of a judgement on the way home
  const ExploreOptions& options = mission.task.explore;
  for (int i = 0;; ++i) {
    auto decision = decide(state_of(mission), options, mission.workspace);
    if (!decision || decision->kind != DecisionKind::complete) return decision;
    if (mission.stage == ExploreStage::go_home && mission.time_s - mission.left_s < valid_s) return decision;
    mission.left = left_over(state_of(mission), options, decision->refused, false, mission.narrow);
    mission.left_s = mission.time_s;
    const bool failed = std::ranges::count(mission.left.places, LeftReason::failed, &LeftOver::reason) > 0;
    if (i == most_rounds || (!open_narrow_way(mission, mission.left) &&
                             !(failed && mission.blacklist.lift(most_failures, mission.time_s))))
      return decision;
  }
}

/// Decides at home, on the settled map, whether something is left to see.
bool goes_out_again(ExploreMission& mission) {
  constexpr int most_returns = 2;
  if (mission.returns == most_returns) return false;
  auto decision = decide_with_tries(mission);
  if (!decision || decision->kind != DecisionKind::go) return false;
  ++mission.returns;
  mission.arriving = false;
  take(mission, std::move(*decision));
  return true;
}

/// The planner has had no budget for a decision: waits for a while, then goes home.
void go_without_planner(ExploreMission& mission, const Fault& fault) {
  constexpr double patience_s = 10.0;
  if (!mission.planless_s) add_event(mission, "stuck", "no way is planned, so it waits: " + fault.sentence);
  const double since_s = mission.planless_s.value_or(mission.time_s);
  mission.planless_s = since_s;
  mission.path.reset();
  if (mission.time_s - since_s < patience_s) return;
  turn_home(mission, "stuck",
            fmt::format("no way can be planned since {:.1f} s: {}", since_s, fault.sentence));
}

}  // namespace

bool sees_nothing_new(const ExploreMission& mission) {
  constexpr double patience_s = 200.0, ways = 2.0;
  if (mission.stage != ExploreStage::seek) return false;
  const TraversabilityGrid& ground = mission.frontiers.ground();
  const int cells = ground.highest().x - ground.lowest().x + ground.highest().y - ground.lowest().y + 2;
  const double across_s = cells * ground.frame().resolution_m / mission.task.robot.speed_mps;
  return mission.time_s - mission.learned_s > patience_s + ways * across_s;
}

void decide_anew(ExploreMission& mission) {
  const bool arrived =
      mission.path && mission.stage == ExploreStage::seek && remaining_m(*mission.path) < arrived_m;
  const std::uint32_t goal = mission.decision.choice.frontier;
  mission.decided_s = mission.time_s;
  ++mission.decisions;
  if (spent(mission, mission.task.rules)) {
    return turn_home(
        mission, "budget",
        fmt::format("its budget is spent after {:.0f} s and {:.1f} m", mission.time_s, mission.driven_m));
  }
  if (sees_nothing_new(mission)) {
    return turn_home(
        mission, "stuck",
        fmt::format("nothing new was seen since {:.0f} s, though the map is open; are its cells and "
                    "odds right for this robot?",
                    mission.learned_s));
  }
  const bool explored = mission.stop_reason == "complete" || mission.stop_reason == "left_over";
  const bool for_good = mission.stage == ExploreStage::go_home && !explored && !mission.planless_s;
  if (mission.arriving || for_good) {
    if (mission.arriving && explored && goes_out_again(mission)) return;
    return turn_home(mission, mission.stop_reason, mission.reason);
  }
  // Looked at from where it was to be seen, and still there: it will not be seen.
  if (arrived && mission.frontiers.frontiers().contains(goal))
    mission.blacklist.add(mission.decision.choice.place, mission.time_s);
  auto decision = decide_with_tries(mission);
  if (!decision && decision.error().code == FaultCode::budget_exhausted) {
    go_without_planner(mission, decision.error());
    return;
  }
  mission.planless_s.reset();
  if (!decision) return turn_home(mission, "stuck", decision.error().sentence);
  take(mission, std::move(*decision));
}

}  // namespace outrider
