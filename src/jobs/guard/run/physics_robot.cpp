#include "outrider/jobs/guard/run/physics_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/overload.hpp"
#include "outrider/core/units.hpp"
#include "outrider/log/append.hpp"

namespace outrider {
namespace {

constexpr std::int64_t ticks_per_roll = 4;
constexpr double roll_s = 1e-3;
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
    : rigid_(record.rigid.emplace()),
      problem_(problem),
      firing_map_(firing_map),
      bodies_(bodies),
      log_(log),
      arrival_rng_(Rng(seed).child("arrival")),
      gun_rng_(Rng(seed).child("gun")),
      timing_rng_(Rng(seed).child("timing")),
      attempts_(problem.targets.size(), 0) {
  rigid_.misses.resize(problem.targets.size());
  for (double t = 0.0; t < let_down_s; t += roll_s) bodies_.step(roll_s);
  sample();
}

Observation PhysicsGuard::sense() {
  Observation seen{now_s(), pose()};
  seen.gun = gun_;
  seen.shots = std::exchange(landed_, {});
  return seen;
}

void PhysicsGuard::act(const Command& command) {
  std::visit(Overload{[this](const FollowWaypoints& c) { follow(c); }, [this](const AimGun& c) { aim(c); },
                      [this](const Fire& c) { fire(c); }, [this](const Wait& c) { wait(c); },
                      [](const auto&) {}},  // no problem that asks for more passes check_capabilities()
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
  log_gun(log_, now_s(), gun_.yaw_rad, gun_.pitch_rad);
}

void PhysicsGuard::tell(std::string kind, std::string sentence) {
  log_event(log_, now_s(), std::move(kind), std::move(sentence));
}

std::string PhysicsGuard::name_of(std::size_t body) const {
  const std::vector<Solid>& solids = problem_.world.solids;
  return body < solids.size() ? solids[body].name : problem_.targets[body - solids.size()].name;
}

// ---- Driving -------------------------------------------------------------------------------------

/// A short step, in which balls fly.
void PhysicsGuard::tick() {
  for (BallInAir& ball : balls_) ball.before = bodies_.ball(ball.number);
  bodies_.step(tick_s);
  ++ticks_;
  turn_gun(tick_s);
  land_balls();
}

void PhysicsGuard::roll() {
  const Pose2 before = pose();
  const std::int64_t samples = ticks_ / ticks_per_sample;
  if (balls_.empty()) {
    bodies_.step(roll_s);
    ticks_ += ticks_per_roll;
    turn_gun(roll_s);
  } else {
    for (int i = 0; i < ticks_per_roll; ++i) tick();
  }
  const Pose2 after = pose();
  record.driven_m += distance(before.position, after.position);
  record.turned_rad += std::abs(wrap_angle(after.heading_rad - before.heading_rad));
  if (ticks_ / ticks_per_sample > samples) sample();
  for (const std::size_t body : bodies_.touched_by_robot()) {
    if (std::ranges::find(bumped_, body) != bumped_.end()) continue;
    bumped_.push_back(body);
    ++rigid_.bumps;
    tell("bump",
         fmt::format("touches {} at ({:.2f}, {:.2f})", name_of(body), after.position.x, after.position.y));
  }
}

void PhysicsGuard::stand(double duration_s) {
  bodies_.turn_wheels({});
  const auto rolls = static_cast<std::int64_t>(std::ceil(duration_s / roll_s - 1e-9));
  for (std::int64_t i = 0; i < rolls; ++i) roll();
}

void PhysicsGuard::wait(const Wait& command) {
  if (!std::isfinite(command.until_s) || command.until_s <= now_s()) return;
  tell("wait", fmt::format("waits until {:.1f} s", command.until_s));
  sample();
  stand(command.until_s - now_s());
  sample();
}

/// Follows a reference that comes to rest at `duration_s`, then waits for the robot to catch up.
/// `during` receives the time since the beginning, up to the duration at least.
template <class ReferenceAt, class During>
void PhysicsGuard::track(double duration_s, const ReferenceAt& at, const During& during) {
  const Reference end = at(duration_s);
  for (double t = 0.0; t < duration_s + patience_s; t += roll_s) {
    during(t);
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
  const auto reference = [&](double t) {
    const double done = std::copysign(covered(std::abs(turn), limits, t), turn);
    const double rate = std::copysign(covered_rate(std::abs(turn), limits, t), turn);
    return Reference{{from.position, from.heading_rad + done}, 0.0, rate};
  };
  track(duration(std::abs(turn), limits), reference, [](double) {});
}

/// Drives the leg that ends at a waypoint, and shoots on the way.
void PhysicsGuard::drive_leg(const std::vector<Vec2>& waypoints, std::size_t leg,
                             const FollowWaypoints& command) {
  const Vec2 goal = waypoints[leg];
  if (distance(pose().position, goal) < arrived_m) return;
  turn_to(heading_of(goal - pose().position));
  const Vec2 from = pose().position;
  const double length = distance(from, goal);
  const Vec2 along = (1.0 / length) * (goal - from);
  const Limits limits = problem_.robot.straight();
  const double duration_s = duration(length, limits);
  auto [shot, last] = std::ranges::equal_range(command.shots, leg, {}, &FireInPassing::leg);
  double fires_s = 0.0;
  const auto set_time = [&] {
    if (shot == last) return;
    const double late_s = problem_.errors.timing_s * timing_rng_.uniform(-1.0, 1.0);
    fires_s = std::clamp(shot->after_s + late_s, fires_s, duration_s);
  };
  set_time();
  const auto reference = [&](double t) {
    return Reference{
        {from + covered(length, limits, t) * along, heading_of(along)}, covered_rate(length, limits, t), 0.0};
  };
  track(duration_s, reference, [&](double t) {
    while (shot != last && t >= fires_s) {
      fire_in_passing(*shot++);
      point_gun(waypoints, command, static_cast<std::size_t>(shot - command.shots.begin()));
      set_time();
    }
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
  point_gun(waypoints, command, 0);
  for (std::size_t leg = 1; leg < waypoints.size(); ++leg) drive_leg(waypoints, leg, command);
  gun_goal_ = gun_;
  rigid_.arrival_errors_m.push_back(distance(pose().position, goal));
  log_plan(log_, now_s(), {});
  sample();
}

}  // namespace outrider
