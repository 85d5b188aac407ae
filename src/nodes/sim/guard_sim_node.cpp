#include "outrider/nodes/sim/guard_sim_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/nodes/missions/remote_gun.hpp"

namespace outrider {
namespace {

constexpr int times_told = 3;
constexpr double told_every_s = 0.2;

SimulatedRobot robot_of(const GuardSimYard& yard, std::uint64_t seed) {
  const GuardProblem& problem = yard.problem;
  return SimulatedRobot(
      TwistBody(problem.world, problem.start, problem.robot, yard.wheels, Rng(seed).child("wheels")));
}

}  // namespace

Outcome<std::shared_ptr<const GuardSimYard>> GuardSimYard::make(const GuardScenario& scenario) {
  if (!scenario.terrain.empty())
    return bad_input("the robot behind topics drives on flat ground; leave it out", "terrain");
  auto map = build_firing_map(scenario.problem, scenario.options, {}, RegionSearch::none);
  if (!map) return pass_on(map);
  return std::make_shared<const GuardSimYard>(
      GuardSimYard{scenario.problem, std::move(*map), scenario.navigation.wheels, scenario.faults});
}

GuardSimNode::GuardSimNode(std::shared_ptr<const GuardSimYard> yard, const RobotSimOptions& options)
    : RobotSimNode(robot_of(*yard, options.seed), options),
      yard_(std::move(yard)),
      aims_(options.faults, Rng(options.seed).child("lost aims")),
      fires_(options.faults, Rng(options.seed).child("lost shots")),
      gun_(GunScene{yard_->firing_map.rules, yard_->firing_map.spaces, yard_->problem.targets},
           yard_->problem.errors, Rng(options.seed).child("gun"), Rng(options.seed).child("timing"),
           yard_->faults.gun),
      gun_rng_(Rng(options.seed).child("gun")),
      gone_(yard_->problem.targets.size(), false) {
  listen<sensor_msgs::JointState>("gun/command", Delivery::reliable,
                                  [this](const auto& joints) { return take_aim(joints); });
  listen<std_msgs::Float64>("gun/fire", Delivery::reliable,
                            [this](const auto& speed) { return take_fire(speed); });
  joint_output_ = add_output<sensor_msgs::JointState>("joint_states", Delivery::reliable);
  hit_output_ = add_output<std_msgs::String>("gun/hit", Delivery::reliable);
}

std::size_t GuardSimNode::hits() const { return static_cast<std::size_t>(std::ranges::count(gone_, true)); }

Status GuardSimNode::take_aim(const sensor_msgs::JointState& message) {
  const auto joints = joints_of(message);
  if (!joints) return pass_on(joints);
  const auto& to = *joints;
  if (!to) return bad_input("it does not name the joints 'yaw' and 'pitch'");
  const GunModel& gun = yard_->problem.gun;
  aims_.push(now_s(),
             {wrap_angle(to->yaw_rad), std::clamp(to->pitch_rad, gun.pitch_low_rad, gun.pitch_high_rad)});
  return {};
}

Status GuardSimNode::take_fire(const std_msgs::Float64& speed) {
  const double most_mps = yard_->problem.gun.muzzle_speed_mps;
  const bool can = speed.data > 0.0 && speed.data <= most_mps + 1e-9;
  if (!can) {
    return bad_input(fmt::format("the speed of the ball is {:g} m/s; the gun can shoot at up to {:g} m/s",
                                 speed.data, most_mps));
  }
  fires_.push(now_s(), speed.data);
  return {};
}

/// Throws a ball from where the robot is. Whom it touches first leaves.
void GuardSimNode::fire(double speed_mps) {
  if (!gun_.pull_trigger(robot().time_s())) {
    tell(NodeLevel::warning, "nothing leaves the barrel");
    return;
  }
  ++shots_;
  const GunScene& scene = gun_.scene();
  const Pose2& pose = robot().pose();
  const Stance stance = stance_at(scene.rules, pose.position);
  const Twist2& twist = robot().body<TwistBody>().twist();
  Shot meant = gun_.barrel(stance, pose.heading_rad);
  meant.speed_mps = speed_mps;
  const Shot actual =
      shot_with_errors(meant, true_errors(yard_->problem.errors, yard_->faults).aim, gun_rng_, stance);
  const Platform platform{pose.position, twist.ahead_mps * direction(pose.heading_rad)};
  std::optional<std::size_t> hit;
  double lands_s = 0.0;
  for (std::size_t i = 0; i < gone_.size(); ++i) {
    if (gone_[i]) continue;
    const Target& target = scene.targets[i];
    const Impact impact = fly(launch(scene.rules, platform, target, actual), scene.rules.gun.ball_radius_m,
                              scene.space(i), target, scene.rules.floor_z_m);
    if (!impact.hit || (hit && impact.time_s >= lands_s)) continue;
    hit = i;
    lands_s = impact.time_s;
  }
  if (!hit) return;
  gone_[*hit] = true;
  for (int i = 0; i < times_told; ++i)
    told_.push_back({robot().time_s() + lands_s + i * told_every_s, scene.targets[*hit].name});
  std::ranges::stable_sort(told_, {}, &Hit::time_s);
}

Command GuardSimNode::drive(const Twist2& twist, double until_s) {
  while (const auto aim = aims_.take(now_s())) {
    if (aim->yaw_rad == to_.yaw_rad && aim->pitch_rad == to_.pitch_rad) continue;
    from_ = gun_.state();
    to_ = *aim;
    began_aim_s_ = robot().time_s();
  }
  gun_.be_between(from_, to_, robot().time_s() - began_aim_s_);
  while (const auto speed_mps = fires_.take(now_s())) fire(*speed_mps);
  gun_.be_between(from_, to_, until_s - began_aim_s_);
  return DriveTwist{{twist.ahead_mps, 0.0, twist.turn_radps}, until_s};
}

GuardSimNode::Whereabouts GuardSimNode::whereabouts(const Observation& seen) {
  return {seen.odometry, robot().body<TwistBody>().twist(),
          wrap_heading(compose(robot().pose(), inverse(seen.odometry)))};
}

geometry_msgs::TransformStamped GuardSimNode::mount(double time_s) const {
  auto transform = transform_of(time_s, Pose2{}, base_frame, "gun");
  transform.transform.translation.z = yard_->problem.gun.pivot_height_m;
  return transform;
}

void GuardSimNode::send_measured(const Observation& seen, double time_s) {
  send_late(joint_output_, joints_message(gun_.state(), time_s));
  for (; !told_.empty() && told_.front().time_s <= seen.time_s; told_.pop_front())
    send_late(hit_output_, std_msgs::String{told_.front().name});
}

void GuardSimNode::report() {
  const std::int64_t contacts = robot().body<TwistBody>().contacts();
  if (contacts > contacts_) {
    contacts_ = contacts;
    tell(NodeLevel::warning, fmt::format("the robot touches something at {:.2f}, {:.2f}",
                                         robot().pose().position.x, robot().pose().position.y));
  }
  set_status_of_commands(contacts_ > 0 ? NodeLevel::error : NodeLevel::info,
                         fmt::format("{} contacts, {} of {} targets hit; ", contacts_, hits(), gone_.size()));
}

}  // namespace outrider
