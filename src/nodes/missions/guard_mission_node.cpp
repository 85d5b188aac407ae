#include "outrider/nodes/missions/guard_mission_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "missions/limits.hpp"
#include "outrider/ballistics/stance.hpp"
#include "outrider/core/overload.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/log/append.hpp"
#include "outrider/nodes/missions/in_the_way.hpp"
#include "outrider/sim/simulated_gun.hpp"

namespace outrider {
namespace {

constexpr double settles_s = 0.5;  // at the end of a drive, before the robot counts as standing
constexpr double longest_aim_s = 30.0;
constexpr double noted_every_s = 0.1;  // pose and joints

Pace pace_of(const RobotModel& robot) {
  Pace pace;
  pace.speed_mps = robot.speed_mps;
  pace.acceleration_mps2 = robot.acceleration_mps2;
  pace.turn_rate_radps = robot.turn_rate_radps;
  pace.turn_acceleration_radps2 = robot.turn_acceleration_radps2;
  pace.pause_s = 0.0;
  return pace;
}

}  // namespace

std::vector<OptionGroup> describe(GuardMissionNodeOptions& options) {
  return {
      {"",
       "the robot",
       {{"clearance", "m", 0.0, 10.0, "beside its radius, that plans keep from solids", &options.clearance_m},
        {"result", "s", 0.0, 60.0, "after the planned landing, for which a hit is awaited",
         &options.result_s},
        {"aimed", "deg", 0.001, 10.0, "of both joints, where the gun is aimed", &options.aimed_rad}}}};
}

Outcome<std::unique_ptr<PreparedGuard>> GuardMissionNode::prepare(GuardScenario scenario,
                                                                  const GuardMissionNodeOptions& options) {
  scenario.options.shoot_on_the_move = false;
  scenario.problem.robot.radius_m += options.clearance_m;
  return prepare_guard(std::move(scenario), {}, {Capability::topics});
}

GuardMissionNode::GuardMissionNode(GuardMissionNodeOptions options, std::unique_ptr<PreparedGuard> guard)
    : MissionNode("guard", options.node),
      options_(std::move(options)),
      guard_(std::move(guard)),
      mission_(&guard_->mission.value()),
      gun_(guard_->scenario.problem.targets),
      solids_(footprints_above_floor(guard_->scenario.problem.world), RangeFinderModel()),
      driver_(pace_of(guard_->scenario.problem.robot), true) {
  listen_to_pose();
  listen_to_scan();
  listen<sensor_msgs::JointState>("joint_states", Delivery::sensor,
                                  [this](const auto& joints) { return gun_.take(joints, now_s()); });
  listen<std_msgs::String>("gun/hit", Delivery::reliable, [this](const auto& hit) { return gun_.take(hit); });
  aim_output_ = add_output<sensor_msgs::JointState>("gun/command", Delivery::reliable);
  fire_output_ = add_output<std_msgs::Float64>("gun/fire", Delivery::reliable);
  set_status(NodeLevel::info, "waiting", "no odometry has come yet");
}

std::string GuardMissionNode::why_to_stop() const {
  if (std::string why = why_pose_is_missing(); !why.empty()) return why;
  if (std::string why = why_missing("joint state of the gun", gun_.came_s(), options().patience_s);
      !why.empty())
    return why;
  return why_scan_is_missing();
}

void GuardMissionNode::start(const Pose2& pose) {
  const Vec2 begin = guard_->scenario.problem.start.position;
  if (auto ok = check_start(begin, pose.position, "change the start"); !ok) return end(ok.error());
  begin_log();
  log_prepared(log(), *guard_);
  run_log_ = std::make_unique<TargetLog>(log(), queue_, guard_->scenario.problem.targets);
}

/// Asks the mission for the next command.
void GuardMissionNode::step(const Pose2& pose) {
  Observation seen;
  seen.time_s = mission_s();
  seen.odometry = pose;
  seen.gun = gun_.joints();
  seen.shots = std::exchange(results_, {});
  auto command = mission_->step(seen);
  run_log_->note(*mission_, mission_s());
  if (!command) {
    finish();
    return;
  }
  began_command_s_ = moved_on_s_ = now_s();
  begin_command(*command, pose);
  present_ = std::move(command);
}

void GuardMissionNode::begin_command(const Command& command, const Pose2& pose) {
  const double time_s = mission_s();
  const auto& targets = guard_->scenario.problem.targets;
  if (const auto* drive = std::get_if<FollowWaypoints>(&command)) {
    leg_ = 0;
    rest_s_.reset();
    log_plan(log(), time_s, drive->waypoints);
    if (drive->waypoints.size() > 1) begin_leg(*drive);
  }
  const auto* fire = std::get_if<Fire>(&command);
  if (fire == nullptr || gun_.was_hit(fire->target)) return;
  gun_.fire_at(fire->target);
  ++shots_;
  send(fire_output_, std_msgs::Float64{fire->shot.speed_mps});
  log_event(log(), time_s, "shot",
            fmt::format("shoots at {} from ({:.2f}, {:.2f})", targets[fire->target].name, pose.position.x,
                        pose.position.y));
}

void GuardMissionNode::begin_leg(const FollowWaypoints& drive) {
  FollowPiece leg;
  leg.piece.from = drive.waypoints[leg_];
  leg.piece.to = drive.waypoints[++leg_];
  driver_.begin(leg, now_s());
}

/// Returns true once the robot stands at the end of the drive.
bool GuardMissionNode::follow(const FollowWaypoints& drive, const Pose2& pose) {
  auto twist = driver_.twist(now_s(), pose);
  while (!twist && leg_ + 1 < drive.waypoints.size()) {
    begin_leg(drive);
    twist = driver_.twist(now_s(), pose);
  }
  if (twist) {
    if (may_drive(*twist, pose)) command(*twist);
    return false;
  }
  command({});
  const double since_s = rest_s_.value_or(now_s());
  rest_s_ = since_s;
  return now_s() - since_s >= settles_s;
}

/// Returns true if nothing is in the way; else the robot stands. Ends the mission of a robot that is stuck.
bool GuardMissionNode::may_drive(const Twist2& twist, const Pose2& pose) {
  if (const auto points = new_scan_on_map()) {
    unmapped_.clear();
    std::ranges::copy_if(*points, std::back_inserter(unmapped_), [&](Vec2 point) {
      return solids_.surface_distance(point, 2.0 * on_map_m) > on_map_m;
    });
  }
  const RobotModel& robot = guard_->scenario.problem.robot;
  const StopRule rule = stop_rule(robot.radius_m - options_.clearance_m, robot.acceleration_mps2);
  if (has_to_stand(in_the_way(unmapped_, pose, twist, rule), pose.position)) {
    driver_.stopped();
    moved_on_s_ = now_s();
    stands_ = true;
    return false;
  }
  if (distance(pose.position, stood_) > moved_on_m || !driver_.drives()) {
    stood_ = pose.position;
    if (driver_.drives()) moved_on_s_ = now_s();
  }
  return !ends_stuck(moved_on_s_);
}

/// Returns true once the gun is aimed.
bool GuardMissionNode::aim(const AimGun& aim, const Pose2& pose) {
  command({});
  const Stance stance = stance_at(guard_->plan->firing_map.rules, pose.position);
  const GunState goal =
      SimulatedGun::joints_towards({aim.yaw_rad, aim.pitch_rad, 0.0}, stance, pose.heading_rad);
  send(aim_output_, joints_message(goal, now_s()));
  const double yaw_off_rad = std::abs(wrap_angle(joints().yaw_rad - goal.yaw_rad));
  const double pitch_off_rad = std::abs(joints().pitch_rad - goal.pitch_rad);
  if (std::max(yaw_off_rad, pitch_off_rad) <= options_.aimed_rad) return true;
  if (now_s() - moved_on_s_ > longest_aim_s) {
    end(NodeLevel::error, "gun_stuck",
        fmt::format(
            "for {:g} s the gun has not come to where it is aimed: its yaw is {:.1f} degrees off, its "
            "pitch {:.1f}",
            longest_aim_s, degrees(yaw_off_rad), degrees(pitch_off_rad)));
  }
  return false;
}

/// Returns true once it is told that the target was hit, or it is too late for that.
bool GuardMissionNode::await(const Fire& fire) {
  command({});
  if (gun_.was_hit(fire.target)) {
    results_.push_back({fire.target, true, mission_s()});
    log_event(log(), mission_s(), "hit",
              fmt::format("{} is told to be hit", guard_->scenario.problem.targets[fire.target].name));
    return true;
  }
  const auto& shot = mission_->board().records()[fire.target].shot;
  const double flight_s = shot ? shot->flight_s : 0.0;
  return now_s() - began_command_s_ > flight_s + options_.result_s;
}

/// Returns true once the present command is done.
bool GuardMissionNode::carry_out(const Command& command, const Pose2& pose) {
  return std::visit(Overload{[&](const FollowWaypoints& drive) { return follow(drive, pose); },
                             [&](const AimGun& gun) { return aim(gun, pose); },
                             [&](const Fire& fire) { return await(fire); },
                             [&](const Wait& wait) {
                               this->command({});
                               return mission_s() + soon_s >= wait.until_s;
                             },
                             [&](const auto&) { return true; }},
                    command);
}

/// Logs where the robot and its gun are.
void GuardMissionNode::note(const Pose2& pose) {
  if (mission_s() < noted_s_ + noted_every_s - soon_s) return;
  noted_s_ = mission_s();
  log_pose(log(), noted_s_, pose);
  log_gun(log(), noted_s_, joints().yaw_rad, joints().pitch_rad);
}

void GuardMissionNode::finish() {
  const TaskBoard& board = mission_->board();
  const GuardVerdict verdict = verdict_of(*mission_);
  const auto hit = std::ranges::count(board.records(), TargetStatus::reached, &TargetRecord::status);
  std::string sentence =
      fmt::format("{} of {} targets are told to be hit, by {} shots", hit, board.records().size(), shots_);
  if (!verdict.reason.empty()) sentence += "; " + verdict.reason;
  if (!board.given_up().empty()) sentence += "; " + board.given_up();
  const bool good = verdict.status == "done";
  end(good ? NodeLevel::info : NodeLevel::error, verdict.status, std::move(sentence));
}

void GuardMissionNode::go_on(const Pose2& pose) {
  note(pose);
  if (!present_) step(pose);
  if (is_over() || !present_) return;
  stands_ = false;
  const bool done = carry_out(*present_, pose);
  if (is_over()) return;
  if (done) present_.reset();
  const auto& records = mission_->board().records();
  const auto left = std::ranges::count(records, TargetStatus::waiting, &TargetRecord::status);
  if (!stands_)
    set_status(NodeLevel::info, "guarding", fmt::format("{} of {} targets wait", left, records.size()));
}

void GuardMissionNode::act() {
  if (is_over()) {
    command({});
    return;
  }
  const std::string why = why_to_stop();
  if (!why.empty()) {
    driver_.stopped();
    moved_on_s_ = now_s();
    set_status(run_log_ ? NodeLevel::error : NodeLevel::info, run_log_ ? "stopped" : "waiting", why);
    command({});
    return;
  }
  const Pose2 pose = *frames().map_T_robot();
  if (!run_log_) start(pose);
  if (!is_over()) go_on(pose);
}

}  // namespace outrider
