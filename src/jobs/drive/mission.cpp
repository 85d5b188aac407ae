#include "outrider/jobs/drive/mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double instant_s = 1e-9;  ///< times closer than this are one

/// Returns true if the image shows a known tag at a place that contradicts the belief.
bool contradicts(const TagFix& fix) {
  return !fix.belief && std::ranges::any_of(fix.verdicts, [](TagVerdict verdict) {
    return verdict == TagVerdict::off_prior || verdict == TagVerdict::outvoted;
  });
}

void look(DriveMission& mission, const Observation& seen) {
  if (!seen.image) return;
  const auto& [taken_s, sightings] = *seen.image;
  const bool fresh = seen.time_s - taken_s <= 0.5 * mission.task.rules.period_s + instant_s;
  if (!fresh || taken_s <= mission.image_s) return;
  mission.image_s = taken_s;
  ++mission.images;
  if (sightings.empty()) return;
  advance(mission.reckoning, taken_s, mission.task.reckoning);
  PoseBelief& belief = mission.reckoning.belief;
  const TagFix fix =
      localise(sightings, mission.task.tags, robot_camera(mission.task.eye), belief, mission.task.localise);
  if (fix.belief) {
    belief = fuse(belief, *fix.belief);
    ++mission.used;
    mission.tag_s = taken_s;
    mission.refused = 0;
  } else if (contradicts(fix)) {
    ++mission.refused;
  }
}

/// `rests_until_s`: the robot is known not to move before.
DriveWheels command(DriveMission& mission, const Twist2& twist, double until_s, double rests_until_s = 0.0) {
  mission.reckoning.sent.push_back({std::max(mission.reckoning.time_s, rests_until_s), twist});
  return {commanded_wheels(mission.task.chassis, mission.task.calibration, twist), until_s};
}

/// The last command: to rest, for as long as the robot takes to come to rest.
DriveWheels finish(DriveMission& mission, DriveEnd end, std::string reason) {
  mission.end = end;
  mission.reason = std::move(reason);
  return command(mission, {}, mission.reckoning.time_s + mission.task.rules.rest_s);
}

void arrive(DriveMission& mission, std::size_t waypoint, double time_s) {
  mission.arrivals.push_back({waypoint, time_s, mission.reckoning.belief});
  mission.since_s = time_s;
}

/// Returns the pose of the robot when a command that is sent now takes effect.
Pose2 foreseen(const DriveMission& mission) {
  Reckoning ahead = mission.reckoning;
  advance(ahead, ahead.time_s + mission.task.reckoning.delay_s, mission.task.reckoning);
  return ahead.belief.world_T_robot;
}

/// Returns true if a robot that rests at a stop knows its pose well enough, or has waited long enough.
bool settled(const DriveMission& mission, double time_s, const DriveRules& rules) {
  const double rested_s = time_s - *mission.resting_since_s;
  const PoseBelief& belief = mission.reckoning.belief;
  const bool sharp =
      position_sigma_m(belief) <= rules.settle_sigma_m && heading_sigma_rad(belief) <= rules.settle_sigma_rad;
  return rested_s >= (sharp ? rules.settle_s : rules.most_settle_s) - instant_s;
}

std::string lost_reason(const DriveMission& mission) {
  const PoseBelief& belief = mission.reckoning.belief;
  if (mission.refused >= mission.task.rules.most_refused) {
    return fmt::format("lost: {} images in a row show tags where they cannot be; was the robot moved?",
                       mission.refused);
  }
  if (!is_lost(belief, mission.task.reckoning)) return {};
  return fmt::format(
      "lost: the belief has a standard deviation of {:.2f} m and {:.0f} degrees; no tag was of "
      "use for {:.1f} s",
      position_sigma_m(belief), degrees(heading_sigma_rad(belief)), mission.reckoning.time_s - mission.tag_s);
}

DriveWheels step_closed(DriveMission& mission, const Observation& seen) {
  const double now_s = seen.time_s;
  look(mission, seen);
  advance(mission.reckoning, now_s, mission.task.reckoning);
  if (auto reason = lost_reason(mission); !reason.empty()) {
    return finish(mission, DriveEnd::lost, std::move(reason));
  }
  if (now_s - mission.since_s > mission.task.rules.patience_s) {
    return finish(mission, DriveEnd::stuck,
                  fmt::format("waypoint {} was not reached within {:g} s", mission.follower.next + 1,
                              mission.task.rules.patience_s));
  }
  const FollowStep wanted = follow(mission.follower, mission.task.waypoints, foreseen(mission),
                                   mission.task.follow, mission.task.pid, mission.task.rules.period_s);
  if (!wanted.there) {
    mission.resting_since_s.reset();
  } else if (!mission.resting_since_s) {
    mission.resting_since_s = now_s;
  } else if (settled(mission, now_s, mission.task.rules)) {
    arrive(mission, mission.follower.next, now_s);
    if (mission.follower.next + 1 == mission.task.waypoints.size())
      return finish(mission, DriveEnd::done, {});
    mission.resting_since_s.reset();
    advance_to_next(mission.follower, mission.task.waypoints);
  }
  return command(mission, wanted.twist, now_s + mission.task.rules.period_s);
}

double dead_time_s(const Twist2& twist, const Calibration& calibration) {
  return twist.turn_radps != 0.0 ? turn_law(calibration, twist.turn_radps).dead_time_s
                                 : ahead_law(calibration, twist.ahead_mps).dead_time_s;
}

DriveWheels step_open(DriveMission& mission, const Observation& seen) {
  const double now_s = seen.time_s;
  advance(mission.reckoning, now_s, mission.task.reckoning);
  while (mission.motion < mission.motions.size()) {
    const TimedMotion& motion = mission.motions[mission.motion];
    const double moves_until_s = mission.since_s + motion.duration_s;
    const double ends_s = moves_until_s + motion.rest_s;
    if (now_s < ends_s - instant_s) {
      const bool moves = now_s < moves_until_s - instant_s;
      const double until_s = std::min(now_s + mission.task.rules.period_s, moves ? moves_until_s : ends_s);
      return command(mission, moves ? motion.twist : Twist2{}, until_s,
                     mission.since_s + dead_time_s(motion.twist, mission.task.calibration));
    }
    mission.since_s = ends_s;
    ++mission.motion;
    if (motion.at_waypoint) arrive(mission, mission.arrivals.size(), ends_s);
  }
  return finish(mission, DriveEnd::done, {});
}

}  // namespace

DriveMission begin(DriveTask given) {
  DriveMission mission;
  mission.task = std::move(given);
  const DriveTask& task = mission.task;
  constexpr double start_sigma_m = 0.01, start_sigma_rad = 0.01;
  mission.reckoning.belief.world_T_robot = task.start;
  for (Eigen::Index i = 0; i < 2; ++i)
    mission.reckoning.belief.covariance(i, i) = start_sigma_m * start_sigma_m;
  mission.reckoning.belief.covariance(2, 2) = start_sigma_rad * start_sigma_rad;
  mission.follower.from = task.start;
  if (!task.closed_loop) {
    std::vector<Pose2> poses;
    for (const Waypoint& waypoint : task.waypoints) poses.push_back(waypoint.pose);
    mission.motions = timed_drive(task.start, poses,
                                  {task.follow.speed_mps, task.follow.turn_rate_radps, task.rules.rest_s},
                                  task.calibration);
  }
  return mission;
}

std::optional<Command> DriveMission::step(const Observation& seen) {
  if (end != DriveEnd::none) return std::nullopt;
  if (!initial_stop_sent) {
    initial_stop_sent = true;
    since_s = seen.time_s + task.rules.period_s;
    return command(*this, {}, since_s);
  }
  return task.closed_loop ? step_closed(*this, seen) : step_open(*this, seen);
}

}  // namespace outrider
