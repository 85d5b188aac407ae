// The gun of a PhysicsGuard: it turns, throws balls, and notes what they touch.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/jobs/guard/run/physics_robot.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/sim/simulated_gun.hpp"

namespace outrider {
namespace {

constexpr double no_ball_s = 1.0;  // a robot that waits for a ball to land and sees none goes on after that

}  // namespace

// ---- Aiming --------------------------------------------------------------------------------------

/// Lets the gun turn to where it has to point next: for the shot after those done, or on arrival.
void PhysicsGuard::point_gun(const std::vector<Vec2>& waypoints, const FollowWaypoints& command,
                             std::size_t shots_done) {
  gun_goal_ = gun_;
  const bool shoots = shots_done < command.shots.size();
  if (!shoots && !command.aim) return;
  const std::size_t leg = shoots ? command.shots[shots_done].leg : waypoints.size() - 1;
  const Shot barrel =
      shoots ? command.shots[shots_done].shot : Shot{command.aim->yaw_rad, command.aim->pitch_rad, 0.0};
  gun_goal_ = SimulatedGun::joints_towards(barrel, {}, heading_of(waypoints[leg] - waypoints[leg - 1]));
}

/// Each joint turns at its own rate.
void PhysicsGuard::turn_gun(double duration_s) {
  const double yaw = problem_.gun.yaw_rate_radps * duration_s;
  const double pitch = problem_.gun.pitch_rate_radps * duration_s;
  const double yaw_left = wrap_angle(gun_goal_.yaw_rad - gun_.yaw_rad);
  gun_.yaw_rad =
      std::abs(yaw_left) <= yaw ? gun_goal_.yaw_rad : wrap_angle(gun_.yaw_rad + std::copysign(yaw, yaw_left));
  gun_.pitch_rad += std::clamp(gun_goal_.pitch_rad - gun_.pitch_rad, -pitch, pitch);
}

void PhysicsGuard::aim(const AimGun& command) {
  gun_goal_ = SimulatedGun::joints_towards({command.yaw_rad, command.pitch_rad, 0.0}, {}, pose().heading_rad);
  const double yaw_s = std::abs(wrap_angle(gun_goal_.yaw_rad - gun_.yaw_rad)) / problem_.gun.yaw_rate_radps;
  const double pitch_s = std::abs(gun_goal_.pitch_rad - gun_.pitch_rad) / problem_.gun.pitch_rate_radps;
  sample();
  const double begin = now_s();
  // The path bends once, where the faster joint arrives.
  for (const double until : {std::min(yaw_s, pitch_s), std::max(yaw_s, pitch_s)}) {
    stand(begin + until - now_s());
    sample();
  }
}

// ---- Throwing ------------------------------------------------------------------------------------

/// The velocity that the muzzle has because the robot moves.
Vec3 PhysicsGuard::muzzle_velocity() const { return bodies_.velocity_at(launched({}, {}).muzzle); }

/// The flight from the muzzle of the chassis as it stands, with the barrel as a shot has it in the world.
Flight PhysicsGuard::launched(const Shot& shot, Vec3 platform_mps) const {
  const Pose3 world_T_robot = bodies_.world_T_robot();
  const Shot from_body{wrap_angle(shot.yaw_rad - pose().heading_rad), shot.pitch_rad, shot.speed_mps};
  Flight flight = launch(problem_.gun, Vec2{}, 0.0, from_body, problem_.world.gravity_mps2);
  flight.muzzle = world_T_robot * flight.muzzle;
  flight.velocity_mps = world_T_robot.rotation * flight.velocity_mps + platform_mps;
  return flight;
}

/// Returns the number of the ball; nothing if the engine holds no more.
std::optional<std::size_t> PhysicsGuard::throw_ball(std::size_t target, const Shot& meant,
                                                    Vec3 platform_mps) {
  const Shot actual = shot_with_errors(meant, problem_.errors.aim, gun_rng_);
  const Flight flight = launched(actual, platform_mps);
  const std::string& name = problem_.targets[target].name;
  const auto number = bodies_.throw_ball(flight, target);
  if (!number) {
    tell("no_shot", fmt::format("does not shoot at {}: {} balls are in the air", name, balls_.size()));
    return {};
  }
  const double speed = norm(xy(platform_mps));
  tell("shot", fmt::format("shoots at {} with {:.2f} m/s{}", name, actual.speed_mps,
                           speed > 0.0 ? fmt::format(", driving at {:.2f} m/s", speed) : ""));
  balls_.push_back(
      {*number, target, ++attempts_[target], flight, ticks_, pose(), gun_, xy(platform_mps), flight.muzzle});
  ++record.shots;
  return number;
}

void PhysicsGuard::fire(const Fire& command) {
  const auto number = throw_ball(command.target, command.shot, {});
  if (!command.until_landed) return;
  if (!number) stand(no_ball_s);
  while (number && std::ranges::find(balls_, *number, &BallInAir::number) != balls_.end()) tick();
  sample();
}

/// Fires along the barrel as it is.
void PhysicsGuard::fire_in_passing(const FireInPassing& shot) {
  sample();
  const double yaw = wrap_angle(pose().heading_rad + gun_.yaw_rad);
  throw_ball(shot.target, {yaw, gun_.pitch_rad, shot.shot.speed_mps}, muzzle_velocity());
}

// ---- Landing -------------------------------------------------------------------------------------

/// Returns what a ball touched at the beginning of the last step; nothing if it flies on.
std::optional<Impact> PhysicsGuard::impact_of(const BallInAir& ball) const {
  const std::size_t body = problem_.world.solids.size() + ball.target;
  const std::vector<std::size_t> touched = bodies_.touched_by_ball(ball.number);
  if (touched.empty() && ball.before.z >= problem_.world.floor_z_m - 1.0) return {};
  Impact impact{false, tick_s * static_cast<double>(ticks_ - 1 - ball.fired_at), ball.before, {}};
  const auto solid = std::ranges::find_if(touched, [&](std::size_t b) { return b != body; });
  if (solid != touched.end()) impact.solid = *solid;
  impact.hit = !touched.empty() && !impact.solid;
  return impact;
}

void PhysicsGuard::land_balls() {
  for (BallInAir& ball : std::exchange(balls_, {})) {
    const auto impact = impact_of(ball);
    if (!impact) {
      balls_.push_back(std::move(ball));
      continue;
    }
    bodies_.remove_ball(ball.number);
    note_impact(ball, *impact);
  }
  const std::int64_t oldest = balls_.empty() ? ticks_ : balls_.front().fired_at - 1;
  landed_shots_.flush(log_, tick_s * static_cast<double>(oldest));
}

std::string PhysicsGuard::contact_of(const Impact& impact, std::size_t target) const {
  if (impact.hit) return problem_.targets[target].name;
  return impact.solid ? name_of(*impact.solid) : "nothing";
}

void PhysicsGuard::note_impact(const BallInAir& ball, const Impact& impact) {
  const Target& target = problem_.targets[ball.target];
  const double radius = problem_.gun.ball_radius_m;
  const FlightSpace& space = firing_map_.space(ball.target);
  const Impact expected = fly(ball.flight, radius, space, target, problem_.world.floor_z_m);
  const std::string contact = contact_of(impact, ball.target);
  outrider_msgs::Shot shot = shot_message(ball.flight, impact, space, target, radius, contact);
  shot.target = target.name;
  shot.attempt = static_cast<std::uint32_t>(ball.attempt);
  set_pose(shot, ball.robot, wrap_angle(ball.robot.heading_rad + ball.gun.yaw_rad), ball.gun.pitch_rad);
  shot.platform_velocity = point_of(ball.platform_mps);
  landed_shots_.note(tick_s * static_cast<double>(ball.fired_at), topic::shots, std::move(shot));
  const bool same_contact = impact.hit == expected.hit &&
                            impact.solid.has_value() == expected.solid.has_value() &&
                            (!impact.solid || contact == space.solids()[*expected.solid].name);
  if (same_contact) ++rigid_.as_foreseen;
  const Vec3 at = impact.position;
  if (impact.hit) {
    tell("hit", fmt::format("hits {}", target.name));
  } else {
    rigid_.misses[ball.target] =
        fmt::format("touches {} at ({:.2f}, {:.2f}, {:.2f}), {:.3f} m from it", contact, at.x, at.y, at.z,
                    std::max(0.0, outrider::distance(at, solid_of(target)) - radius));
    tell("miss", fmt::format("misses {}: {}", target.name, rigid_.misses[ball.target]));
  }
  rigid_.flight_error_m = std::max(rigid_.flight_error_m, norm(at - ball.flight.position(impact.time_s)));
  landed_.push_back({ball.target, impact.hit, now_s()});
}

}  // namespace outrider
