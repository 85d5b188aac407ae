#include "outrider/jobs/guard/physics_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/overload.hpp"
#include "outrider/core/units.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/sim/simulated_gun.hpp"

namespace outrider {
namespace {

constexpr double tick_s = 0.25e-3;  // a step of a flight: a ball at 10 m/s moves 2.5 mm
constexpr std::int64_t ticks_per_roll = 4;
constexpr double roll_s = ticks_per_roll * tick_s;
constexpr std::int64_t ticks_per_sample = 400;
constexpr double let_down_s = 0.5;

// A leg or a turn is over when its time is, and the robot is this near to its end.
constexpr double arrived_m = 5e-4;
constexpr double there_rad = 1e-3;
constexpr double patience_s = 1.0;  // or this much later

double covered_rate(double distance, const Limits& limits, double time_s) {
  return (covered(distance, limits, time_s + roll_s) - covered(distance, limits, time_s)) / roll_s;
}

}  // namespace

PhysicsGuard::PhysicsGuard(const GuardProblem& problem, const FiringMap& firing_map, RigidWorld& bodies,
                           Log& log, std::uint64_t seed)
    : problem_(problem),
      firing_map_(firing_map),
      bodies_(bodies),
      log_(log),
      arrival_rng_(Rng(seed).child("arrival")),
      gun_rng_(Rng(seed).child("gun")),
      attempts_(problem.targets.size(), 0) {
  record.rigid.emplace();
  record.rigid->misses.resize(problem.targets.size());
  for (double t = 0.0; t < let_down_s; t += roll_s) bodies_.step(roll_s);
  sample();
}

Observation PhysicsGuard::sense() {
  Observation seen{now_s(), pose()};
  seen.gun = {gun_yaw_rad_, gun_pitch_rad_};
  seen.shots = std::exchange(landed_, {});
  return seen;
}

void PhysicsGuard::act(const Command& command) {
  std::visit(Overload{[this](const FollowWaypoints& c) { follow(c); }, [this](const AimGun& c) { aim(c); },
                      [this](const Fire& c) { fire(c); },
                      [](const auto&) {}},  // no problem that asks for more passes check_physics()
             command);
}

double PhysicsGuard::now_s() const { return tick_s * static_cast<double>(ticks_); }

Pose2 PhysicsGuard::pose() const {
  const Pose3 world_T_robot = bodies_.world_T_robot();
  return {xy(world_T_robot.position), heading_of(xy(world_T_robot.rotation.axes[0]))};
}

void PhysicsGuard::sample() {
  const Pose2 here = pose();
  log_pose(log_, now_s(), here);
  log_gun(log_, now_s(), gun_yaw_rad_, gun_pitch_rad_);
}

void PhysicsGuard::tell(std::string kind, std::string sentence) {
  log_event(log_, now_s(), std::move(kind), std::move(sentence));
}

std::string PhysicsGuard::name_of(std::size_t body) const {
  const std::vector<Solid>& solids = problem_.world.solids;
  return body < solids.size() ? solids[body].name : problem_.targets[body - solids.size()].name;
}

// ---- Driving -------------------------------------------------------------------------------------

void PhysicsGuard::roll() {
  const Pose2 before = pose();
  bodies_.step(roll_s);
  const std::int64_t samples = ticks_ / ticks_per_sample;
  ticks_ += ticks_per_roll;
  const Pose2 after = pose();
  record.driven_m += distance(before.position, after.position);
  record.turned_rad += std::abs(wrap_angle(after.heading_rad - before.heading_rad));
  if (ticks_ / ticks_per_sample > samples) sample();
  for (const std::size_t body : bodies_.touched_by_robot()) {
    if (std::ranges::find(bumped_, body) != bumped_.end()) continue;
    bumped_.push_back(body);
    ++record.rigid->bumps;
    tell("bump",
         fmt::format("touches {} at ({:.2f}, {:.2f})", name_of(body), after.position.x, after.position.y));
  }
}

void PhysicsGuard::stand(double duration_s) {
  bodies_.turn_wheels({});
  const auto rolls = static_cast<std::int64_t>(std::ceil(duration_s / roll_s - 1e-9));
  for (std::int64_t i = 0; i < rolls; ++i) roll();
}

/// Follows a reference that comes to rest at `duration_s`, then waits for the robot to catch up.
template <class ReferenceAt>
void PhysicsGuard::track(double duration_s, const ReferenceAt& at) {
  const Reference end = at(duration_s);
  for (double t = 0.0; t < duration_s + patience_s; t += roll_s) {
    const Pose2 here = pose();
    const double ahead_m = dot(direction(end.pose.heading_rad), end.pose.position - here.position);
    const double turn_rad = wrap_angle(end.pose.heading_rad - here.heading_rad);
    if (t >= duration_s && std::abs(ahead_m) < arrived_m && std::abs(turn_rad) < there_rad) break;
    bodies_.turn_wheels(outrider::follow(at(std::min(t, duration_s)), here, problem_.robot));
    roll();
  }
  bodies_.turn_wheels({});
}

void PhysicsGuard::turn_to(double heading_rad) {
  const Pose2 from = pose();
  const double turn = wrap_angle(heading_rad - from.heading_rad);
  const Limits limits = problem_.robot.turning();
  track(duration(std::abs(turn), limits), [&](double t) {
    const double done = std::copysign(covered(std::abs(turn), limits, t), turn);
    const double rate = std::copysign(covered_rate(std::abs(turn), limits, t), turn);
    return Reference{{from.position, from.heading_rad + done}, 0.0, rate};
  });
}

void PhysicsGuard::drive_to(Vec2 goal) {
  if (distance(pose().position, goal) < arrived_m) return;
  turn_to(heading_of(goal - pose().position));
  const Vec2 from = pose().position;
  const double length = distance(from, goal);
  const Vec2 along = (1.0 / length) * (goal - from);
  const Limits limits = problem_.robot.straight();
  track(duration(length, limits), [&](double t) {
    return Reference{
        {from + covered(length, limits, t) * along, heading_of(along)}, covered_rate(length, limits, t), 0.0};
  });
}

void PhysicsGuard::follow(const FollowWaypoints& command) {
  std::vector<Vec2> waypoints = command.waypoints;
  if (waypoints.size() < 2) return;
  waypoints.back() = displaced_goal(waypoints, problem_.robot.radius_m, firing_map_.ground, firing_map_.rules,
                                    random_in_disk(arrival_rng_, problem_.errors.position_m));
  log_plan(log_, now_s(), waypoints);
  const Vec2 goal = waypoints.back();
  tell("drive", fmt::format("drives to ({:.2f}, {:.2f})", goal.x, goal.y));
  bumped_.clear();
  for (std::size_t i = 1; i < waypoints.size(); ++i) drive_to(waypoints[i]);
  record.rigid->arrival_errors_m.push_back(distance(pose().position, goal));
  log_plan(log_, now_s(), {});
  sample();
}

// ---- Shooting ------------------------------------------------------------------------------------

void PhysicsGuard::aim(const AimGun& command) {
  const double yaw_from = gun_yaw_rad_;
  const double pitch_from = gun_pitch_rad_;
  const double yaw_turn = wrap_angle(command.yaw_rad - pose().heading_rad - yaw_from);
  const double pitch_turn = command.pitch_rad - pitch_from;
  const double yaw_s = std::abs(yaw_turn) / problem_.gun.yaw_rate_radps;
  const double pitch_s = std::abs(pitch_turn) / problem_.gun.pitch_rate_radps;
  sample();
  const double begin = now_s();
  // Each axis moves at its own rate, so the path bends once, where the faster one arrives.
  for (const double until : {std::min(yaw_s, pitch_s), std::max(yaw_s, pitch_s)}) {
    stand(begin + until - now_s());
    gun_yaw_rad_ = wrap_angle(yaw_from + yaw_turn * (yaw_s > 0.0 ? std::min(1.0, until / yaw_s) : 1.0));
    gun_pitch_rad_ = pitch_from + pitch_turn * (pitch_s > 0.0 ? std::min(1.0, until / pitch_s) : 1.0);
    sample();
  }
}

/// The flight from the muzzle of the chassis as it stands.
Flight PhysicsGuard::launched(const Shot& shot) const {
  const Pose3 world_T_robot = bodies_.world_T_robot();
  const Shot from_body{wrap_angle(shot.yaw_rad - pose().heading_rad), shot.pitch_rad, shot.speed_mps};
  Flight flight = launch(problem_.gun, Vec2{}, 0.0, from_body, problem_.world.gravity_mps2);
  flight.muzzle = world_T_robot * flight.muzzle;
  flight.velocity_mps = world_T_robot.rotation * flight.velocity_mps;
  return flight;
}

/// Throws the ball and lets time pass until it touches something, or falls below the floor.
Impact PhysicsGuard::thrown(const Flight& flight, std::size_t target) {
  const std::size_t body = problem_.world.solids.size() + target;
  const double lowest = problem_.world.floor_z_m - 1.0;
  bodies_.throw_ball(flight, target);
  Impact impact;
  for (std::int64_t ticks = 0;; ++ticks) {
    impact.time_s = tick_s * static_cast<double>(ticks);
    impact.position = bodies_.ball();
    bodies_.step(tick_s);
    ++ticks_;
    const std::vector<std::size_t> touched = bodies_.touched_by_ball();
    const auto solid = std::ranges::find_if(touched, [&](std::size_t b) { return b != body; });
    if (solid != touched.end()) impact.solid = *solid;
    impact.hit = !touched.empty() && !impact.solid;
    if (!touched.empty() || impact.position.z < lowest) break;
  }
  bodies_.remove_ball();
  return impact;
}

std::string PhysicsGuard::contact_of(const Impact& impact, std::size_t target) const {
  if (impact.hit) return problem_.targets[target].name;
  return impact.solid ? name_of(*impact.solid) : "nothing";
}

void PhysicsGuard::fire(const Fire& command) {
  const Target& target = problem_.targets[command.target];
  const double radius = problem_.gun.ball_radius_m;
  const FlightSpace& space = firing_map_.space(command.target);
  const Shot actual = shot_with_errors(command.shot, problem_.errors.aim, gun_rng_);
  const Flight flight = launched(actual);
  tell("shot", fmt::format("shoots at {} with {:.2f} m/s", target.name, actual.speed_mps));

  const double fired_s = now_s();
  const Pose2 fired_from = pose();
  const Impact impact = thrown(flight, command.target);
  const Impact expected = fly(flight, radius, space, target, problem_.world.floor_z_m);
  outrider_msgs::Shot shot =
      shot_message(flight, impact, space, target, radius, contact_of(impact, command.target));
  shot.target = target.name;
  shot.attempt = static_cast<std::uint32_t>(++attempts_[command.target]);
  set_pose(shot, fired_from, wrap_angle(fired_from.heading_rad + gun_yaw_rad_), gun_pitch_rad_);
  ++record.shots;
  const bool same_contact = impact.hit == expected.hit &&
                            impact.solid.has_value() == expected.solid.has_value() &&
                            (!impact.solid || shot.contact == space.solids()[*expected.solid].name);
  if (same_contact) ++record.rigid->as_foreseen;
  const std::string contact = shot.contact;
  log_.append(topic::shots, fired_s, std::move(shot));
  if (impact.hit) {
    tell("hit", fmt::format("hits {}", target.name));
  } else {
    const Vec3 at = impact.position;
    record.rigid->misses[command.target] =
        fmt::format("touches {} at ({:.2f}, {:.2f}, {:.2f}), {:.3f} m from it", contact, at.x, at.y, at.z,
                    std::max(0.0, outrider::distance(at, solid_of(target)) - radius));
    tell("miss", fmt::format("misses {}: {}", target.name, record.rigid->misses[command.target]));
  }
  record.rigid->flight_error_m =
      std::max(record.rigid->flight_error_m, norm(impact.position - flight.position(impact.time_s)));
  landed_.push_back({command.target, impact.hit, now_s()});
  sample();
}

}  // namespace outrider
