#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mission_parts.hpp"

namespace outrider {
namespace {

constexpr double moved_m = 0.04, turned_rad = 0.3;
constexpr double elsewhere_m = 20.0;  ///< driven between two times stuck that have nothing in common

/// Returns true if the next part of the path is blocked.
bool blocked(const ExploreMission& mission, const Nearby& nearby) {
  const double gap_m = mission.room ? 0.0 : mission.task.steer.least_gap_m;
  const double wanted =
      std::min(mission.task.robot.radius_m + gap_m, nearby.clearance(mission.pose.position) - 1e-3);
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
  if (!mission.path || sees_nothing_new(mission)) return true;
  if (mission.time_s - mission.decided_s >= mission.task.rules.think_again_s) return true;
  if (mission.stage == ExploreStage::seek &&
      !mission.frontiers.frontiers().contains(mission.decision.choice.frontier))
    return true;
  return remaining_m(*mission.path) < arrived_m || blocked(mission, nearby);
}

/// Returns the way back along which it came, `length_m` long.
std::vector<Vec2> way_back(const ExploreMission& mission, double length_m) {
  std::vector<Vec2> way = {mission.pose.position};
  const std::vector<Pose2> came = mission.slam.trajectory();
  double length = 0.0;
  for (auto pose = came.rbegin(); pose != came.rend() && length < length_m; ++pose) {
    const double leg = distance(way.back(), pose->position);
    if (leg < 0.02) continue;
    length += leg;
    way.push_back(pose->position);
  }
  return way;
}

/// Returns the straight way of that length at whose end there is most room, among those that come no nearer
/// to anything; no way, if there is none.
std::vector<Vec2> freest_way(const ExploreMission& mission, const Nearby& nearby, double length_m) {
  constexpr int directions = 32;
  constexpr double error_m = 1e-3;
  const Vec2 here = mission.pose.position;
  const double least_m = nearby.clearance(here) - error_m;
  std::vector<Vec2> way;
  double most_m = 0.0;
  for (int i = 0; i < directions; ++i) {
    const double turn_rad = 2.0 * pi * i / directions;
    const Vec2 there = here + length_m * direction(mission.pose.heading_rad + turn_rad);
    const double room_m = nearby.clearance(there);
    if (room_m <= most_m || nearby.clearance(Segment{here, there}) < least_m) continue;
    most_m = room_m;
    way = {here, there};
  }
  return way;
}

/// Goes back along the way it came, and leaves the goal out for a while. If it has just tried that here, goes
/// to where there is most room.
void back_off(ExploreMission& mission, const Nearby& nearby) {
  if (mission.driven_m - mission.stuck_m > elsewhere_m) mission.stuck_here = 0;
  mission.stuck_m = mission.driven_m;
  ++mission.stuck;
  if (!(mission.touching && std::exchange(mission.new_touch, false))) ++mission.stuck_here;
  add_event(mission, mission.touching ? "touch" : "stuck",
            fmt::format("at ({:.2f}, {:.2f}): {}; it goes back a little", mission.pose.position.x,
                        mission.pose.position.y,
                        mission.touching ? "something was touched" : "it does not move on"));
  if (mission.stuck_here > mission.task.rules.most_stuck)
    return end(mission, "stuck", fmt::format("it got stuck {} times in a row", mission.stuck_here));
  // A touch has blocked the ground; there may be another way.
  if (mission.room)
    note_too_narrow(mission, false);
  else if (mission.stage == ExploreStage::seek && mission.path && !mission.touching)
    mission.blacklist.add(mission.decision.choice.place, mission.time_s);
  std::vector<Vec2> way;
  if (mission.stuck_here % 2 == 0 && mission.stuck_here > 0)
    way = freest_way(mission, nearby, mission.task.rules.back_off_m);
  mission.backwards = way.empty();
  if (mission.backwards) way = way_back(mission, mission.task.rules.back_off_m);
  mission.stage = ExploreStage::back_off;
  follow(mission, std::move(way));
  moved_on(mission);
}

/// Returns the twist at half the speed.
Twist2 steer_slowly(const ExploreMission& mission, const PathProgress& path, const Pose2& pose,
                    const Twist2& now, const Nearby& nearby) {
  RobotModel slow = mission.task.robot;
  slow.speed_mps *= 0.5;
  return steer(path, pose, now, nearby, slow, mission.task.steer);
}

/// Returns the twist for a robot that drives backwards.
Twist2 steer_back(const ExploreMission& mission, const PathProgress& path, const Nearby& nearby) {
  const Pose2 turned{mission.pose.position, mission.pose.heading_rad + pi};
  const Twist2 now{-mission.twist.ahead_mps, 0.0, mission.twist.turn_radps};
  const Twist2 back = steer_slowly(mission, path, turned, now, nearby);
  return {-back.ahead_mps, 0.0, back.turn_radps};
}

/// Notes progress; returns true if there was none for so long that the robot has to go back.
bool stands_still(ExploreMission& mission) {
  const bool moved = distance(mission.pose.position, mission.stood.position) > moved_m ||
                     std::abs(wrap_angle(mission.pose.heading_rad - mission.stood.heading_rad)) > turned_rad;
  if (moved) moved_on(mission);
  return mission.time_s - mission.moved_on_s > mission.task.rules.patience_s;
}

/// Ends the mission if the robot has got no nearer to home for long, as behind a door that was closed. It may
/// move all that time, to and fro.
void end_if_no_nearer_to_home(ExploreMission& mission) {
  constexpr double nearer_m = 0.1, home_patience_s = 120.0;
  if (mission.stage != ExploreStage::go_home || !mission.path) return;
  const double left_m = remaining_m(*mission.path);
  double& least_m = mission.home_left_m[mission.on_trail ? 1 : 0];
  if (left_m < least_m - nearer_m) {
    least_m = left_m;
    mission.nearer_home_s = mission.time_s;
  } else if (mission.time_s - mission.nearer_home_s > home_patience_s) {
    end(mission, "stuck",
        fmt::format("it gets no nearer to home since {:.0f} s: is the way closed?", mission.nearer_home_s));
  }
}

/// Returns the obstacles around the robot: by the map; by the last scans in a narrow place; by the newest
/// scan if the map encloses the robot. Touched obstacles are added too, except beside the trail that leads
/// home.
Nearby surroundings(const ExploreMission& mission) {
  constexpr std::int64_t often = 3;
  constexpr double beam_m = 0.01;
  Nearby nearby;
  if (mission.room)
    nearby = mission.surfaces;
  else if (mission.stuck_here >= often && mission.driven_m - mission.stuck_m < nearby_m)
    nearby = {mission.beam_ends, beam_m};
  else
    nearby = {mission.slam.map().occupancy(), mission.pose.position, nearby_m};
  if (!mission.on_trail) nearby.add(mission.touched);
  return nearby;
}

/// Returns true if the next part of the path leads over ground on which the map leaves no room.
bool leads_through_narrow(const ExploreMission& mission) {
  constexpr double ahead_m = 0.8, step_m = 0.02;
  const TraversabilityGrid& ground = mission.frontiers.ground();
  const auto narrow = [&](Vec2 point) {
    const Cell cell = ground.frame().cell_at(point);
    return ground.frame().contains(cell) &&
           ground.crowded(static_cast<std::uint32_t>(ground.frame().index(cell)));
  };
  if (narrow(mission.pose.position)) return true;
  const PathProgress& path = *mission.path;
  const double to_m = path.along_m + ahead_m;
  double before = 0.0;
  for (std::size_t i = 1; i < path.points.size() && before < to_m; ++i) {
    const double leg = distance(path.points[i - 1], path.points[i]);
    for (double at = std::max(0.0, path.along_m - before); at < leg && before + at < to_m; at += step_m) {
      if (narrow(path.points[i - 1] + (at / leg) * (path.points[i] - path.points[i - 1]))) return true;
    }
    before += leg;
  }
  return false;
}

/// Judges the narrowest place ahead, mission.room, by the looks at it. That is done before the robot is in
/// the gap: next to the rim, the noise of a corner narrows it. Until it is sure, the robot stands before the
/// gap.
void judge_gap(ExploreMission& mission, PathRoom& room) {
  constexpr double beside_m = 0.05;       // of the rim
  constexpr double early_error_m = 0.01;  // farther off it is seen less well
  constexpr int sure = 6;
  const double radius_m = mission.task.robot.radius_m;
  const double rim_m = distance(room.narrowest, mission.pose.position) - radius_m;
  const bool is_before = rim_m < 2.0 * beside_m;
  if (rim_m >= beside_m || mission.looks.count < sure) mission.looks.add(room);
  if (mission.looks.count < sure) {
    mission.fits = mission.fits && !is_before;
    return;
  }
  const double wanted_m = radius_m + mission.task.explore.gap_margin_m - (is_before ? 0.0 : early_error_m);
  if (mission.looks.room_m >= wanted_m) return;
  room.least_m = mission.looks.room_m;
  note_too_narrow(mission, true);
}

/// Looks at narrow places ahead from near, once a scan: centres the path between the surfaces there, and
/// notes where they leave too little room.
void look_close(ExploreMission& mission) {
  constexpr double ahead_m = 0.6, roomy_m = 0.06, point_m = 0.0005;
  constexpr double largest_error_m = 0.02;
  if (mission.centred_scan == mission.scans) return;
  mission.centred_scan = mission.scans;
  mission.room.reset();
  mission.fits = true;
  if (!mission.path || !leads_through_narrow(mission)) {
    mission.looks = {};
    return;
  }
  mission.surfaces = {mission.close_range.surfaces(mission.odometry, mission.pose), point_m};
  const double radius_m = mission.task.robot.radius_m;
  if (mission.stage == ExploreStage::back_off) {
    mission.room = PathRoom{mission.surfaces.clearance(mission.pose.position), mission.pose.position};
    return;
  }
  PathRoom& room = mission.room.emplace(
      centre_path(*mission.path, mission.pose.position, mission.surfaces, ahead_m, radius_m + roomy_m));
  mission.fits = room.least_m >= radius_m - largest_error_m;
  if (mission.stage == ExploreStage::seek && std::isfinite(room.least_m)) judge_gap(mission, room);
}

/// Returns the way of driving and the speed for the room that there is.
std::pair<RobotModel, SteerOptions> way_of_driving(const ExploreMission& mission) {
  std::pair<RobotModel, SteerOptions> driving{mission.task.robot, mission.task.steer};
  if (!mission.room) return driving;
  auto& [robot, steering] = driving;
  constexpr double careful_m = 0.03, lookahead_m = 0.2;
  const double play_m = std::max(0.0, mission.room->least_m - robot.radius_m);
  if (play_m < careful_m) robot.speed_mps *= 0.5;
  steering.least_gap_m = std::min(steering.least_gap_m, 0.7 * play_m);
  steering.lookahead_m = std::min(steering.lookahead_m, lookahead_m);
  return driving;
}

}  // namespace

Twist2 drive(ExploreMission& mission) {
  if (mission.path) advance_along(*mission.path, mission.pose.position);
  end_if_no_nearer_to_home(mission);
  if (mission.stage == ExploreStage::over) return {};
  look_close(mission);
  Nearby nearby = surroundings(mission);
  if (mission.stage == ExploreStage::back_off) {
    if (mission.path && remaining_m(*mission.path) >= arrived_m && !stands_still(mission)) {
      const PathProgress& path = *mission.path;
      return mission.backwards ? steer_back(mission, path, nearby)
                               : steer_slowly(mission, path, mission.pose, mission.twist, nearby);
    }
    mission.stage = ExploreStage::seek;
    mission.path.reset();
  } else if (mission.touching || (mission.path && stands_still(mission))) {
    back_off(mission, nearby);
    return {};
  }
  if (mission.wants_settling) return {};
  if (time_to_decide(mission, nearby)) {
    decide_anew(mission);
    look_close(mission);
    nearby = surroundings(mission);
  }
  if (!mission.path || !mission.fits) return {};
  const auto [robot, steering] = way_of_driving(mission);
  return steer(*mission.path, mission.pose, mission.twist, nearby, robot, steering);
}

}  // namespace outrider
