#include "outrider/sim/guard_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/overload.hpp"
#include "outrider/sim/profile.hpp"

namespace outrider {
namespace {

constexpr double sample_period_s = 0.1;
constexpr double reference_rule_m = 0.5;

/// Uniform in the disk of that radius.
Vec2 in_disk(Rng& rng, double radius_m) {
  const double r = radius_m * std::sqrt(rng.uniform());
  return r * direction(rng.uniform(0.0, 2.0 * pi));
}

/// The reference report's own idea of a hit: the ball's centre comes near the target's base.
bool hits_by_reference_rule(const Flight& flight, const Target& target, double until_s) {
  const Solid base{target.name, {target.base, {}}, SphereShape{0.0}};
  return contact_time(flight, reference_rule_m, base, 0.0, until_s).has_value();
}

std::string name_of_contact(const Impact& impact, const FlightSpace& space, const Target& target) {
  if (impact.hit) return target.name;
  return impact.solid ? space.solids()[*impact.solid].name : "nothing";
}

}  // namespace

SimulatedGuard::SimulatedGuard(const GuardProblem& problem, const Site& site, std::uint64_t seed,
                               std::vector<Intruder> intruders, bool foreseen)
    : problem_(problem),
      site_(site),
      arrival_rng_(Rng(seed).child("arrival")),
      gun_rng_(Rng(seed).child("gun")),
      pose_(problem.start),
      attempts_(problem.targets.size(), 0),
      intruders_(std::move(intruders)),
      foreseen_(foreseen) {
  sample();
}

bool SimulatedGuard::news() const {
  return seen_ < intruders_.size() && (foreseen_ || intruders_[seen_].enters_s <= time_s_);
}

Observation SimulatedGuard::sense() {
  Observation seen{time_s_, pose_, gun_yaw_rad_, gun_pitch_rad_, hit_};
  hit_.reset();
  for (; news(); ++seen_) seen.entered.push_back({seen_, intruders_[seen_].settles_s});
  seen.nobody_comes = seen_ == intruders_.size();
  return seen;
}

void SimulatedGuard::act(const Command& command) {
  std::visit(Overload{[this](const FollowWaypoints& c) { follow(c.waypoints, c.until_news); },
                      [this](const AimGun& c) { aim(c); }, [this](const Fire& c) { fire(c); },
                      [this](const Wait& c) { wait(c); }},
             command);
}

void SimulatedGuard::sample() {
  report.track.push_back({time_s_, pose_, wrap_angle(pose_.heading_rad + gun_yaw_rad_), gun_pitch_rad_});
}

void SimulatedGuard::log(std::string kind, std::string text) {
  report.events.push_back({time_s_, std::move(kind), std::move(text)});
}

void SimulatedGuard::turn_to(double heading_rad) {
  const double from = pose_.heading_rad;
  const double turn = wrap_angle(heading_rad - from);
  const double total = duration(std::abs(turn), problem_.robot.turning());
  const double begin = time_s_;
  for (int i = 1; i * sample_period_s < total; ++i) {
    const double t = i * sample_period_s;
    const double done = covered(std::abs(turn), problem_.robot.turning(), t);
    time_s_ = begin + t;
    pose_.heading_rad = wrap_angle(from + std::copysign(done, turn));
    sample();
  }
  time_s_ = begin + total;
  pose_.heading_rad = heading_rad;
  turned_rad += std::abs(turn);
  if (total > 0.0) sample();
}

void SimulatedGuard::drive_to(Vec2 goal) {
  const Vec2 from = pose_.position;
  const double length = distance(from, goal);
  if (length == 0.0) return;
  turn_to(heading_of(goal - from));
  const double total = duration(length, problem_.robot.straight());
  const double begin = time_s_;
  for (int i = 1; i * sample_period_s < total; ++i) {
    const double t = i * sample_period_s;
    time_s_ = begin + t;
    pose_.position = from + covered(length, problem_.robot.straight(), t) / length * (goal - from);
    sample();
  }
  time_s_ = begin + total;
  pose_.position = goal;
  driven_m += length;
  sample();
}

void SimulatedGuard::wait(const Wait& command) {
  double until_s = command.until_s;
  if (seen_ < intruders_.size()) until_s = std::min(until_s, intruders_[seen_].enters_s);
  if (!std::isfinite(until_s) || until_s <= time_s_) return;
  log("wait", fmt::format("waits until {:.1f} s", until_s));
  sample();
  time_s_ = until_s;
  sample();
}

void SimulatedGuard::follow(std::vector<Vec2> waypoints, bool until_news) {
  if (waypoints.size() < 2) return;
  // The drive ends off its goal, but never inside an obstacle: contact would have stopped the robot.
  const Vec2 before = waypoints[waypoints.size() - 2];
  Vec2 error = in_disk(arrival_rng_, problem_.errors.position_m);
  const double heading_error = problem_.errors.heading_rad * arrival_rng_.uniform(-1.0, 1.0);
  while (squared_norm(error) > 1e-12 &&
         !site_.ground.segment_free({before, waypoints.back() + error}, problem_.robot.radius_m)) {
    error = 0.5 * error;
  }
  if (squared_norm(error) > 1e-12) waypoints.back() = waypoints.back() + error;

  ReportPath path{time_s_, 0.0, waypoints};
  const Vec2 goal = waypoints.back();
  log("drive", fmt::format("drives to ({:.2f}, {:.2f})", goal.x, goal.y));
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    drive_to(waypoints[i]);
    if (until_news && news()) {
      path.waypoints.resize(i + 1);
      break;
    }
  }
  pose_.heading_rad = wrap_angle(pose_.heading_rad + heading_error);
  path.end_s = time_s_;
  report.paths.push_back(std::move(path));
}

void SimulatedGuard::aim(const AimGun& command) {
  const double yaw_from = gun_yaw_rad_;
  const double pitch_from = gun_pitch_rad_;
  const double yaw_turn = wrap_angle(command.yaw_rad - pose_.heading_rad - yaw_from);
  const double pitch_turn = command.pitch_rad - pitch_from;
  const double total = aim_time(problem_.gun, yaw_turn, pitch_turn);
  sample();
  // Each axis moves at its own rate, so the path bends once, where the faster one arrives.
  const double yaw_s = std::abs(yaw_turn) / problem_.gun.yaw_rate_radps;
  const double pitch_s = std::abs(pitch_turn) / problem_.gun.pitch_rate_radps;
  const double begin = time_s_;
  for (const double t : {std::min(yaw_s, pitch_s), total}) {
    time_s_ = begin + t;
    gun_yaw_rad_ = wrap_angle(yaw_from + yaw_turn * (yaw_s > 0.0 ? std::min(1.0, t / yaw_s) : 1.0));
    gun_pitch_rad_ = pitch_from + pitch_turn * (pitch_s > 0.0 ? std::min(1.0, t / pitch_s) : 1.0);
    sample();
  }
}

void SimulatedGuard::fire(const Fire& command) {
  const Target& target = problem_.targets[command.target];
  const AimErrors& errors = problem_.errors.aim;
  const Shot actual{command.shot.yaw_rad + errors.gun_rad * gun_rng_.uniform(-1.0, 1.0),
                    command.shot.pitch_rad + errors.gun_rad * gun_rng_.uniform(-1.0, 1.0),
                    command.shot.speed_mps * (1.0 + errors.speed_ratio * gun_rng_.uniform(-1.0, 1.0))};
  const double floor = problem_.world.floor_z_m;
  const Flight flight = launch(problem_.gun, pose_.position, floor, actual, problem_.world.gravity_mps2);
  const FlightSpace& space = site_.space(command.target);
  const double radius = problem_.gun.ball_radius_m;
  const Impact impact = fly(flight, radius, space, target, floor);

  ReportShot shot;
  shot.target = target.name;
  shot.attempt = ++attempts_[command.target];
  shot.time_s = time_s_;
  shot.flight_s = impact.time_s;
  shot.muzzle = flight.muzzle;
  shot.velocity_mps = flight.velocity_mps;
  shot.contact = name_of_contact(impact, space, target);
  shot.contact_point = impact.position;
  shot.hit = impact.hit;
  shot.hit_by_reference_rule = hits_by_reference_rule(flight, target, impact.time_s);
  shot.clearance_m = impact.hit ? space.clearance(flight, radius, impact.time_s, 1.0).distance_m : 0.0;
  shot.profile = profile_of(flight, impact, space, target);
  log("shot", fmt::format("shoots at {} with {:.2f} m/s", target.name, actual.speed_mps));
  time_s_ += impact.time_s;
  log(impact.hit ? "hit" : "miss", impact.hit
                                       ? fmt::format("hits {}", target.name)
                                       : fmt::format("misses {}: touches {}", target.name, shot.contact));
  report.shots.push_back(std::move(shot));
  hit_ = impact.hit;
  sample();
}

}  // namespace outrider
