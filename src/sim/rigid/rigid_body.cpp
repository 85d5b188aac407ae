#include "outrider/sim/rigid/rigid_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/motion/profile.hpp"

namespace outrider {
namespace {

constexpr std::int64_t ticks_per_roll = 4;
constexpr double roll_s = 1e-3;
constexpr int rolls_per_sample = 100;
constexpr double let_down_s = 0.5;

// A leg or a turn is over when its time is, and the robot is this near to its end.
constexpr double arrived_m = 5e-4;
constexpr double there_rad = 1e-3;
constexpr double patience_s = 1.0;  // or this much later
constexpr double instant = 1e-9;

double covered_rate(double distance, const Limits& limits, double time_s) {
  return (covered(distance, limits, time_s + roll_s) - covered(distance, limits, time_s)) / roll_s;
}

Reference reference_on(const StraightDrive& drive, const Limits& limits, double after_s) {
  const Vec2 along = (1.0 / drive.length_m) * (drive.goal - drive.from);
  return {{drive.from + covered(drive.length_m, limits, after_s) * along, heading_of(along)},
          covered_rate(drive.length_m, limits, after_s),
          0.0};
}

}  // namespace

RigidBody::RigidBody(std::unique_ptr<RigidWorld> world, RigidScene scene, const BodyGround& on,
                     const ExecutionErrors& errors, const Rng& rng)
    : world_(std::move(world)), scene_(std::move(scene)), on_(on), errors_(errors), rng_(rng) {
  record_.misses.resize(scene_.targets.size());
  for (double t = 0.0; t < let_down_s; t += roll_s) world_->step(roll_s);
  look();
}

const std::string& RigidBody::name_of(std::size_t body) const {
  const std::vector<Solid>& solids = scene_.world.solids;
  return body < solids.size() ? solids[body].name : scene_.targets[body - solids.size()].name;
}

// ---- Steps of the engine -------------------------------------------------------------------------

void RigidBody::look() {
  const Pose3 world_T_robot = world_->world_T_robot();
  pose_ = {xy(world_T_robot.position), heading_of(xy(world_T_robot.rotation.axes[0]))};
}

/// A short step, in which balls fly.
void RigidBody::tick() {
  for (BallInAir& ball : balls_) ball.before = world_->ball(ball.number);
  world_->step(tick_s);
  ++ticks_;
  look();
  land_balls();
}

void RigidBody::roll() {
  const Pose2 before = pose_;
  if (balls_.empty()) {
    world_->step(roll_s);
    ticks_ += ticks_per_roll;
    look();
  } else {
    for (int i = 0; i < ticks_per_roll; ++i) tick();
  }
  driven_m_ += distance(before.position, pose_.position);
  turned_rad_ += std::abs(wrap_angle(pose_.heading_rad - before.heading_rad));
  for (const std::size_t body : world_->touched_by_robot()) {
    if (std::ranges::find(bumped_, body) != bumped_.end()) continue;
    bumped_.push_back(body);
    ++record_.bumps;
    bumps_.push_back({time_s(), pose_.position, body});
  }
}

void RigidBody::wait_until(double time_s) {
  world_->turn_wheels({});
  const auto rolls = static_cast<std::int64_t>(std::ceil((time_s - this->time_s()) / roll_s - instant));
  for (std::int64_t i = 0; i < rolls; ++i) roll();
}

// ---- Driving -------------------------------------------------------------------------------------

/// Follows a reference that comes to rest `total_s` after it began, then waits for the robot to catch up.
template <class ReferenceAt, class During>
void RigidBody::track(double begin_s, double total_s, const ReferenceAt& at, const During& during) {
  const Reference end = at(total_s);
  for (double t = time_s() - begin_s; t < total_s + patience_s; t = time_s() - begin_s) {
    const double ahead_m = dot(direction(end.pose.heading_rad), end.pose.position - pose_.position);
    const double turn_rad = wrap_angle(end.pose.heading_rad - pose_.heading_rad);
    if (t >= total_s && std::abs(ahead_m) < arrived_m && std::abs(turn_rad) < there_rad) break;
    world_->turn_wheels(follow(at(std::min(t, total_s)), pose_, scene_.robot));
    roll();
    during();
  }
  world_->turn_wheels({});
}

void RigidBody::turn_to(double heading_rad, const std::function<void()>& sample) {
  const Pose2 from = pose_;
  const double turn = wrap_angle(heading_rad - from.heading_rad);
  const Limits limits = scene_.robot.turning();
  const auto reference = [&](double t) {
    const double done = std::copysign(covered(std::abs(turn), limits, t), turn);
    const double rate = std::copysign(covered_rate(std::abs(turn), limits, t), turn);
    return Reference{{from.position, from.heading_rad + done}, 0.0, rate};
  };
  int rolls = 0;
  track(time_s(), duration(std::abs(turn), limits), reference, [&] {
    if (++rolls % rolls_per_sample == 0) sample();
  });
  sample();
}

std::vector<Vec2> RigidBody::displaced_waypoints(std::vector<Vec2> waypoints) {
  goal_ = waypoints.back() = displaced_goal(waypoints, scene_.robot.radius_m, on_.ground, on_.rules,
                                            random_in_disk(rng_, errors_.position_m));
  return waypoints;
}

StraightDrive RigidBody::begin_straight(Vec2 goal, const std::function<void()>& sample) {
  if (distance(pose_.position, goal) < arrived_m) return {pose_.position, goal, 0.0, time_s(), 0.0};
  turn_to(heading_of(goal - pose_.position), sample);
  const double length_m = distance(pose_.position, goal);
  return {pose_.position, goal, length_m, time_s(), duration(length_m, scene_.robot.straight())};
}

void RigidBody::be_on(const StraightDrive& drive, double after_s) {
  const Limits limits = scene_.robot.straight();
  for (double t = time_s() - drive.begin_s; t < after_s - instant; t = time_s() - drive.begin_s) {
    world_->turn_wheels(follow(reference_on(drive, limits, t), pose_, scene_.robot));
    roll();
  }
}

Platform RigidBody::platform_on(const StraightDrive& /*drive*/, double /*after_s*/) const {
  const Vec3 velocity_mps = world_->velocity_at(world_->world_T_robot().position);
  return {pose_.position, xy(velocity_mps), velocity_mps.z};
}

void RigidBody::end_straight(const StraightDrive& drive) {
  const Limits limits = scene_.robot.straight();
  track(drive.begin_s, drive.total_s, [&](double t) { return reference_on(drive, limits, t); }, [] {});
}

// ---- Balls ---------------------------------------------------------------------------------------

Flight RigidBody::launched(const GunModel& gun, const Shot& shot) const {
  const Pose3 world_T_robot = world_->world_T_robot();
  const Shot from_body{wrap_angle(shot.yaw_rad - pose_.heading_rad), shot.pitch_rad, shot.speed_mps};
  Flight flight = launch(gun, Vec2{}, 0.0, from_body, scene_.world.gravity_mps2);
  flight.muzzle = world_T_robot * flight.muzzle;
  flight.velocity_mps = world_T_robot.rotation * flight.velocity_mps;
  return flight;
}

void RigidBody::throw_ball(FiredShot shot) {
  const auto number = world_->throw_ball(shot.flight, shot.target);
  const Vec3 muzzle = shot.flight.muzzle;
  if (number) balls_.push_back({*number, std::move(shot), ticks_, muzzle});
}

void RigidBody::wait_until_landed() {
  if (balls_.empty()) return;
  world_->turn_wheels({});
  const std::size_t newest = balls_.back().number;
  while (std::ranges::find(balls_, newest, &BallInAir::number) != balls_.end()) tick();
}

double RigidBody::all_landed_before_s() const {
  return tick_s * static_cast<double>(balls_.empty() ? ticks_ : balls_.front().fired_at - 1);
}

/// Returns what a ball touched at the beginning of the last step; nothing if it flies on.
std::optional<Impact> RigidBody::impact_of(const BallInAir& ball) const {
  const std::size_t body = scene_.world.solids.size() + ball.shot.target;
  const std::vector<std::size_t> touched = world_->touched_by_ball(ball.number);
  if (touched.empty() && ball.before.z >= scene_.world.floor_z_m - 1.0) return {};
  Impact impact{false, tick_s * static_cast<double>(ticks_ - 1 - ball.fired_at), ball.before, {}};
  const auto solid = std::ranges::find_if(touched, [&](std::size_t b) { return b != body; });
  if (solid != touched.end()) impact.solid = *solid;
  impact.hit = !touched.empty() && !impact.solid;
  return impact;
}

void RigidBody::land_balls() {
  for (BallInAir& ball : std::exchange(balls_, {})) {
    const auto impact = impact_of(ball);
    if (!impact) {
      balls_.push_back(std::move(ball));
      continue;
    }
    world_->remove_ball(ball.number);
    landed_.push_back({std::move(ball.shot), *impact, time_s()});
  }
}

}  // namespace outrider
