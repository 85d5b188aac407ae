#include "outrider/jobs/drive/mission/mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mission/keep_clear.hpp"
#include "mission/look.hpp"
#include "mission/look_round.hpp"
#include "outrider/core/units.hpp"
#include "outrider/world/collision_map.hpp"
#include "room.hpp"

namespace outrider {
namespace {

constexpr double instant_s = 1e-9;       ///< times closer than this are one
constexpr double clearly_noisier = 1.7;  ///< ratio of the estimated to the expected variance of corners
constexpr double out_of_sight_s = 1.0;   ///< a robot that stands still because of tags waits so long for them

/// `rests_until_s`: the robot is known not to move before.
DriveWheels command(DriveMission& mission, const Twist2& twist, double until_s, double rests_until_s = 0.0) {
  mission.reckoning.sent.push_back({std::max(mission.reckoning.time_s, rests_until_s), twist});
  if (mission.task.eye.latency_s > 0.0) mission.history.commands.push_back(mission.reckoning.sent.back());
  return {commanded_wheels(mission.task.chassis, mission.task.calibration, twist), until_s};
}

/// The last command: to rest, for as long as the robot takes to come to rest.
DriveWheels finish(DriveMission& mission, DriveEnd end, std::string reason) {
  mission.end = end;
  mission.reason = std::move(reason);
  return command(mission, {}, mission.reckoning.time_s + mission.task.rules.rest_s);
}

void arrive(DriveMission& mission, std::size_t waypoint, double time_s, std::string doubt) {
  mission.arrivals.push_back({waypoint, time_s, mission.reckoning.belief, std::move(doubt)});
  mission.since_s = time_s;
  mission.stop.reset();
  mission.votes = {};
  mission.wide = false;
}

/// Returns the pose of the robot when a command that is sent now takes effect. For time_optimal, the pose to
/// which it would roll out from there: with a lag of the first order its derivative is the command itself.
Pose2 foreseen(const DriveMission& mission) {
  const DriveTask& task = mission.task;
  Reckoning ahead = mission.reckoning;
  advance(ahead, ahead.time_s + task.reckoning.delay_s, task.reckoning, task.chassis);
  const Pose2& pose = ahead.belief.world_T_robot;
  if (task.follow.follower != "time_optimal") return pose;
  return moved(pose, executed(task.chassis, ahead.errors.mean, ahead.twist), task.reckoning.lag_s);
}

/// Returns the rules. If corners are noisier than expected, errors of tags seen from the front are larger
/// than their covariances say: then more images are needed, as many as give a mean of the same error, within
/// bounds, and a sharper belief.
DriveRules rules_for_noise(const DriveMission& mission) {
  constexpr double most = 8.0, sharper = 1.5;
  const double ratio = mission.corner_variance_px2 / std::pow(mission.task.localise.corner_sigma_px, 2);
  DriveRules rules = mission.task.rules;
  if (ratio <= clearly_noisier) return rules;
  const double images = static_cast<double>(rules.settle_sightings) * std::min(ratio, most);
  rules.settle_sightings = static_cast<std::int64_t>(std::ceil(images));
  rules.settle_sigma_m /= sharper;
  rules.settle_sigma_rad /= sharper;
  return rules;
}

/// Returns why the stop at which the robot stands is not confirmed; empty if it is.
std::string stop_doubt(const DriveMission& mission) {
  if (mission.start_contradicted && is_trusted(mission))
    return "the first tags in sight contradicted the start; are their places and their size right?";
  if (is_corroborated(mission)) {
    std::string doubt = mission.stop->doubt(mission.reckoning.belief, rules_for_noise(mission));
    if (!doubt.empty() && !mission.suspects.empty())
      doubt += fmt::format("; tag {} contradicted other tags and does not count",
                           fmt::join(mission.suspects, ", "));
    return doubt;
  }
  if (const TagSupport* const lone = lone_support(mission)) {
    return fmt::format("only tag {} tells where it is since {:.1f} s, and it may have been moved",
                       *lone->tags.begin(), lone->time_s);
  }
  const auto needed = indispensable_tags(mission);
  if (!needed) return "no tags in view are enough to tell that it stands there";
  return fmt::format("only tag {} tells that it stands there, and it may have been moved", *needed->begin());
}

/// Decides about the stop at which the robot stands. Returns true if it goes on. `accepted`: the newest image
/// was accepted in this step, so nobody has moved the robot since.
bool leaves_stop(DriveMission& mission, double now_s, bool accepted) {
  const DriveRules& rules = mission.task.rules;
  const StopCheck& stop = *mission.stop;
  const bool settled = now_s - stop.counts_from_s >= rules.settle_s - instant_s;
  if (settled && accepted && stop.doubt(mission.reckoning.belief, rules_for_noise(mission)).empty() &&
      begin_look_round(mission, now_s))
    return false;
  std::string doubt = stop_doubt(mission);
  const double enough_s =
      rules.settle_s +
      2.0 * static_cast<double>(rules_for_noise(mission).settle_sightings) / mission.task.eye.rate_hz;
  const bool late = now_s - stop.since_s >= std::max(rules.most_settle_s, enough_s) - instant_s;
  if (doubt.empty() && !(settled && accepted)) {
    if (!late) return false;
    doubt = "images contradicted the belief until the end";
  }
  if (!doubt.empty() && !late) return false;
  arrive(mission, mission.follower.next, now_s, std::move(doubt));
  return true;
}

/// Returns the likely causes of tags that are where they cannot be, by what the images of the run show.
std::string likely_causes(const DriveMission& mission) {
  if (2 * mission.relocaliser.contradictory > mission.refused)
    return "the tags contradict one another or the floor: are their places, tag_size and the camera right?";
  if (mission.used == 0)
    return "no image ever agreed with the start: are the start, the places of the tags and tag_size right?";
  return fmt::format("{} images before agreed: was the robot moved, or a tag?", mission.used);
}

/// Returns why the robot is lost; empty if it is not.
std::string lost_reason(const DriveMission& mission, double now_s) {
  const PoseBelief& belief = mission.reckoning.belief;
  const bool in_sight = mission.refused > 0 && now_s - mission.refused_s <= out_of_sight_s;
  if (mission.refused >= mission.task.rules.most_refused) {
    return fmt::format(
        "lost: {} images in a row show tags where they cannot be, and they do not agree on where it is; {}",
        mission.refused, likely_causes(mission));
  }
  if (mission.refused >= mission.task.rules.hold_refused && !in_sight) {
    return fmt::format(
        "lost: {} images in a row show tags where they cannot be, and none is in sight any more; {}",
        mission.refused, likely_causes(mission));
  }
  if (in_sight || !is_lost(belief, mission.task.reckoning)) return {};
  return fmt::format(
      "lost: the belief has a standard deviation of {:.2f} m and {:.0f} degrees; no tag was of "
      "use for {:.1f} s",
      position_sigma_m(belief), degrees(heading_sigma_rad(belief)), mission.reckoning.time_s - mission.tag_s);
}

/// Returns true if an obstacle stands between the robot and the next waypoint.
bool is_blocked(const DriveMission& mission) {
  const DriveTask& task = mission.task;
  const Segment leg{mission.reckoning.belief.world_T_robot.position,
                    task.waypoints[mission.follower.next].pose.position};
  return !mission.ground->segment_free(leg, task.radius_m);
}

/// Ends the mission once the robot has stood at the last stop.
DriveWheels finish_at_last_stop(DriveMission& mission) {
  std::vector<std::string> doubts;
  for (const DriveArrival& arrival : mission.arrivals) {
    if (!arrival.doubt.empty())
      doubts.push_back(fmt::format("waypoint {}: {}", arrival.waypoint + 1, arrival.doubt));
  }
  if (doubts.empty()) {
    std::string doubt = tag_doubt(mission);
    const DriveEnd end = doubt.empty() ? DriveEnd::done : DriveEnd::doubtful;
    return finish(mission, end, std::move(doubt));
  }
  return finish(mission, DriveEnd::unconfirmed,
                fmt::format("{} of {} stops unconfirmed; {}", doubts.size(), mission.arrivals.size(),
                            fmt::join(doubts, "; ")));
}

/// Makes up for the errors of the motion that are known. The other followers leave them to their feedback.
Twist2 made_up(const DriveMission& mission, const Twist2& wanted) {
  const DriveTask& task = mission.task;
  if (task.follow.follower != "time_optimal") return wanted;
  return commanded_for(task.chassis, mission.reckoning.errors.mean, wanted);
}

DriveWheels step_closed(DriveMission& mission, const Observation& seen) {
  const double now_s = seen.time_s;
  const DriveRules& rules = mission.task.rules;
  const bool accepted = look(mission, seen);
  advance(mission.reckoning, now_s, mission.task.reckoning, mission.task.chassis);
  if (mission.task.eye.latency_s > 0.0)
    mission.history.add(mission.reckoning, mission.task.eye.latency_s + rules.period_s);
  if (relocalise(mission) && is_blocked(mission)) {
    return finish(
        mission, DriveEnd::lost,
        fmt::format("lost: by the tags in sight the robot was moved, and the straight way to waypoint "
                    "{} touches an obstacle",
                    mission.follower.next + 1));
  }
  if (auto reason = lost_reason(mission, now_s); !reason.empty()) {
    return finish(mission, DriveEnd::lost, std::move(reason));
  }
  if (now_s - mission.since_s > rules.patience_s) {
    return finish(mission, DriveEnd::stuck,
                  fmt::format("waypoint {} was not reached within {:g} s", mission.follower.next + 1,
                              rules.patience_s));
  }
  if (mission.refused >= rules.hold_refused) {
    mission.follower.last = {};
    return command(mission, {}, now_s + rules.period_s);
  }
  if (mission.look_round) {
    const Twist2 twist = step_look_round(mission, *mission.look_round, foreseen(mission), now_s);
    return command(mission, made_up(mission, twist), now_s + rules.period_s);
  }
  const Pose2 believed = foreseen(mission);
  const FollowStep wanted = follow(mission.follower, mission.task.waypoints, believed, mission.task.follow,
                                   mission.task.pid, mission.task.chassis, rules.period_s);
  if (!wanted.there) {
    mission.stop.reset();
  } else if (!mission.stop) {
    mission.stop = StopCheck::at(now_s);
  } else if (leaves_stop(mission, now_s, accepted)) {
    if (mission.follower.next + 1 == mission.task.waypoints.size()) return finish_at_last_stop(mission);
    advance_to_next(mission.follower, mission.task.waypoints);
  }
  const Twist2 twist = made_up(mission, wanted.twist);
  if (!must_stop(mission, believed, twist)) return command(mission, twist, now_s + rules.period_s);
  if (auto reason = why_off_its_way(mission); !reason.empty())
    return finish(mission, DriveEnd::stuck, std::move(reason));
  mission.follower.last = {};
  return command(mission, {}, now_s + rules.period_s);
}

double dead_time_s(const Twist2& twist, const Calibration& calibration) {
  return twist.turn_radps != 0.0 ? turn_law(calibration, twist.turn_radps).dead_time_s
                                 : ahead_law(calibration, twist.ahead_mps).dead_time_s;
}

DriveWheels step_open(DriveMission& mission, const Observation& seen) {
  const double now_s = seen.time_s;
  advance(mission.reckoning, now_s, mission.task.reckoning, mission.task.chassis);
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
    if (motion.at_waypoint) arrive(mission, mission.arrivals.size(), ends_s, {});
  }
  return finish(mission, DriveEnd::done, {});
}

}  // namespace

DriveMission begin(DriveTask given) {
  DriveMission mission;
  mission.task = std::move(given);
  mission.ground =
      std::make_shared<const CollisionMap>(CollisionMap::of(mission.task.world, mission.task.eye.height_m));
  set_rooms(mission.task, *mission.ground);
  const DriveTask& task = mission.task;
  constexpr double start_sigma_m = 0.01, start_sigma_rad = 0.01;
  mission.reckoning.belief.world_T_robot = task.start;
  for (Eigen::Index i = 0; i < 2; ++i)
    mission.reckoning.belief.covariance(i, i) = start_sigma_m * start_sigma_m;
  mission.reckoning.belief.covariance(2, 2) = start_sigma_rad * start_sigma_rad;
  mission.reckoning.errors =
      unknown_errors(task.chassis, task.reckoning.wheel_sigma, task.reckoning.slip_sigma);
  mission.corner_variance_px2 = std::pow(task.localise.corner_sigma_px, 2);
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
