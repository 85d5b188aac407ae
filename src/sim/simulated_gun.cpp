#include "outrider/sim/simulated_gun.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/ballistics/contact.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/sim/profile.hpp"

namespace outrider {
namespace {

/// The reference report's own idea of a hit: the ball's centre comes within 0.5 m of the target's base.
bool hits_by_reference_rule(const Flight& flight, const Target& target, double until_s) {
  constexpr double near_m = 0.5;
  const Solid base{target.name, {target.base, {}}, SphereShape{0.0}};
  return contact_time(flight, near_m, base, 0.0, until_s).has_value();
}

}  // namespace

outrider_msgs::Shot shot_message(const Flight& flight, const Impact& impact, const FlightSpace& space,
                                 const Target& target, double ball_radius_m, std::string contact) {
  outrider_msgs::Shot shot;
  shot.flight = impact.time_s;
  shot.muzzle = point_of(flight.muzzle);
  shot.velocity = vector_of(flight.velocity_mps);
  shot.contact = std::move(contact);
  shot.contact_point = point_of(impact.position);
  shot.hit = impact.hit;
  shot.hit_by_reference_rule = hits_by_reference_rule(flight, target, impact.time_s);
  shot.clearance = impact.hit ? space.clearance(flight, ball_radius_m, impact.time_s, 1.0).distance_m : 0.0;
  shot.profile = profile_of(flight, impact, space, target);
  shot.path = path_of(flight, impact);
  return shot;
}

std::string contact_of(const Impact& impact, const FlightSpace& space, const Target& target) {
  if (impact.hit) return target.name;
  return impact.solid ? space.solids()[*impact.solid].name : "nothing";
}

outrider_msgs::Shot message_of(const FiredShot& shot, const Impact& impact, const FlightSpace& space,
                               const Target& target, double ball_radius_m, std::string contact) {
  outrider_msgs::Shot message =
      shot_message(shot.flight, impact, space, target, ball_radius_m, std::move(contact));
  message.target = target.name;
  message.attempt = static_cast<std::uint32_t>(shot.attempt);
  set_pose(message, shot.robot, shot.barrel.yaw_rad, shot.barrel.pitch_rad);
  message.platform_velocity = point_of(shot.platform_mps);
  return message;
}

void set_pose(outrider_msgs::Shot& shot, const Pose2& robot, double gun_yaw_rad, double gun_pitch_rad) {
  shot.robot = point_of(robot.position);
  shot.robot_heading = robot.heading_rad;
  shot.gun_yaw = gun_yaw_rad;
  shot.gun_pitch = gun_pitch_rad;
}

SimulatedGun::SimulatedGun(const GunScene& scene, const ExecutionErrors& errors, const Rng& gun,
                           const Rng& timing, const GunFaults& faults)
    : scene_(scene),
      errors_(errors),
      gun_rng_(gun),
      timing_rng_(timing),
      faults_(faults),
      balls_(faults.balls),
      attempts_(scene.targets.size(), 0) {}

SimulatedGun::Turn SimulatedGun::turn_towards(double yaw_rad, double pitch_rad, const Stance& stance,
                                              double heading_rad) const {
  const GunModel& gun = scene_.rules.gun;
  const GunAngles to = angles_of(stance, {yaw_rad, pitch_rad, 0.0});
  Turn turn{state_};
  turn.yaw_rad = wrap_angle(to.yaw_rad - heading_on(stance, heading_rad) - state_.yaw_rad);
  turn.pitch_rad = to.pitch_rad - state_.pitch_rad;
  turn.yaw_s = std::abs(turn.yaw_rad) / gun.yaw_rate_radps;
  turn.pitch_s = std::abs(turn.pitch_rad) / gun.pitch_rate_radps;
  turn.total_s = aim_time(gun, turn.yaw_rad, turn.pitch_rad);
  return turn;
}

GunState SimulatedGun::joints_towards(const Shot& barrel, const Stance& stance, double heading_rad) {
  const GunAngles angles = angles_of(stance, barrel);
  return {wrap_angle(angles.yaw_rad - heading_on(stance, heading_rad)), angles.pitch_rad};
}

void SimulatedGun::be_on(const Turn& turn, double after_s) {
  const auto part = [after_s](double total_s) {
    return total_s > 0.0 ? std::min(1.0, after_s / total_s) : 1.0;
  };
  state_.yaw_rad = wrap_angle(turn.from.yaw_rad + turn.yaw_rad * part(turn.yaw_s));
  state_.pitch_rad = turn.from.pitch_rad + turn.pitch_rad * part(turn.pitch_s);
}

void SimulatedGun::be_between(GunState from, GunState to, double after_s) {
  const double yaw = scene_.rules.gun.yaw_rate_radps * after_s;
  const double pitch = scene_.rules.gun.pitch_rate_radps * after_s;
  state_ = {wrap_angle(from.yaw_rad + std::clamp(wrap_angle(to.yaw_rad - from.yaw_rad), -yaw, yaw)),
            from.pitch_rad + std::clamp(to.pitch_rad - from.pitch_rad, -pitch, pitch)};
}

Shot SimulatedGun::barrel(const Stance& stance, double heading_rad) const {
  const double yaw = wrap_angle(heading_on(stance, heading_rad) + state_.yaw_rad);
  return shot_of(stance, {yaw, state_.pitch_rad}, 0.0);
}

double SimulatedGun::draw_delay_s() { return errors_.timing_s * timing_rng_.uniform(-1.0, 1.0); }

bool SimulatedGun::pull_trigger(double time_s) {
  if (balls_ == 0 || faults_.jammed(time_s)) return false;
  --balls_;
  return true;
}

SimulatedGun::Thrown SimulatedGun::throw_ball(const Shot& shot, std::size_t target, std::size_t stand_in,
                                              const Platform& platform, const Walk* walk, double fired_s) {
  const ShotRules& rules = scene_.rules;
  Target box = scene_.targets[stand_in];
  box.name = scene_.targets[target].name;
  const Shot actual = draw_shot(shot, stance_at(rules, platform.position));
  const Flight flight = launch(rules, platform, box, actual);
  const FlightSpace& space = scene_.space(stand_in);
  const double radius = rules.gun.ball_radius_m;
  Impact impact = walk != nullptr ? fly_at(flight, radius, space, box, *walk, fired_s, rules.floor_z_m)
                                  : fly(flight, radius, space, box, rules.floor_z_m);
  std::string stopped_by;
  if (auto stop = stops_ ? stops_(flight, fired_s, impact.time_s) : std::nullopt) {
    impact = {false, stop->time_s, flight.position(stop->time_s), {}};
    stopped_by = std::move(stop->body);
  }
  if (walk != nullptr) box = moved_to(box, walk->at(fired_s + impact.time_s));
  return {flight, impact, actual.speed_mps, std::move(box), std::move(stopped_by)};
}

}  // namespace outrider
