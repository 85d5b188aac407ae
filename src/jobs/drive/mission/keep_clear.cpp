#include "mission/keep_clear.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/core/bisect.hpp"

namespace outrider {
namespace {

constexpr double follower_m = 0.03;   ///< of the margin of the legs that the follower may use up
constexpr double most_kept_m = 0.03;  ///< more is not kept
constexpr double most_held_s = 2.0;   ///< in all, on the way to one waypoint
constexpr int halvings = 10;
constexpr double change_m = 1e-4;  ///< a clearance that decreases by less stays

/// Returns how far the disk of the robot is kept from obstacles on the way to its next waypoint.
double kept_m(const DriveMission& mission) {
  const DriveTask& task = mission.task;
  const std::size_t next = mission.follower.next;
  std::vector<Vec2> way{mission.follower.from.position, task.waypoints[next].pose.position};
  if (next + 1 < task.waypoints.size()) way.push_back(task.waypoints[next + 1].pose.position);
  const double margin_m = largest_up_to(follower_m + most_kept_m, halvings, [&](double margin) {
    for (std::size_t i = 1; i < way.size(); ++i) {
      if (!mission.ground->segment_free({way[i - 1], way[i]}, task.radius_m + margin)) return false;
    }
    return true;
  });
  return std::max(0.0, margin_m - follower_m);
}

}  // namespace

bool must_stop(DriveMission& mission, const Pose2& believed, const Twist2& twist) {
  const DriveTask& task = mission.task;
  const CollisionMap& ground = *mission.ground;
  KeepClear& keeps = mission.keeps_clear;
  if (keeps.waypoint != mission.follower.next || !(keeps.from == mission.follower.from.position))
    keeps = {mission.follower.next, mission.follower.from.position, kept_m(mission), 0.0};
  const double rolls_s = task.rules.period_s + task.reckoning.lag_s;
  const Pose2 rest = moved(believed, executed(task.chassis, mission.reckoning.errors.mean, twist), rolls_s);
  const double wanted_m = task.radius_m + keeps.kept_m;
  const double clearance_m = ground.clearance(rest.position, wanted_m);
  if (clearance_m >= wanted_m) return false;
  const Vec2 here = mission.reckoning.belief.world_T_robot.position;
  if (clearance_m > ground.clearance(here, wanted_m) - change_m) return false;
  keeps.held_s += task.rules.period_s;
  return true;
}

std::string why_off_its_way(const DriveMission& mission) {
  const KeepClear& keeps = mission.keeps_clear;
  if (keeps.held_s < most_held_s) return {};
  const Vec2 here = mission.reckoning.belief.world_T_robot.position;
  const Segment leg{keeps.from, mission.task.waypoints[keeps.waypoint].pose.position};
  return fmt::format(
      "it does not move as it is commanded: it stopped {:.2f} m beside its way to waypoint {}, "
      "{:.3f} m from an obstacle",
      distance(here, leg), keeps.waypoint + 1,
      mission.ground->clearance(here, mission.task.radius_m + most_kept_m) - mission.task.radius_m);
}

}  // namespace outrider
