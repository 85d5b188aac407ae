#include "outrider/jobs/explore/mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/jobs/explore/catalog.hpp"
#include "outrider/jobs/explore/view.hpp"
#include "outrider/path/catalog.hpp"

namespace outrider {
namespace {

constexpr double arrived_m = 0.03;  ///< of the end of a path
constexpr double moved_m = 0.04, turned_rad = 0.3;
constexpr double nearby_m = 0.9;
constexpr double here_m = 0.5;
constexpr double elsewhere_m = 20.0;  ///< driven between two times stuck that have nothing in common

/// Returns true if the scan is usable.
bool usable(const LaserScan& scan) {
  return check(scan) &&
         std::ranges::any_of(scan.ranges_m, [&](float range) { return range >= scan.least_m; });
}

/// Returns the end points of the beams that hit something.
std::vector<Vec2> ends_of(const LaserScan& scan, const Pose2& world_T_laser) {
  std::vector<Vec2> ends;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m >= scan.least_m && range_m <= std::min(scan.most_m, 2.0 * nearby_m))) continue;
    const double bearing =
        world_T_laser.heading_rad + scan.first_rad + static_cast<double>(i) * scan.step_rad;
    ends.push_back(world_T_laser.position + range_m * direction(bearing));
  }
  return ends;
}

void add_event(ExploreMission& mission, std::string kind, std::string text) {
  mission.events.push_back({mission.time_s, std::move(kind), std::move(text)});
}

void end(ExploreMission& mission, std::string stop_reason, std::string reason) {
  mission.stage = ExploreStage::over;
  mission.path.reset();
  mission.stop_reason = std::move(stop_reason);
  mission.reason = std::move(reason);
  add_event(mission, "end", mission.reason);
}

ExploreState state_of(ExploreMission& mission) {
  return {mission.frontiers, mission.blacklist,  mission.task.robot, mission.range_m,
          mission.pose,      mission.task.start, mission.time_s,     mission.decision.choice};
}

void moved_on(ExploreMission& mission) {
  mission.stood = mission.pose;
  mission.moved_on_s = mission.time_s;
}

/// Whether the map was brought to its best lately; else it will be, with the next scan. Before the robot goes
/// home that may show that something is left to see, and when it believes that it is home, that it is not.
bool settled(ExploreMission& mission, double lately_m = std::numeric_limits<double>::infinity()) {
  if (mission.settled_m && mission.driven_m - *mission.settled_m <= lately_m) return true;
  mission.wants_settling = true;
  mission.path.reset();
  return false;
}

/// The way home, or the end without one.
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
  if (!way) return end(mission, "stuck", "there is no way home: " + way.error().sentence);
  if (mission.stage != ExploreStage::go_home) moved_on(mission);
  mission.stage = ExploreStage::go_home;
  mission.path = PathProgress{std::move(*way), 0.0};
}

void take(ExploreMission& mission, Decision decision) {
  const bool elsewhere = decision.choice.frontier != mission.decision.choice.frontier ||
                         mission.stage != ExploreStage::seek || !mission.path;
  mission.decision = std::move(decision);
  if (mission.decision.kind == DecisionKind::complete && !settled(mission)) return;
  if (mission.decision.kind == DecisionKind::complete)
    return turn_home(mission, "complete", mission.decision.sentence);
  if (mission.decision.kind == DecisionKind::leak)
    return turn_home(mission, "leak", mission.decision.sentence);
  if (elsewhere) {
    ++mission.goal_changes;
    mission.settled_m.reset();
    moved_on(mission);
    add_event(mission, "goal", mission.decision.sentence);
  }
  mission.stage = ExploreStage::seek;
  mission.stop_reason.clear();
  mission.reason.clear();
  mission.path = PathProgress{mission.decision.waypoints, 0.0};
}

bool spent(const ExploreMission& mission, const ExploreRules& rules) {
  return mission.time_s - *mission.started_s > rules.most_time_s || mission.driven_m > rules.most_distance_m;
}

/// Returns true if the next part of the path is blocked.
bool blocked(const ExploreMission& mission, const Nearby& nearby) {
  const double wanted = std::min(mission.task.robot.radius_m + mission.task.steer.least_gap_m,
                                 nearby.clearance(mission.pose.position) - 1e-3);
  double before = 0.0;
  const PathProgress& path = *mission.path;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Segment leg{path.points[i - 1], path.points[i]};
    const double length = distance(leg.a, leg.b);
    before += length;
    if (before <= path.along_m || length == 0.0) continue;
    const double from = std::max(0.0, path.along_m - (before - length));
    const Segment ahead{leg.a + (from / length) * (leg.b - leg.a), leg.b};
    if (distance(ahead.a, mission.pose.position) > nearby_m) return false;
    if (nearby.clearance(ahead) < wanted) return true;
  }
  return false;
}

/// Returns true if it is time for a new decision.
bool time_to_decide(const ExploreMission& mission, const Nearby& nearby) {
  if (!mission.looked) return false;
  if (!mission.path) return true;
  if (mission.time_s - mission.decided_s >= mission.task.rules.think_again_s) return true;
  if (mission.stage == ExploreStage::seek &&
      !mission.frontiers.frontiers().contains(mission.decision.choice.frontier))
    return true;
  return remaining_m(*mission.path) < arrived_m || blocked(mission, nearby);
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
  if (mission.arriving || (mission.stage == ExploreStage::go_home && mission.stop_reason != "complete"))
    return turn_home(mission, mission.stop_reason, mission.reason);
  // Looked at from where it was to be seen, and still there: it will not be seen.
  if (arrived && mission.frontiers.frontiers().contains(goal))
    mission.blacklist.add(mission.decision.choice.place, mission.time_s);
  auto decision = decide(state_of(mission), mission.task.explore, mission.workspace);
  if (!decision) return turn_home(mission, "stuck", decision.error().sentence);
  take(mission, std::move(*decision));
}

/// Goes back along the way it came, and leaves the goal out for a while.
void back_off(ExploreMission& mission) {
  if (mission.driven_m - mission.stuck_m > elsewhere_m) mission.stuck_here = 0;
  mission.stuck_m = mission.driven_m;
  ++mission.stuck;
  ++mission.stuck_here;
  add_event(mission, mission.touching ? "touch" : "stuck",
            fmt::format("at ({:.2f}, {:.2f}): {}; it goes back a little", mission.pose.position.x,
                        mission.pose.position.y,
                        mission.touching ? "something was touched" : "it does not move on"));
  if (mission.stuck_here > mission.task.rules.most_stuck)
    return end(mission, "stuck", fmt::format("it got stuck {} times in a row", mission.stuck_here));
  if (mission.stage == ExploreStage::seek && mission.path)
    mission.blacklist.add(mission.decision.choice.place, mission.time_s);
  std::vector<Vec2> way = {mission.pose.position};
  const std::vector<Pose2> came = mission.slam.trajectory();
  double length = 0.0;
  for (auto pose = came.rbegin(); pose != came.rend() && length < mission.task.rules.back_off_m; ++pose) {
    const double leg = distance(way.back(), pose->position);
    if (leg < 0.02) continue;
    length += leg;
    way.push_back(pose->position);
  }
  mission.stage = ExploreStage::back_off;
  mission.path = PathProgress{std::move(way), 0.0};
  moved_on(mission);
}

/// Returns the twist for a robot that drives backwards.
Twist2 steer_back(const ExploreMission& mission, const Nearby& nearby) {
  const Pose2 turned{mission.pose.position, mission.pose.heading_rad + pi};
  const Twist2 now{-mission.twist.ahead_mps, 0.0, mission.twist.turn_radps};
  RobotModel slow = mission.task.robot;
  slow.speed_mps *= 0.5;
  const Twist2 back = steer(*mission.path, turned, now, nearby, slow, mission.task.steer);
  return {-back.ahead_mps, 0.0, back.turn_radps};
}

/// Keeps an eye on getting on; true when it has to go back.
bool stands_still(ExploreMission& mission) {
  const bool moved = distance(mission.pose.position, mission.stood.position) > moved_m ||
                     std::abs(wrap_angle(mission.pose.heading_rad - mission.stood.heading_rad)) > turned_rad;
  if (moved) moved_on(mission);
  return mission.time_s - mission.moved_on_s > mission.task.rules.patience_s;
}

/// Returns the obstacles around the robot: by the map, or by the newest scan if the map encloses the robot.
Nearby surroundings(const ExploreMission& mission) {
  constexpr std::int64_t often = 3;
  constexpr double beam_m = 0.01;
  if (mission.stuck_here >= often && mission.driven_m - mission.stuck_m < nearby_m)
    return {mission.beam_ends, beam_m};
  return {mission.slam.map().occupancy(), mission.pose.position, nearby_m};
}

/// Returns the current driving target, or nothing.
Twist2 drive(ExploreMission& mission) {
  const Nearby nearby = surroundings(mission);
  if (mission.path) advance_along(*mission.path, mission.pose.position);
  if (mission.stage == ExploreStage::back_off) {
    const bool goes_back = mission.path && remaining_m(*mission.path) >= arrived_m && !stands_still(mission);
    if (goes_back) return steer_back(mission, nearby);
    mission.stage = ExploreStage::seek;
    mission.path.reset();
  } else if (mission.touching || (mission.path && stands_still(mission))) {
    back_off(mission);
    return {};
  }
  if (mission.wants_settling) return {};
  if (time_to_decide(mission, nearby)) decide_anew(mission);
  if (!mission.path) return {};
  return steer(*mission.path, mission.pose, mission.twist, nearby, mission.task.robot, mission.task.steer);
}

/// Keeps what the frontiers have to be told.
void learn(ExploreMission& mission, MapUpdate update) {
  if (mission.looked) update = {true, {}};  // two scans at once: all is compared
  mission.changed = std::move(update);
  mission.looked = true;
}

/// Tells the frontiers. A map of which much has changed is thought over with the next scan.
void update_frontiers(ExploreMission& mission) {
  const bool first = mission.decisions == 0;
  const bool much = mission.frontiers.update(mission.slam.map().occupancy(), mission.changed);
  if (!much || first) return;
  prepare(mission.frontiers, mission.task.explore);
  mission.looked = false;
}

void settle(ExploreMission& mission) {
  mission.slam.settle();
  mission.wants_settling = false;
  mission.settled_m = mission.driven_m;
  learn(mission, {true, {}});
}

void take_scan(ExploreMission& mission, const LaserScan& scan) {
  if (mission.wants_settling) settle(mission);
  auto step =
      mission.slam.advance(wrap_heading(relative_pose(mission.odometry_of_slam, mission.odometry)), scan);
  if (!step) return end(mission, "lost", step.error().sentence);
  mission.odometry_of_slam = mission.odometry;
  mission.pose = step->pose;
  ++mission.scans;
  if (!usable(scan)) {
    ++mission.bad_scans;
  } else {
    mission.scan_s = mission.time_s;
    mission.range_m = scan.most_m;
    mission.beam_ends = ends_of(scan, compose(mission.pose, mission.task.slam.robot_T_laser));
  }
  learn(mission, std::move(step->update));
  if (step->closed_loop) {
    ++mission.loops;
    mission.path.reset();
    moved_on(mission);
    add_event(mission, "loop", "a place was recognised, and the map was redrawn");
  }
  const Eigen::Matrix3d p = mission.slam.pose_covariance();
  const double sigma_m = std::sqrt(std::max(p(0, 0), p(1, 1)));
  if (sigma_m > mission.task.rules.lost_m) {
    end(mission, "lost",
        fmt::format("it is lost: its position has a standard deviation of {:.2f} m", sigma_m));
  }
}

}  // namespace

ExploreMission::ExploreMission(LaserSlam mapping, ExploreTask given)
    : task(std::move(given)),
      slam(std::move(mapping)),
      frontiers(task.explore.frontier, task.robot.radius_m),
      pose(task.start) {
  blacklist.ban_s = task.explore.ban_s;
}

Outcome<ExploreMission> begin(const ExploreTask& task) {
  if (auto known = find_explore_strategy(task.explore.strategy); !known) return pass_on(known);
  if (auto known = find_path_planner(task.explore.planner); !known) return pass_on(known);
  auto slam = LaserSlam::begin(task.slam, task.start);
  if (!slam) return pass_on(slam);
  return ExploreMission(std::move(*slam), task);
}

void perceive(ExploreMission& mission, const Observation& seen) {
  if (mission.stage == ExploreStage::over) return;
  const Pose2 now = finite(seen.odometry) ? seen.odometry : mission.odometry;
  if (!mission.started_s) {
    mission.started_s = mission.scan_s = mission.time_s = mission.moved_on_s = seen.time_s;
    mission.odometry = mission.odometry_of_slam = now;
  }
  const double passed_s = seen.time_s - mission.time_s;
  const Pose2 motion = wrap_heading(relative_pose(mission.odometry, now));
  if (passed_s > 0.0) mission.twist = twist_between({}, motion, passed_s);
  mission.time_s = seen.time_s;
  mission.driven_m += norm(motion.position);
  mission.odometry = now;
  mission.pose = compose(mission.slam.pose(), wrap_heading(relative_pose(mission.odometry_of_slam, now)));
  mission.touching = seen.touching;
  if (seen.scan) take_scan(mission, *seen.scan);
}

std::optional<Command> respond(ExploreMission& mission) {
  if (mission.stage == ExploreStage::over) return std::nullopt;
  const double until_s = mission.time_s + mission.task.rules.period_s;
  const double blind_s = mission.time_s - mission.scan_s;
  if (blind_s > mission.task.rules.blind_s || mission.scans == mission.bad_scans) {
    if (blind_s <= 10.0 * mission.task.rules.blind_s) return DriveTwist{{}, until_s};
    end(mission, "blind", fmt::format("no scan that could be used came for {:.1f} s", blind_s));
    return std::nullopt;
  }
  if (mission.looked) update_frontiers(mission);
  const Twist2 twist = drive(mission);
  mission.looked = false;
  if (mission.stage == ExploreStage::over) {
    mission.slam.settle();
    mission.pose =
        compose(mission.slam.pose(), wrap_heading(relative_pose(mission.odometry_of_slam, mission.odometry)));
    return std::nullopt;
  }
  return DriveTwist{twist, until_s};
}

std::optional<Command> ExploreMission::step(const Observation& seen) {
  perceive(*this, seen);
  return respond(*this);
}

}  // namespace outrider
